#include "terrain/table_edit.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "lod/base/check.h"
#include "lod/base/parallel.h"
#include "terrain/diamond_facts.h"

namespace terrain {
namespace {

/// Fewer diamonds than this are not worth a thread.
constexpr size_t kFewest = 2048;

/// Whether a diamond's two triangles, or their images where the border clamps them, may cover a point of the range.
bool covers(const Domain& domain, const data::SampleRange& range, GridPoint centre, int level) {
    const int reach = domain.reach(level);
    const int dx = std::max({range.min.x - centre.x, centre.x - range.max.x, 0});
    const int dy = std::max({range.min.y - centre.y, centre.y - range.max.y, 0});
    const bool is_clamped = centre.x + reach >= domain.width || centre.y + reach >= domain.height;
    return (level & 1) != 0 && !is_clamped ? dx + dy <= reach : std::max(dx, dy) <= reach;
}

/// Whether the table has facts of a diamond: not of those squeezed to nothing beyond the raster.
bool is_filled(const Domain& domain, GridPoint centre, int level) {
    const int reach = domain.reach(level);
    return domain.contains(centre) && centre.x - reach < domain.width - 1 &&
           centre.y - reach < domain.height - 1;
}

/// The smallest number >= at that is `first` plus a multiple of `step`, and >= first.
int next_of(int first, int step, int at) {
    return at <= first ? first : first + (at - first + step - 1) / step * step;
}

/// The level's diamonds that cover the range, row by row.
void list_covering(const Domain& domain, const data::SampleRange& range, int level,
                   std::vector<GridPoint>& out) {
    const int reach = domain.reach(level);
    const bool turned = (level & 1) != 0;
    const int last_x = std::min({range.max.x + reach, domain.side(), domain.width - 2 + reach});
    const int last_y = std::min({range.max.y + reach, domain.side(), domain.height - 2 + reach});
    const int row_step = turned ? reach : 2 * reach;
    for (int y = next_of(turned ? 0 : reach, row_step, range.min.y - reach); y <= last_y; y += row_step) {
        const int first_x = turned && ((y / reach) & 1) != 0 ? 0 : reach;
        for (int x = next_of(first_x, 2 * reach, range.min.x - reach); x <= last_x; x += 2 * reach) {
            if (covers(domain, range, {x, y}, level)) out.push_back({x, y});
        }
    }
}

bool is_same(const DiamondSource& a, const DiamondSource& b) {
    return a.height_m == b.height_m && a.error_code == b.error_code && a.rise_and_voids == b.rise_and_voids;
}

/// One edit on its way up the levels.
class TableEdit {
  public:
    TableEdit(const GroundEdit& edit, DiamondTable& table, unsigned threads)
        : edit_(edit),
          table_(table),
          range_(changed_on_domain(table.domain, edit.changed)),
          threads_(threads) {}

    TableEditCounts run() {
        for (int level = table_.domain.finest_level(); level >= 0; --level)
            update_level(level);
        return counts_;
    }

  private:
    void update_level(int level) {
        todo_.clear();
        list_covering(table_.domain, range_, level, todo_);
        std::sort(parents_.begin(), parents_.end(),
                  [](GridPoint a, GridPoint b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
        parents_.erase(std::unique(parents_.begin(), parents_.end()), parents_.end());
        todo_.insert(todo_.end(), parents_.begin(), parents_.end());
        parents_.clear();
        compute(level);
        for (size_t i = 0; i < todo_.size(); ++i)
            store(todo_[i], level, now_[i]);
        counts_.computed += todo_.size();
    }

    /// Every diamond reads the table a level below only: any order gives the same.
    void compute(int level) {
        FactsPass pass = make_facts_pass(edit_.grid, table_.domain, level);
        pass.extremes = &edit_.extremes;
        now_.resize(todo_.size());
        std::atomic<uint64_t> searched = 0;
        lod::parallel_for(todo_.size(), todo_.size() < kFewest ? 1 : threads_, [&](size_t begin, size_t end) {
            uint64_t samples = 0;
            for (size_t i = begin; i < end; ++i) {
                now_[i] = own_facts(pass, todo_[i], &samples);
                now_[i].error_code = std::max(now_[i].error_code, error_code_below(table_, todo_[i], level));
            }
            searched += samples;
        });
        counts_.searched_samples += searched;
    }

    void store(GridPoint centre, int level, const DiamondSource& now) {
        const PagePlace place = table_.layout.place(centre, level);
        DiamondSource& source =
            table_.slots[size_t(table_.slot_of_page[place.page]) * kPageEntries + place.entry];
        if (is_same(source, now)) return;
        ++counts_.changed;
        const uint16_t larger = std::max(source.error_code, now.error_code);
        const bool tells = source.error_code != now.error_code && level > 0;
        source = now;
        if (!tells) return;
        const int apex_dir = apex_direction(table_.domain, centre, level);
        for (int half = 0; half < 2; ++half) {
            const GridPoint parent = step_from(centre, apex_dir + 4 * half, table_.domain.reach(level));
            if (!is_filled(table_.domain, parent, level - 1) ||
                covers(table_.domain, range_, parent, level - 1))
                continue;
            // A parent's error is a child's, or larger than all: only the first can have changed.
            if (larger >= table_.at(parent, level - 1).error_code) parents_.push_back(parent);
        }
    }

    const GroundEdit& edit_;
    DiamondTable& table_;
    data::SampleRange range_;
    unsigned threads_;
    TableEditCounts counts_;
    std::vector<GridPoint> todo_, parents_;
    std::vector<DiamondSource> now_;
};

}  // namespace

data::SampleRange changed_on_domain(const Domain& domain, const data::SampleRange& changed) {
    data::SampleRange range = changed;
    if (range.max.x == domain.width - 1) range.max.x = domain.side();
    if (range.max.y == domain.height - 1) range.max.y = domain.side();
    return range;
}

TableEditCounts edit_table(const GroundEdit& edit, DiamondTable& table, unsigned threads) {
    CHECK(table.domain.width == edit.grid.width && table.domain.height == edit.grid.height);
    CHECK(table.slots.size() == table.layout.page_count() * kPageEntries);
    if (edit.changed.is_empty()) return {};
    CHECK(data::common(edit.changed, data::range_of(edit.grid)).count() == edit.changed.count());
    table.min_m = std::min(table.min_m, edit.grid.min_m);
    table.max_m = std::max(table.max_m, edit.grid.max_m);
    set_corners(edit.grid, table);
    return TableEdit(edit, table, threads).run();
}

}  // namespace terrain
