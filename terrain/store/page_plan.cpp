#include "terrain/store/page_plan.h"

#include <algorithm>

namespace terrain {
namespace {

constexpr size_t kPinnedShare = 8;    // no more than an eighth of the room
constexpr size_t kMostLeavers = 256;  // at once

}  // namespace

PagePlan::PagePlan(const PageDirectory& directory, size_t slot_count, float want_px)
    : directory_(directory), want_px_(want_px), pages_(directory.count()) {
    while (first_loose_group_ < directory.layout().group_count() &&
           directory.first_of_group(first_loose_group_ + 1) <= slot_count / kPinnedShare) {
        ++first_loose_group_;
    }
    pinned_ = directory.first_of_group(first_loose_group_);
    CHECK(pinned_ <= slot_count);
    room_ = slot_count - pinned_;
    for (size_t slot = slot_count; slot-- > pinned_;)
        free_slots_.push_back(static_cast<uint32_t>(slot));
}

void PagePlan::look(const PageJudge& judge, double age_s) {
    ++look_;
    age_s_ = age_s;
    cursor_ = 0;
    walk(judge);
    const auto is_worthier = [&](size_t a, size_t b) {
        return pages_[a].worth_px != pages_[b].worth_px ? pages_[a].worth_px > pages_[b].worth_px : a < b;
    };
    if (wanted_.size() > room_) {
        const auto middle = wanted_.begin() + static_cast<ptrdiff_t>(room_);
        std::nth_element(wanted_.begin(), middle, wanted_.end(), is_worthier);
        wanted_.erase(middle, wanted_.end());
    }
    std::sort(wanted_.begin(), wanted_.end(), is_worthier);
    for (size_t page : wanted_) {
        pages_[page].deserved_s = age_s;
        pages_[page].is_deserving = true;
    }
}

/// Collects what is wanted; no page is worth more than the one above it, without which it is of no use.
void PagePlan::walk(const PageJudge& judge) {
    wanted_.clear();
    stack_.clear();
    const auto push_children = [&](size_t page) {
        directory_.for_each_child(page, [&](size_t number) {
            const float worth = std::min(judge.worth_px(number), pages_[page].worth_px);
            if (worth < want_px_ || pages_[number].state == State::kBroken) return;
            pages_[number].worth_px = worth;
            pages_[number].look = look_;
            pages_[number].is_deserving = false;
            stack_.push_back(number);
        });
    };
    for (size_t page = directory_.first_of_group(first_loose_group_ - 1); page < pinned_; ++page) {
        pages_[page].worth_px = judge.worth_px(page);
        push_children(page);
    }
    while (!stack_.empty()) {
        const size_t page = stack_.back();
        stack_.pop_back();
        wanted_.push_back(page);
        push_children(page);
    }
}

std::optional<PagePlan::Placement> PagePlan::next() {
    while (cursor_ < wanted_.size() && pages_[wanted_[cursor_]].state != State::kAbsent)
        ++cursor_;
    if (cursor_ == wanted_.size() || free_slots_.empty()) return std::nullopt;
    const size_t number = wanted_[cursor_];
    Page& page = pages_[number];
    page.state = State::kHere;
    page.slot = free_slots_.back();
    free_slots_.pop_back();
    here_.push_back(number);
    count_child(number, 1);
    ++tally_.loads;
    tally_.most_loads = std::max(tally_.most_loads, ++page.loads);
    return Placement{number, page.slot};
}

void PagePlan::give_up(size_t number) {
    pages_[number].state = State::kBroken;
    free_slots_.push_back(pages_[number].slot);
    std::erase(here_, number);
    count_child(number, -1);
    ++tally_.broken;
}

void PagePlan::count_child(size_t number, int change) {
    Page& above = pages_[directory_.parent(number)];
    above.children_here = static_cast<uint8_t>(above.children_here + change);
}

bool PagePlan::may_leave(size_t number) const {
    const Page& page = pages_[number];
    return page.state == State::kHere && page.children_here == 0 && !is_deserving(page) &&
           age_s_ - page.deserved_s >= kLinger_s;
}

void PagePlan::choose_leavers(std::vector<size_t>& out) {
    const size_t expected = free_slots_.size() + leaving_;
    if (missing_count() <= expected) return;
    candidates_.clear();
    std::copy_if(here_.begin(), here_.end(), std::back_inserter(candidates_),
                 [&](size_t number) { return may_leave(number); });
    std::sort(candidates_.begin(), candidates_.end(), [&](size_t a, size_t b) {
        return pages_[a].deserved_s != pages_[b].deserved_s ? pages_[a].deserved_s < pages_[b].deserved_s
                                                            : a > b;
    });
    size_t skipped = 0, chosen = 0;
    auto candidate = candidates_.begin();
    for (size_t wanted : wanted_) {
        if (pages_[wanted].state != State::kAbsent || skipped++ < expected) continue;
        while (candidate != candidates_.end() &&
               pages_[wanted].worth_px < kClearly * worth_px(pages_[*candidate])) {
            ++candidate;
        }
        if (candidate == candidates_.end() || chosen++ == kMostLeavers) return;
        pages_[*candidate].state = State::kLeaving;
        count_child(*candidate, -1);
        ++leaving_;
        out.push_back(*candidate++);
    }
}

void PagePlan::has_left(size_t number) {
    CHECK(pages_[number].state == State::kLeaving);
    pages_[number].state = State::kAbsent;
    free_slots_.push_back(pages_[number].slot);
    std::erase(here_, number);
    --leaving_;
    cursor_ = 0;
    ++tally_.evictions;
}

size_t PagePlan::missing_count() const {
    return static_cast<size_t>(std::count_if(wanted_.begin(), wanted_.end(), [&](size_t number) {
        return pages_[number].state == State::kAbsent;
    }));
}

PageTally PagePlan::tally() const {
    PageTally tally = tally_;
    tally.here = pinned_ + here_.size();
    tally.missing = missing_count();
    return tally;
}

}  // namespace terrain
