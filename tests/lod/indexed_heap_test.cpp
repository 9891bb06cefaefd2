// IndexedHeap beside the plainest model of it: a map from index to key, searched whole.
#include "lod/base/indexed_heap.h"

#include <gtest/gtest.h>

#include <map>

#include "lod/base/rng.h"

namespace {

TEST(IndexedHeap, TopIsTheLeastAfterAnyChanges) {
    constexpr uint32_t kCount = 60;
    lod::IndexedHeap<std::pair<int, uint32_t>> heap(kCount);
    std::map<uint32_t, std::pair<int, uint32_t>> model;
    lod::Rng rng(7);
    for (int step = 0; step < 20000; ++step) {
        const auto index = static_cast<uint32_t>(rng.below(kCount));
        if (rng.below(3) == 0) {
            heap.erase(index);
            model.erase(index);
        } else {
            const std::pair<int, uint32_t> key{static_cast<int>(rng.below(40)), index};
            heap.set(index, key);
            model[index] = key;
        }
        ASSERT_EQ(heap.is_empty(), model.empty());
        ASSERT_EQ(heap.contains(index), model.count(index) == 1);
        if (model.empty()) continue;
        const auto least = std::min_element(model.begin(), model.end(),
                                            [](const auto& a, const auto& b) { return a.second < b.second; });
        ASSERT_EQ(heap.top(), least->first) << "step " << step;
        ASSERT_EQ(heap.key(least->first), least->second);
    }
}

}  // namespace
