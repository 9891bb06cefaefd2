// paged_flight STORE SECONDS CAP_MB TOLERANCE_PX [alone]: a flight at 300 m/s over a paged terrain at 60 frames a second of real
// time, beside the same flight over the same table in memory, frame by frame. Prints one JSON object: the times
// of adaptation, what was not there in time, holes (none are allowed), and the resident memory.
//
// `alone` leaves the table in memory out: then the process's memory is the paged terrain's.
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>

#include "lod/scheduler.h"
#include "terrain/roam_front.h"
#include "terrain/store/page_loader.h"
#include "tests/terrain/conformity.h"
#include "tests/terrain/test_relief.h"

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kSpeed_mps = 300.0, kRate_hz = 60.0;
constexpr uint64_t kMaxTriangles = 400'000;
constexpr int kWarmFrames = 120, kFramesPerCheck = 600;

/// A flight in wide curves over a planar raster, 1000 m above its highest place.
class Path {
  public:
    explicit Path(const terrain::DiamondTable& table)
        : middle_(table.frame.world_from_sample(table.domain.width / 2, table.domain.height / 2, 0.0)),
          radius_m_(0.2 * table.domain.width * table.frame.cell_m().x),
          height_m_(double(table.max_m) + 1000.0) {}

    /// A figure of eight, as fast all along as a Lissajous curve allows: 300 m/s on average.
    glm::dvec3 eye_at(double time_s) const {
        const double a = kSpeed_mps * time_s / (1.6 * radius_m_);
        return {middle_.x + 2.0 * radius_m_ * std::sin(a), middle_.y + radius_m_ * std::sin(2.0 * a),
                height_m_};
    }
    lod::View view_at(double time_s) const {
        const glm::dvec3 way = eye_at(time_s + 0.01) - eye_at(time_s);
        return terrain_test::level_view(eye_at(time_s), std::atan2(way.x, way.y), -0.12);
    }

  private:
    glm::dvec3 middle_;
    double radius_m_, height_m_;
};

/// Time of this thread on a processor: what others do on a shared machine is left out.
double busy_us() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) * 1e6 + double(now.tv_nsec) * 1e-3;
}

/// Times of each frame's adaptation, microseconds.
struct Times {
    std::vector<double> wall_us, busy_us;
};

struct Spent {
    double wall_us = 0.0, busy_us = 0.0;

    void add_to(Times& times) const {
        times.wall_us.push_back(wall_us);
        times.busy_us.push_back(busy_us);
    }
};

Spent adapt(terrain::RoamFront& front, const lod::View& view, double time_s, double tolerance_px) {
    const auto begin = Clock::now();
    const double busy_before_us = busy_us();
    lod::Front* fronts[] = {&front};
    front.begin_frame({&view, 1}, time_s);
    lod::schedule(fronts, {.tolerance_px = tolerance_px, .max_triangles = kMaxTriangles},
                  lod::operation_limit(20'000));
    return {std::chrono::duration<double, std::micro>(Clock::now() - begin).count(),
            busy_us() - busy_before_us};
}

/// Whether all of the raster is covered by a conforming mesh.
bool has_hole(terrain::RoamFront& front, const terrain::DiamondTable& table) {
    if (const std::string fault = front.validate(); !fault.empty()) {
        std::fprintf(stderr, "%s\n", fault.c_str());
        return true;
    }
    const double width_m = table.domain.width * table.frame.cell_m().x;
    const glm::dvec3 middle =
        table.frame.world_from_sample(table.domain.width / 2, table.domain.height / 2, 0.0);
    const lod::View map = terrain_test::level_view({middle.x, middle.y, 4.0 * width_m}, 0.0, -1.5707963);
    terrain_test::PoolTwin pool;
    const auto triangles = terrain_test::emit_triangles(front, map, pool);
    const int64_t whole = 2 * int64_t{table.domain.width - 1} * (table.domain.height - 1);
    const std::string fault = terrain_test::conformity_fault(triangles);
    if (!fault.empty()) std::fprintf(stderr, "%s\n", fault.c_str());
    return !fault.empty() || terrain_test::area_of(triangles) != whole;
}

double resident_mb() {
    std::ifstream status("/proc/self/status");
    std::string word;
    while (status >> word) {
        double kb = 0.0;
        if (word == "VmRSS:" && status >> kb) return kb / 1024.0;
    }
    return 0.0;
}

nlohmann::json quantiles(std::vector<double> us) {
    std::sort(us.begin(), us.end());
    const auto at = [&](double share) { return us[static_cast<size_t>(share * double(us.size() - 1))]; };
    return {{"p50_us", at(0.5)}, {"p99_us", at(0.99)}, {"p999_us", at(0.999)}, {"max_us", us.back()}};
}

nlohmann::json quantiles(const Times& times) {
    if (times.wall_us.empty()) return nullptr;
    return {{"wall", quantiles(times.wall_us)}, {"busy", quantiles(times.busy_us)}};
}

struct Flight {
    Times paged, whole;
    std::vector<double> resident_mb;
    int frames = 0, late = 0, holes = 0, checks = 0;
    double worst_late_px = 0.0;
    uint64_t most_triangles = 0;
};

Flight fly(terrain::RoamFront& paged, terrain::RoamFront* whole, int frames, double tolerance_px) {
    const Path path(paged.table());
    Flight flight;
    auto next_frame = Clock::now();
    for (int frame = 0; frame < frames; ++frame) {
        const double time_s = frame / kRate_hz;
        const lod::View view = path.view_at(time_s);
        // In turn, so that neither always finds the caches as the other left them.
        Spent whole_spent;
        if (whole != nullptr && frame % 2 == 0) whole_spent = adapt(*whole, view, time_s, tolerance_px);
        const Spent paged_spent = adapt(paged, view, time_s, tolerance_px);
        if (whole != nullptr && frame % 2 == 1) whole_spent = adapt(*whole, view, time_s, tolerance_px);
        ++flight.frames;
        if (frame >= kWarmFrames) {
            paged_spent.add_to(flight.paged);
            if (whole != nullptr) whole_spent.add_to(flight.whole);
            const double reached_px = whole != nullptr ? whole->error_px() : tolerance_px;
            if (paged.error_px() > std::max(reached_px, tolerance_px) * 1.001) ++flight.late;
            flight.worst_late_px = std::max(flight.worst_late_px, paged.error_px());
        }
        flight.most_triangles = std::max(flight.most_triangles, paged.triangles());
        if (frame % kFramesPerCheck == 0) {
            flight.resident_mb.push_back(resident_mb());
            flight.holes += has_hole(paged, paged.table()) ? 1 : 0;
            ++flight.checks;
            next_frame = Clock::now();
        }
        next_frame += std::chrono::microseconds(16'667);
        std::this_thread::sleep_until(next_frame);
    }
    return flight;
}

nlohmann::json report(const Flight& flight, const terrain::PageLoader& loader) {
    const terrain::PageTally tally = loader.tally();
    const auto middle = flight.resident_mb.begin() + static_cast<ptrdiff_t>(flight.resident_mb.size() / 2);
    const auto [least, most] = std::minmax_element(middle, flight.resident_mb.end());
    return {{"frames", flight.frames},
            {"paged", quantiles(flight.paged)},
            {"whole", quantiles(flight.whole)},
            {"frames_coarser", flight.late},
            {"worst_error_px", flight.worst_late_px},
            {"triangles", flight.most_triangles},
            {"checks", flight.checks},
            {"holes", flight.holes},
            {"resident_mb_second_half", {{"least", *least}, {"most", *most}}},
            {"loader_mb", double(loader.memory_bytes()) / (1 << 20)},
            {"pages",
             {{"here", tally.here},
              {"loads", tally.loads},
              {"evictions", tally.evictions},
              {"most_loads", tally.most_loads}}}};
}

}  // namespace

int main(int count, char** words) {
    if (count < 5) {
        std::fprintf(stderr, "paged_flight STORE SECONDS CAP_MB TOLERANCE_PX [alone]\n");
        return 2;
    }
    const auto fail = [](const std::string& message) {
        std::fprintf(stderr, "%s\n", message.c_str());
        return 1;
    };
    auto store = terrain::StoreFile::open(words[1]);
    if (!store) return fail(store.message());
    const double tolerance_px = std::atof(words[4]);
    const terrain::RoamOptions options{.tolerance_px = tolerance_px, .reserve_triangles = kMaxTriangles};
    std::optional<terrain::RoamFront> whole;
    if (count < 6) {
        auto table = store->map_table();
        if (!table) return fail(table.message());
        whole.emplace(std::move(*table), options);
    }
    auto opened = open_paged_table(
        std::move(*store),
        {.memory_bytes = std::strtoull(words[3], nullptr, 10) << 20, .want_px = 0.5 * tolerance_px});
    if (!opened) return fail(opened.message());
    terrain::RoamFront paged(std::move(opened->table), options, std::move(opened->loader));
    const Flight flight =
        fly(paged, whole ? &*whole : nullptr, static_cast<int>(std::atof(words[2]) * kRate_hz), tolerance_px);
    std::printf("%s\n", report(flight, *paged.loader()).dump(1).c_str());
    return flight.holes == 0 ? 0 : 1;
}
