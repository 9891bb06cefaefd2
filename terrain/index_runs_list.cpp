// IndexRuns: where runs lie in the list.
#include <algorithm>

#include "lod/base/check.h"
#include "terrain/index_runs.h"

namespace terrain {
namespace {

/// Whether runs that have this much room together have enough to grow a little each.
bool is_roomy(uint32_t count, uint32_t room) {
    return room >= count + count / 16 + 12;
}

/// What a list without any holes is given.
uint32_t with_room(uint32_t count) {
    return count + 3 * (count / 12 + 16);
}

}  // namespace

/// Half as much again as the triangles themselves: more than with_room().
uint32_t IndexRuns::room_for(uint64_t triangles) {
    return static_cast<uint32_t>(3 * (triangles + triangles / 2 + 16));
}

/// Gives a node that lacks room what it has itself, or leaves it to the one above.
void IndexRuns::make_room(uint32_t id) {
    const RunNode& node = nodes_[id];
    if (!node.lacks_room || !is_roomy(node.count, node.room)) return;
    lift(id);
    lay(id, node.first, node.room);
}

void IndexRuns::make_room_for_all() {
    const uint32_t count = nodes_[0].count + nodes_[1].count;
    const auto room = std::min(with_room(count), static_cast<uint32_t>(list_.size() / 3 * 3));
    CHECK(room >= count);
    lift(0);
    lift(1);
    const uint32_t first = nodes_[0].count + (room - count) / 6 * 3;
    lay(0, 0, first);
    lay(1, first, room - first);
}

/// Takes contents out of the list: their places will change.
void IndexRuns::lift(uint32_t id) {
    RunNode& node = nodes_[id];
    node.has_news = true;
    if (!node.is_run()) {
        lift(node.children);
        lift(node.children + 1);
    } else if (node.fresh == RunNode::kPlaced) {
        node.fresh = static_cast<uint32_t>(fresh_.size());
        const auto contents = list_.begin() + node.first;
        fresh_.insert(fresh_.end(), contents, contents + node.count);
    }
}

/// Shares room out among what was lifted, to each as to what it has.
void IndexRuns::lay(uint32_t id, uint32_t first, uint32_t room) {
    RunNode& node = nodes_[id];
    node.first = first;
    node.room = room;
    node.lacks_room = false;
    if (node.is_run()) return;
    const uint64_t spare = (room - node.count) / 3;
    const uint32_t own = nodes_[node.children].count;
    const auto left = own + 3 * static_cast<uint32_t>(
                                    node.count > 0 ? (spare * own + node.count / 2) / node.count : spare / 2);
    lay(node.children, first, left);
    lay(node.children + 1, first + left, room - left);
}

void IndexRuns::put_below(uint32_t id) {
    RunNode& node = nodes_[id];
    if (!node.has_news) return;
    node.has_news = false;
    if (node.is_run()) {
        if (node.fresh != RunNode::kPlaced) put(node);
        return;
    }
    put_below(node.children);
    put_below(node.children + 1);
}

/// New contents into the list, and nothing behind them. Only what differs from what is there counts as changed.
void IndexRuns::put(RunNode& node) {
    const auto at = [&](uint32_t i) { return i < node.count ? fresh_[node.fresh + i] : 0u; };
    uint32_t* const there = list_.data() + node.first;
    uint32_t begin = 0, end = node.room;
    while (begin < end && there[begin] == at(begin))
        ++begin;
    while (end > begin && there[end - 1] == at(end - 1))
        --end;
    for (uint32_t i = begin; i < end; ++i)
        there[i] = at(i);
    node.fresh = RunNode::kPlaced;
    if (begin == end) return;
    if (!changed_.empty() && changed_.back().end() == node.first + begin) {
        changed_.back().count += end - begin;
    } else {
        changed_.push_back({node.first + begin, end - begin});
    }
}

}  // namespace terrain
