// PagePlan: which pages are to be in memory, which come next and which go: decisions only, no file and no thread.
//
// A page is named by its entry in the store.
//
// Pages are looked for top-down from those that always stay; a page is wanted while it is worth want_px. The wanted
// ones, worthiest first, as many as there is room for, are the deserving. Missing deserving pages come in that order.
//
// Anti-thrash rule: a page goes only for a deserving one that is worth kClearly times as much, only when it has not
// deserved its place itself for kLinger_s, and never before the pages below it. The longest undeserving goes first.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "terrain/store/page_directory.h"
#include "terrain/store/page_judge.h"

namespace terrain {

/// Counts since the beginning.
struct PageTally {
    uint64_t loads = 0, evictions = 0;
    uint32_t most_loads = 0;  ///< of any one page
    size_t broken = 0;        ///< pages that could not be read
    size_t here = 0;          ///< pages in memory now, those that always stay included
    size_t missing = 0;       ///< deserving ones that are not here yet
};

class PagePlan {
  public:
    static constexpr double kLinger_s = 1.0;
    static constexpr float kClearly = 1.5f;

    /// @param directory   kept by reference
    /// @param slot_count  pages there is room for
    /// @param want_px     >= 0
    PagePlan(const PageDirectory& directory, size_t slot_count, float want_px);

    /// Groups below this one always stay, 1 at least: as many as take no more than an eighth of the room.
    int first_loose_group() const { return first_loose_group_; }
    /// Their pages and the level pages: the first of the directory, each in the slot of its entry.
    size_t pinned_count() const { return pinned_; }

    /// Judges all anew. @param age_s  a clock that never goes back
    void look(const PageJudge& judge, double age_s);

    /// The worthiest page that is missing, and marks it as here; nothing when none is or there is no room.
    struct Placement {
        size_t page;
        uint32_t slot;
    };
    std::optional<Placement> next();
    /// What was just placed could not be read: its slot is free, and it is never asked for again.
    void give_up(size_t page);

    /// Marks pages as leaving so that what is missing finds room; appends them to `out`.
    void choose_leavers(std::vector<size_t>& out);
    /// A leaver is gone; its slot is free.
    void has_left(size_t page);

    /// Cost: O(deserving pages).
    PageTally tally() const;
    static constexpr size_t bytes_per_page() { return sizeof(Page); }

  private:
    enum class State : uint8_t { kAbsent, kHere, kLeaving, kBroken };
    struct Page {
        double deserved_s = -1e9;
        float worth_px = 0.0f;  // at the last look that reached it
        uint32_t look = 0;      // number of that look
        uint32_t slot = 0;
        uint32_t loads = 0;
        State state = State::kAbsent;
        uint8_t children_here = 0;
        bool is_deserving = false;  // since that look
    };

    void walk(const PageJudge& judge);
    void count_child(size_t page, int change);
    float worth_px(const Page& page) const { return page.look == look_ ? page.worth_px : 0.0f; }
    bool is_deserving(const Page& page) const { return page.look == look_ && page.is_deserving; }
    bool may_leave(size_t page) const;
    size_t missing_count() const;

    const PageDirectory& directory_;
    float want_px_;
    int first_loose_group_ = 1;
    size_t pinned_ = 0;  // pages that always stay
    size_t room_ = 0;    // for loose ones
    size_t leaving_ = 0;
    uint32_t look_ = 0;
    double age_s_ = 0.0;
    std::vector<Page> pages_;  // [entry]
    std::vector<uint32_t> free_slots_;
    std::vector<size_t> here_;    // loose pages that are here or leaving
    std::vector<size_t> wanted_;  // worthiest first, cut to the deserving
    size_t cursor_ = 0;           // into wanted_: none before it is absent
    PageTally tally_;
    std::vector<size_t> stack_, candidates_;
};

}  // namespace terrain
