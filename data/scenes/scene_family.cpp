#include "data/scenes/scene_family.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "data/object_plan.h"
#include "data/scenes/scene_builder.h"
#include "lod/base/check.h"
#include "lod/base/hilbert3.h"

namespace data {

namespace {

constexpr double kCellM = 4.0;

using Cell = glm::uvec3;

/// The least side of a block of `aspect` times as many layers that holds `count` cells.
uint32_t side_of(uint64_t count, uint32_t aspect) {
    uint32_t side = 1;
    while (uint64_t{side} * side * side * aspect < count)
        ++side;
    return side;
}

/// Calls visit(cell) for at least `count` cells of the family's buildings, from the ground up.
template <typename Visit>
void for_each_cell(SceneFamily family, uint64_t count, const Visit& visit) {
    if (family != SceneFamily::kGroup) {
        const uint32_t aspect = family == SceneFamily::kHighRise ? 4 : 1, side = side_of(count, aspect);
        for (uint32_t z = 0; z < side * aspect; ++z) {
            for (uint32_t y = 0; y < side; ++y) {
                for (uint32_t x = 0; x < side; ++x)
                    visit(Cell(x, y, z));
            }
        }
        return;
    }
    constexpr uint32_t kWide = 8, kHigh = 5, kStreet = 5;
    const uint64_t houses = (count + kWide * kWide * kHigh - 1) / (kWide * kWide * kHigh);
    const auto across = static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<double>(houses))));
    for (uint32_t house = 0; house < houses; ++house) {
        const Cell corner(house % across * (kWide + kStreet), house / across * (kWide + kStreet), 0);
        for (uint32_t i = 0; i < kWide * kWide * kHigh; ++i)
            visit(corner + Cell(i % kWide, i / kWide % kWide, i / kWide / kWide));
    }
}

/// Exactly `objects` cells, any `objects` of the first objects / (1 - sparsity), each with the same chance.
std::vector<Cell> choose_cells(const FamilyOptions& options, lod::Rng& rng) {
    const double wanted = std::ceil(static_cast<double>(options.objects) / (1.0 - options.sparsity));
    CHECK(wanted < 1e9);
    uint64_t left = static_cast<uint64_t>(wanted), needed = options.objects;
    std::vector<Cell> cells;
    cells.reserve(needed);
    for_each_cell(options.family, left, [&](const Cell& cell) {
        if (left == 0) return;
        if (rng.below(left) < needed) {
            cells.push_back(cell);
            --needed;
        }
        --left;
    });
    return cells;
}

/// [objects] when each appears, in (0, 1): the rank along the curve, mixed with chance.
std::vector<double> order_of(const std::vector<Cell>& cells, double coherence, lod::Rng& rng) {
    struct Ranked {
        uint64_t key;
        uint32_t cell;
    };
    const auto count = static_cast<uint32_t>(cells.size());
    std::vector<Ranked> along(count);
    for (uint32_t i = 0; i < count; ++i)
        along[i] = {lod::hilbert_index(cells[i].x, cells[i].y, cells[i].z), i};
    std::sort(along.begin(), along.end(), [](const Ranked& a, const Ranked& b) { return a.key < b.key; });
    std::vector<double> mixed(count);
    for (uint32_t rank = 0; rank < count; ++rank)
        mixed[along[rank].cell] = coherence * (rank + 0.5) / count + (1.0 - coherence) * rng.unit();
    std::vector<uint32_t> by_time(count);
    for (uint32_t i = 0; i < count; ++i)
        by_time[i] = i;
    std::sort(by_time.begin(), by_time.end(),
              [&](uint32_t a, uint32_t b) { return mixed[a] != mixed[b] ? mixed[a] < mixed[b] : a < b; });
    for (uint32_t rank = 0; rank < count; ++rank)
        mixed[by_time[rank]] = (rank + 0.5) / count;
    return mixed;
}

/// A building part that fits a cell: a body, smaller boxes on it, and loose triangles to make the count exact.
TimedMesh make_part(uint32_t triangles, uint32_t kind, lod::Rng& rng) {
    constexpr std::array<Colour, 8> kColours = {{{186, 181, 171},
                                                 {148, 74, 58},
                                                 {206, 202, 193},
                                                 {92, 100, 110},
                                                 {72, 110, 138},
                                                 {198, 156, 102},
                                                 {228, 230, 231},
                                                 {236, 178, 36}}};
    constexpr std::array<glm::dvec3, 4> kHalves = {
        {{1.9, 1.9, 0.15}, {0.35, 0.35, 1.9}, {1.9, 0.2, 0.3}, {1.9, 0.1, 1.9}}};
    const glm::dvec3 &half = kHalves[kind % 4], middle(0.0, 0.0, 2.0);
    TimedMesh mesh;
    append_box(middle - half, middle + half, kColours[kind], mesh);
    const Colour& detail = kColours[(kind + 3) % 8];
    while (triangles - mesh.triangles.size() >= 12) {
        const glm::dvec3 at(rng.between(-1.0, 1.0), rng.between(-1.0, 1.0), rng.between(-1.0, 1.0));
        const glm::dvec3 small(rng.between(0.05, 0.3), rng.between(0.05, 0.3), rng.between(0.05, 0.3));
        append_box(middle + at * half - small, middle + at * half + small, detail, mesh);
    }
    while (mesh.triangles.size() < triangles)
        mesh.triangles.push_back({0, 1, static_cast<uint32_t>(2 + mesh.triangles.size() % 2)});
    return mesh;
}

/// Shown at its time, and then by turns hidden and shown again.
std::vector<VisibilityStep> make_events(double appears, const FamilyOptions& options, lod::Rng& rng) {
    const double whole = std::floor(options.events_per_object);
    int count = static_cast<int>(whole) + (rng.unit() < options.events_per_object - whole ? 1 : 0);
    std::vector<VisibilityStep> events;
    double time = appears;
    for (bool is_visible = true; count > 0; --count, is_visible = !is_visible) {
        events.push_back({time * options.end_s, is_visible});
        time += (1.0 - time) * rng.between(0.1, 0.9);
    }
    return events;
}

/// At rest in its place, or lifted there from the ground beside the building while `appears` passes.
std::vector<KeyFrame> make_keys(const Placement& place, double appears_s, const FamilyOptions& options,
                                lod::Rng& rng) {
    if (!(rng.unit() < options.moving_share)) return {key_at(0.0, place)};
    const double takes_s = 0.01 * options.end_s;
    Placement ground = place, above = place;
    ground.position = {-20.0 - rng.between(0.0, 30.0), place.position.y, 0.0};
    ground.turn_rad += rng.between(-1.5, 1.5);
    above.position.z += 6.0;
    return {key_at(appears_s, ground), key_at(appears_s + 0.7 * takes_s, above),
            key_at(appears_s + takes_s, place)};
}

}  // namespace

TimedScene generate_family(const FamilyOptions& options) {
    CHECK(options.objects >= 1 && options.objects <= 10000000 && options.triangles >= 12 &&
          options.end_s > 0.0);
    CHECK(options.sparsity >= 0.0 && options.sparsity < 1.0 && options.events_per_object >= 0.0);
    SceneBuilder builder(options.seed);
    TimedScene& scene = builder.scene;
    scene.end_s = options.end_s;
    for (uint32_t kind = 0; kind < 8; ++kind)
        add_mesh(make_part(options.triangles, kind, builder.rng), builder);
    const std::vector<Cell> cells = choose_cells(options, builder.rng);
    const double coherence = options.family == SceneFamily::kScattered ? 0.0 : options.coherence;
    const std::vector<double> appears = order_of(cells, coherence, builder.rng);
    scene.objects.reserve(cells.size());
    scene.keys.reserve(cells.size());
    ObjectPlan plan;
    for (size_t i = 0; i < cells.size(); ++i) {
        const Placement place{kCellM * glm::dvec3(cells[i]),
                              static_cast<double>(builder.rng.below(4)) * std::acos(0.0)};
        plan.mesh = static_cast<uint32_t>(builder.rng.below(scene.meshes.size()));
        plan.id = "part-" + std::to_string(i + 1);
        plan.events = make_events(appears[i], options, builder.rng);
        plan.keys = make_keys(place, appears[i] * options.end_s, options, builder.rng);
        const auto appended = append_object(plan, scene);
        CHECK(appended);
    }
    return std::move(builder.scene);
}

}  // namespace data
