#include "sim/relief_source.h"

#include <algorithm>

#include "terrain/store/coarse_ground.h"

namespace sim {
namespace {

constexpr uint64_t kMostSamples = uint64_t{1} << 30;

lod::Result<data::HeightGrid> read_store(const std::string& path) {
    const auto store = terrain::StoreFile::open(path);
    if (!store) return store.error();
    const terrain::StoreHeader& header = store->header();
    const uint64_t samples = static_cast<uint64_t>(header.width) * static_cast<uint64_t>(header.height);
    if (samples > kMostSamples) {
        return lod::Error{"terrain store '" + path + "' has " + std::to_string(samples) +
                          " samples, expected at most " + std::to_string(kMostSamples) + " to be held"};
    }
    auto ground = terrain::read_coarse_ground(*store, std::max(header.width, header.height));
    if (!ground) return ground.error();
    return std::move(ground->grid);
}

}  // namespace

lod::Result<data::HeightGrid> read_relief(const std::vector<std::string>& sources,
                                          const data::HeightGridOptions& options) {
    const auto store = std::find_if(sources.begin(), sources.end(), terrain::is_store);
    if (store == sources.end()) return data::read_height_grid(sources, options);
    if (sources.size() > 1)
        return lod::Error{"terrain store '" + *store + "' is one of several sources, expected it alone"};
    return read_store(*store);
}

}  // namespace sim
