#include "data/scenes/trade.h"

#include <algorithm>
#include <numeric>

#include "data/scenes/site_plan.h"
#include "lod/base/hilbert3.h"

namespace data::site {

void order_along_curve(std::vector<Spot>& spots) {
    const auto key = [&](size_t i) {
        const glm::dvec3 cell = (spots[i].in_storey.position + 512.0) * 64.0;
        return lod::hilbert_index(static_cast<uint32_t>(cell.x), static_cast<uint32_t>(cell.y),
                                  static_cast<uint32_t>(cell.z));
    };
    std::vector<size_t> along(spots.size());
    std::iota(along.begin(), along.end(), size_t{0});
    std::stable_sort(along.begin(), along.end(), [&](size_t a, size_t b) { return key(a) < key(b); });
    for (size_t rank = 0; rank < along.size(); ++rank)
        spots[along[rank]].order = static_cast<double>(rank) / static_cast<double>(along.size());
}

void add_trade(const Trade& trade, double storey, SceneBuilder& builder) {
    const double jitter = 0.1 * trade.takes;
    for (const Spot& spot : trade.spots) {
        const double begins =
            storey + trade.begins + trade.takes * spot.order + builder.rng.between(0.0, jitter);
        Presence presence{storey_time(begins)};
        if (trade.stays > 0.0) presence.disappears_s = storey_time(begins + trade.stays);
        add_object(trade.kind, spot.mesh, storey_frame(storey) * spot.in_storey, presence, builder);
    }
}

}  // namespace data::site
