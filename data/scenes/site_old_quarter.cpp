#include "data/scenes/site_old_quarter.h"

#include <array>

#include "data/scenes/site_meshes.h"
#include "data/scenes/site_plan.h"
#include "data/scenes/trade.h"

namespace data::site {

namespace {

constexpr double kQuarterRad = std::numbers::pi / 2.0;
constexpr int kHouses = 86, kAcross = 10, kFloors = 4;
constexpr double kLotM = 16.0, kFloorM = 3.0, kPanelM = 1.0;
constexpr double kFirstHouseS = 15.0, kHouseTakesS = 20.0;

/// Meshes of a house, 10 m along x and 8 m along y.
struct HouseMeshes {
    uint32_t wall, floor, roof, chimney;
};

/// 2 m of wall with a window, outside towards -y: 72 triangles.
TimedMesh make_wall(const Colour& render) {
    TimedMesh mesh;
    append_box({-kPanelM, -0.3, 0.0}, {kPanelM, 0.0, 0.9}, render, mesh);
    append_box({-kPanelM, -0.3, 2.3}, {kPanelM, 0.0, kFloorM}, render, mesh);
    for (const double x : {-kPanelM, 0.5})
        append_box({x, -0.3, 0.9}, {x + 0.5, 0.0, 2.3}, render, mesh);
    append_box({-0.5, -0.2, 0.9}, {0.5, -0.15, 2.3}, {70, 84, 96}, mesh);
    append_box({-0.6, -0.4, 0.82}, {0.6, -0.3, 0.9}, kWhite, mesh);
    return mesh;
}

HouseMeshes make_house(const Colour& render, const Colour& tile, SceneBuilder& builder) {
    TimedMesh floor, roof, chimney;
    for (const double y : {-3.0, -1.0, 1.0, 3.0})
        append_box({-4.7, y - 0.99, -0.15}, {4.7, y + 0.99, 0.0}, kPlywood, floor);
    for (int course = 0; course < 8; ++course) {  // one side of the roof, ridge along x
        const double low = course / 8.0, high = (course + 1) / 8.0;
        append_bar({{-5.3, -4.4 + 4.4 * (low + high) / 2.0, 3.2 * (low + high) / 2.0},
                    {5.3, -4.4 + 4.4 * (low + high) / 2.0, 3.2 * (low + high) / 2.0},
                    0.72,
                    0.3 + 0.02 * course},
                   tile, roof);
    }
    append_box({2.0, -0.4, 0.0}, {2.8, 0.4, 4.4}, {150, 92, 74}, chimney);
    append_box({1.9, -0.5, 4.4}, {2.9, 0.5, 4.6}, kSteel, chimney);
    return {add_mesh(make_wall(render), builder), add_mesh(std::move(floor), builder),
            add_mesh(std::move(roof), builder), add_mesh(std::move(chimney), builder)};
}

/// Where a house's wall panels stand on a floor: 5 along x, 4 along y on each side.
std::vector<Placement> wall_places() {
    std::vector<Placement> places;
    for (int side = 0; side < 4; ++side) {
        const bool is_long = side % 2 == 0;
        const int count = is_long ? 5 : 4;
        for (int i = 0; i < count; ++i) {
            const Placement on_side{{2.0 * kPanelM * (i - (count - 1) / 2.0), is_long ? -4.0 : -5.0, 0.0}};
            places.push_back(Placement{{}, side * kQuarterRad} * on_side);
        }
    }
    return places;
}

/// Pulled down from above; `goes_s` is when the roof goes.
void add_house(const HouseMeshes& meshes, const Placement& place, double goes_s, SceneBuilder& builder) {
    const double top_m = kFloors * kFloorM;
    const auto add = [&](uint32_t mesh, const Placement& in_house, double height_m) {
        const double share = 1.0 - height_m / (top_m + 1.0);
        const double disappears_s = goes_s + kHouseTakesS * share + builder.rng.between(0.0, 4.0);
        add_object("house", mesh, place * in_house, {Presence::kNever, disappears_s}, builder);
    };
    for (const double turn_rad : {0.0, 2.0 * kQuarterRad})
        add(meshes.roof, {{0.0, 0.0, top_m}, turn_rad}, top_m + 1.0);
    add(meshes.chimney, {{0.0, 0.0, top_m}}, top_m + 0.5);
    for (int floor = 0; floor < kFloors; ++floor) {
        add(meshes.floor, {{0.0, 0.0, floor * kFloorM + 0.2}}, floor * kFloorM);
        for (Placement panel : wall_places()) {
            panel.position.z = floor * kFloorM;
            add(meshes.wall, panel, floor * kFloorM + 1.0);
        }
    }
}

}  // namespace

void add_old_quarter(SceneBuilder& builder) {
    const std::array<HouseMeshes, 3> kinds = {make_house({206, 190, 162}, {158, 92, 68}, builder),
                                              make_house({186, 160, 138}, {140, 84, 66}, builder),
                                              make_house({198, 196, 186}, {116, 108, 104}, builder)};
    std::vector<Spot> lots;
    for (int i = 0; i < kHouses; ++i) {
        const double x = kLotM * (i % kAcross - (kAcross - 1) / 2.0), y = kLotM * (i / kAcross - 4.0);
        const double turn_rad = static_cast<double>(builder.rng.below(2)) * kQuarterRad;
        lots.push_back({{{x + builder.rng.between(-1.0, 1.0), y, 0.0}, turn_rad},
                        static_cast<uint32_t>(builder.rng.below(3))});
    }
    order_along_curve(lots);
    for (const Spot& lot : lots) {
        const double goes_s = kFirstHouseS + (kClearedS - kFirstHouseS - kHouseTakesS - 5.0) * lot.order;
        add_house(kinds[lot.mesh], lot.in_storey, goes_s, builder);
    }
}

}  // namespace data::site
