// ShortList beside std::vector, through its seam between inside and heap.
#include "lod/base/short_list.h"

#include <gtest/gtest.h>

#include <vector>

#include "lod/base/rng.h"

namespace {

using List = lod::ShortList<uint32_t, 4>;

std::vector<uint32_t> values_of(const List& list) {
    return {list.begin(), list.end()};
}

TEST(ShortList, IsAsSmallAsItsValues) {
    EXPECT_EQ(sizeof(List), 8u + 4 * sizeof(uint32_t));
    EXPECT_EQ(sizeof(lod::ShortList<uint32_t, 10>), 48u);
}

TEST(ShortList, DoesWhatAVectorDoes) {
    lod::Rng rng(7);
    List list;
    std::vector<uint32_t> twin;
    for (int step = 0; step < 20000; ++step) {
        const auto what = static_cast<uint32_t>(rng.below(16)), value = static_cast<uint32_t>(rng.below(5));
        if (what < 9) {
            list.push_back(value), twin.push_back(value);
        } else if (what < 12 && !twin.empty()) {
            list.pop_back(), twin.pop_back();
        } else if (what == 12) {
            list.erase(value), std::erase(twin, value);
        } else if (what == 13) {
            twin.assign(rng.below(10), value);
            list.assign(twin.data(), twin.data() + twin.size());
        } else if (what == 14) {
            List moved(std::move(list));
            EXPECT_TRUE(list.empty());
            list = std::move(moved);
        } else if (value == 0) {
            list.clear(), twin.clear();
        }
        ASSERT_EQ(values_of(list), twin) << "step " << step;
        if (!twin.empty()) {
            ASSERT_EQ(list.back(), twin.back());
        }
    }
}

TEST(ShortList, MovesInAVectorThatGrows) {
    std::vector<List> lists;
    for (uint32_t n = 0; n < 100; ++n) {
        lists.emplace_back();
        for (uint32_t i = 0; i < n % 9; ++i)
            lists.back().push_back(n + i);
    }
    for (uint32_t n = 0; n < 100; ++n) {
        ASSERT_EQ(lists[n].size(), n % 9);
        for (uint32_t i = 0; i < n % 9; ++i)
            EXPECT_EQ(lists[n][i], n + i);
    }
}

}  // namespace
