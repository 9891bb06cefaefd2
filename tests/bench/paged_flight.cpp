// paged_flight STORE SECONDS CAP_MB TOLERANCE_PX [alone] [draw]: a flight at 300 m/s over a paged terrain, beside the same
// flight over the same table in memory, frame by frame, in turns. Prints one JSON object: the times of adaptation,
// what was not there in time, holes (none are allowed), and the resident memory without what is mapped from files.
//
// `alone` leaves the table in memory out. `draw` makes 640 x 360 pictures of both: then a frame's time is that of the
// complete picture, every paged picture is searched for background where ground must be, and simulated time passes as
// fast as pictures come; without it, at 60 frames a second.
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
#include "tests/bench/flight_path.h"
#include "tests/bench/flight_picture.h"
#include "tests/terrain/conformity.h"

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kRate_hz = 60.0, kGlide_s = 0.4;
constexpr int kFramesAMinute = 3600;
constexpr uint64_t kMaxTriangles = 400'000;
constexpr int kWidth_px = 640, kHeight_px = 360;
constexpr int kWarmFrames = 120, kFramesPerCheck = 600;

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

/// What is flown: one front or two, and the pictures if there are any.
struct Rig {
    terrain::RoamFront& paged;
    terrain::RoamFront* whole;      ///< may be null
    bench::FlightPicture* picture;  ///< may be null
    double tolerance_px;
};

Spent fly_frame(const Rig& rig, terrain::RoamFront& front, const lod::View& view, double time_s) {
    const auto begin = Clock::now();
    const double busy_before_us = busy_us();
    lod::Front* fronts[] = {&front};
    front.begin_frame({&view, 1}, time_s);
    lod::schedule(fronts, {.tolerance_px = rig.tolerance_px, .max_triangles = kMaxTriangles},
                  lod::operation_limit(20'000));
    if (rig.picture != nullptr) rig.picture->draw(front, view);
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
        if (word == "RssAnon:" && status >> kb) return kb / 1024.0;
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
    std::vector<double> resident_mb;  ///< at each check
    int frames = 0, late = 0, holes = 0, checks = 0;
    uint64_t ground_pixels = 0, hole_pixels = 0;
    double worst_late_px = 0.0;
    uint64_t most_triangles = 0;
};

void note_frame(const Rig& rig, const Spent& paged, const Spent& whole, Flight& flight) {
    paged.add_to(flight.paged);
    if (rig.whole != nullptr) whole.add_to(flight.whole);
    const double reached_px = rig.whole != nullptr ? rig.whole->error_px() : rig.tolerance_px;
    if (rig.paged.error_px() > std::max(reached_px, rig.tolerance_px) * 1.001) ++flight.late;
    flight.worst_late_px = std::max(flight.worst_late_px, rig.paged.error_px());
}

/// A front's part of the pool, the n-th of equals: room for the most triangles there may be.
lod::PoolRegion region_of(const terrain::RoamFront& front, uint32_t n) {
    lod::PoolRegion region = front.pool_need();
    region.first_vertex = n * region.vertex_capacity;
    region.first_index = n * region.index_capacity;
    return region;
}

/// The whole raster needs a region of its own; what is drawn next is written anew.
void check(const Rig& rig, const lod::View& view, double time_s, Flight& flight) {
    rig.paged.begin_frame({&view, 1}, time_s);
    flight.resident_mb.push_back(resident_mb());
    flight.holes += has_hole(rig.paged, rig.paged.table()) ? 1 : 0;
    ++flight.checks;
    rig.paged.place(region_of(rig.paged, 0));
}

Flight fly(const Rig& rig, int frames) {
    const bench::FlightPath path(rig.paged.table());
    Flight flight;
    auto next_frame = Clock::now();
    for (int frame = 0; frame < frames; ++frame) {
        const double time_s = frame / kRate_hz;
        if (frame % kFramesAMinute == 0) std::fprintf(stderr, "frame %d of %d\n", frame, frames);
        lod::View view = path.view_at(time_s);
        if (rig.picture != nullptr) view = rig.picture->sized(view);
        // In turn, so that neither always finds the caches as the other left them.
        Spent whole;
        if (rig.whole != nullptr && frame % 2 == 0) whole = fly_frame(rig, *rig.whole, view, time_s);
        const Spent paged = fly_frame(rig, rig.paged, view, time_s);
        if (rig.picture != nullptr)
            flight.hole_pixels += rig.picture->hole_pixels(rig.paged.table(), view, flight.ground_pixels);
        if (rig.whole != nullptr && frame % 2 == 1) whole = fly_frame(rig, *rig.whole, view, time_s);
        ++flight.frames;
        if (frame >= kWarmFrames) note_frame(rig, paged, whole, flight);
        flight.most_triangles = std::max(flight.most_triangles, rig.paged.triangles());
        if (frame % kFramesPerCheck == 0) {
            check(rig, view, time_s, flight);
            next_frame = Clock::now();
        }
        if (rig.picture != nullptr) continue;
        next_frame += std::chrono::microseconds(16'667);
        std::this_thread::sleep_until(next_frame);
    }
    return flight;
}

/// Megabytes a minute of flight: the line of least squares through the second half.
double slope_mb_per_minute(const std::vector<double>& resident_mb) {
    const size_t first = resident_mb.size() / 2;
    const double count = double(resident_mb.size() - first), middle = (count - 1.0) / 2.0;
    double above = 0.0, below = 0.0;
    for (size_t i = first; i < resident_mb.size(); ++i) {
        const double x = double(i - first) - middle;
        above += x * resident_mb[i];
        below += x * x;
    }
    return below > 0.0 ? above / below * 60.0 * kRate_hz / kFramesPerCheck : 0.0;
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
            {"ground_pixels", flight.ground_pixels},
            {"hole_pixels", flight.hole_pixels},
            {"resident_mb_second_half", {{"least", *least}, {"most", *most}}},
            {"resident_slope_mb_per_minute", slope_mb_per_minute(flight.resident_mb)},
            {"loader_mb", double(loader.memory_bytes()) / (1 << 20)},
            {"pages",
             {{"here", tally.here},
              {"loads", tally.loads},
              {"evictions", tally.evictions},
              {"most_loads", tally.most_loads}}}};
}

/// The table in memory, all of it touched: what maps a file comes page by page otherwise.
lod::Result<terrain::DiamondTable> table_in_memory(const terrain::StoreFile& store) {
    auto table = store.map_table();
    if (!table) return table.error();
    uint64_t sum = 0;
    for (size_t i = 0; i < table->slots.size(); i += 512)
        sum += table->slots[i].error_code;
    std::fprintf(stderr, "table in memory, %.0f MB (%llu)\n", double(table->slots.size()) * 8e-6,
                 static_cast<unsigned long long>(sum));
    return table;
}

struct Wishes {
    bool alone = false, draws = false;
};

}  // namespace

int main(int count, char** words) {
    if (count < 5) {
        std::fprintf(stderr, "paged_flight STORE SECONDS CAP_MB TOLERANCE_PX [alone] [draw]\n");
        return 2;
    }
    Wishes wishes;
    for (int i = 5; i < count; ++i) {
        wishes.alone |= std::string(words[i]) == "alone";
        wishes.draws |= std::string(words[i]) == "draw";
    }
    const auto fail = [](const std::string& message) {
        std::fprintf(stderr, "%s\n", message.c_str());
        return 1;
    };
    auto store = terrain::StoreFile::open(words[1]);
    if (!store) return fail(store.message());
    const double tolerance_px = std::atof(words[4]);
    const terrain::RoamOptions options{.tolerance_px = tolerance_px,
                                       .reserve_triangles = kMaxTriangles,
                                       .glide_s = wishes.draws ? kGlide_s : 0.0};
    std::optional<terrain::RoamFront> whole;
    if (!wishes.alone) {
        auto table = table_in_memory(*store);
        if (!table) return fail(table.message());
        whole.emplace(std::move(*table), options);
        whole->place(region_of(*whole, 1));
    }
    auto opened = open_paged_table(
        std::move(*store),
        {.memory_bytes = std::strtoull(words[3], nullptr, 10) << 20, .want_px = 0.5 * tolerance_px});
    if (!opened) return fail(opened.message());
    terrain::RoamFront paged(std::move(opened->table), options, std::move(opened->loader));
    paged.place(region_of(paged, 0));
    std::optional<bench::FlightPicture> picture;
    if (wishes.draws) {
        const lod::PoolRegion one = paged.pool_need();
        auto made = bench::FlightPicture::create(kWidth_px, kHeight_px,
                                                 {2 * one.vertex_capacity, 2 * one.index_capacity, 16});
        if (!made) return fail(made.message());
        picture.emplace(std::move(*made));
    }
    const Rig rig{paged, whole ? &*whole : nullptr, picture ? &*picture : nullptr, tolerance_px};
    const Flight flight = fly(rig, static_cast<int>(std::atof(words[2]) * kRate_hz));
    std::printf("%s\n", report(flight, *paged.loader()).dump(1).c_str());
    return flight.holes == 0 && flight.hole_pixels == 0 ? 0 : 1;
}
