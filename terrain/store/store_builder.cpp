#include "terrain/store/store_builder.h"

#include <numeric>

namespace terrain {

lod::Result<StoreReport> build_store(const data::HeightGrid& grid, const std::string& path, unsigned threads,
                                     const std::function<void(double)>& progress) {
    StoreDraft draft{make_table_frame(grid), {}};
    draft.numbers.resize(draft.table.layout.page_count());
    std::iota(draft.numbers.begin(), draft.numbers.end(), uint64_t{0});
    const int finest = draft.table.domain.finest_level();
    // A level has half the diamonds of the next finer one, and about as much work for each.
    const auto say = [&](int level) {
        if (progress) progress(0.9 * (1.0 - 1.0 / double(uint64_t{1} << (finest - level))));
    };
    return write_store(std::move(draft), path, threads, [&](DiamondTable& table) {
        fill_table(grid, table, threads, say);
        if (progress) progress(0.9);
    });
}

}  // namespace terrain
