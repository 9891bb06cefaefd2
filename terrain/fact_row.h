// Rows of a diamond table whose pages are all present, from west to east: where a row stays in one page its entries lie
// side by side, so that a pass over a level asks for a page once in 64 diamonds.
#pragma once

#include <algorithm>
#include <bit>

#include "terrain/diamond_table.h"

namespace terrain {

/// One row of one level. Table is DiamondTable or const DiamondTable.
template <typename Table>
class FactRow {
  public:
    FactRow(Table& table, int level, int y)
        : table_(table),
          level_(level),
          y_(y),
          step_log2_(std::countr_zero(static_cast<unsigned>(table.domain.reach(level))) + 1) {}

    /// The facts of the diamond centred in column x; x must not be west of an earlier one.
    auto& at(int x) {
        if (x >= end_x_) enter_page(x);
        return run_[(x - begin_x_) >> step_log2_];
    }

  private:
    void enter_page(int x) {
        const PagePlace place = table_.layout.place({x, y_}, level_);
        run_ = &table_.slots[size_t(table_.slot_of_page[place.page]) * kPageEntries + place.entry];
        const int page_log2 = step_log2_ + kPageSideLog2;
        begin_x_ = x;
        end_x_ = ((x >> page_log2) + 1) << page_log2;
    }

    Table& table_;
    int level_, y_, step_log2_;
    decltype(&std::declval<Table&>().slots[0]) run_ = nullptr;
    int begin_x_ = 0, end_x_ = 0;  ///< columns of the page
};

/// The largest error codes among the children of a row's diamonds.
class ChildCodes {
  public:
    ChildCodes(const DiamondTable& table, int level, int y)
        : domain_(table.domain),
          step_(domain_.child_step(level)),
          is_turned_(level & 1),
          has_children_(level < domain_.finest_level()),
          y_(y),
          north_(table, level + has_children_, y - step_),
          middle_(table, level + has_children_, y),
          south_(table, level + has_children_, y + step_) {}

    /// Of the diamond in column x; from west to east.
    uint16_t largest(int x) {
        if (!has_children_) return 0;
        uint16_t code = 0;
        const auto see = [&](FactRow<const DiamondTable>& row, int child_x, int child_y) {
            if (domain_.contains({child_x, child_y})) code = std::max(code, row.at(child_x).error_code);
        };
        if (is_turned_) {
            see(north_, x - step_, y_ - step_);
            see(north_, x + step_, y_ - step_);
            see(south_, x - step_, y_ + step_);
            see(south_, x + step_, y_ + step_);
        } else {
            see(north_, x, y_ - step_);
            see(middle_, x - step_, y_);
            see(middle_, x + step_, y_);
            see(south_, x, y_ + step_);
        }
        return code;
    }

  private:
    const Domain& domain_;
    int step_;
    bool is_turned_, has_children_;
    int y_;
    FactRow<const DiamondTable> north_, middle_, south_;
};

}  // namespace terrain
