#include "objects/cluster_cut.h"

#include <algorithm>

namespace objects {
namespace {

/// std::push_heap keeps the greatest in front.
bool comes_later(const CutQueue::Entry& a, const CutQueue::Entry& b) {
    return a.key != b.key ? a.key > b.key : a.id > b.id;
}

}  // namespace

void CutQueue::push(double error_px, ClusterId id) {
    heap_.push_back({sign_ * error_px, id});
    std::push_heap(heap_.begin(), heap_.end(), comes_later);
}

void CutQueue::pop() {
    std::pop_heap(heap_.begin(), heap_.end(), comes_later);
    heap_.pop_back();
}

}  // namespace objects
