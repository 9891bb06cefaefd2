#include "data/mosaic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "data/raster_place.h"

namespace data {

namespace {

constexpr double kAlignedWithin = 0.02;  // cells; spacings are often written with few digits
constexpr int kOutlineSteps = 32;        // per edge
constexpr int64_t kMaxSamples = int64_t{1} << 30;

// A source and the rectangle of the common grid that it covers. Grid coordinates are the first source's.
struct Piece {
    const HeightRaster* raster = nullptr;
    RasterPlace place;
    glm::ivec2 begin{0}, end{0};
    bool is_aligned = false;
};

lod::Error trouble(const HeightRaster& raster, const std::string& what) {
    return lod::Error{"terrain '" + raster.path + "': " + what};
}

void to_common_grid(const RasterPlace& from, const RasterPlace& common, std::span<glm::dvec2> points) {
    from.sites_from_grid(points);
    common.grid_from_sites(points);
}

// Points around the outer edge of the source's pixels.
std::vector<glm::dvec2> outline_of(const HeightRaster& raster) {
    std::vector<glm::dvec2> points;
    for (int k = 0; k <= kOutlineSteps; ++k) {
        const double x = raster.width * double(k) / kOutlineSteps - 0.5;
        const double y = raster.height * double(k) / kOutlineSteps - 0.5;
        points.insert(points.end(),
                      {{x, -0.5}, {x, raster.height - 0.5}, {-0.5, y}, {raster.width - 0.5, y}});
    }
    return points;
}

// Samples of the source are samples of the common grid, moved by whole cells.
bool is_aligned(const Piece& piece, const RasterPlace& common) {
    const HeightRaster& r = *piece.raster;
    for (const glm::ivec2& sample :
         {glm::ivec2(0), glm::ivec2(r.width - 1, 0), glm::ivec2(0, r.height - 1),
          glm::ivec2(r.width - 1, r.height - 1), glm::ivec2(r.width / 2, r.height / 2)}) {
        glm::dvec2 point(sample);
        to_common_grid(piece.place, common, {&point, 1});
        const glm::dvec2 off = glm::abs(point - glm::dvec2(sample + piece.begin));
        if (!(std::max(off.x, off.y) <= kAlignedWithin)) return false;
    }
    return piece.end - piece.begin == glm::ivec2(r.width, r.height);
}

lod::Result<lod::Ok> lay_out(Piece& piece, const RasterPlace& common) {
    std::vector<glm::dvec2> outline = outline_of(*piece.raster);
    to_common_grid(piece.place, common, outline);
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const glm::dvec2& point : outline) {
        const bool is_placed = std::max(std::abs(point.x), std::abs(point.y)) < 1e9;  // false for NaN
        if (!is_placed) return trouble(*piece.raster, "cannot be placed in the CRS of the first source");
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    piece.begin = glm::ivec2(glm::ceil(low));
    piece.end = glm::ivec2(glm::floor(high)) + 1;
    piece.is_aligned = is_aligned(piece, common);
    return lod::Ok{};
}

struct Sampled {
    float height_m = 0.0f;
    bool is_void = true;
};

// Bilinear over valid samples; what lies within half a cell of the border takes the border's value.
Sampled sample(const HeightRaster& raster, const glm::dvec2& at) {
    const bool is_inside =
        at.x >= -0.5 && at.y >= -0.5 && at.x <= raster.width - 0.5 && at.y <= raster.height - 0.5;
    if (!is_inside) return {};
    const glm::ivec2 last(raster.width - 1, raster.height - 1);
    const glm::dvec2 inside = glm::clamp(at, glm::dvec2(0.0), glm::dvec2(last));
    const glm::ivec2 nearest(glm::round(inside));
    if (raster.is_void[raster.index(nearest.x, nearest.y)]) return {};
    const glm::ivec2 low(inside);
    const glm::dvec2 share = inside - glm::dvec2(low);
    double sum = 0.0, weights = 0.0;
    for (const glm::ivec2& step : {glm::ivec2(0, 0), glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(1, 1)}) {
        const glm::ivec2 corner = glm::min(low + step, last);
        const size_t index = raster.index(corner.x, corner.y);
        if (raster.is_void[index]) continue;
        const double weight = (step.x ? share.x : 1.0 - share.x) * (step.y ? share.y : 1.0 - share.y);
        sum += weight * double{raster.height_m[index]};
        weights += weight;
    }
    return {static_cast<float>(sum / weights), false};  // the nearest sample weighs at least a quarter
}

// Fills what is still void of `out`, whose sample (0, 0) is `origin` of the common grid.
void paste(const Piece& piece, const RasterPlace& common, const glm::ivec2& origin, HeightRaster& out) {
    const HeightRaster& source = *piece.raster;
    std::vector<glm::dvec2> points;
    for (int row = piece.begin.y; row < piece.end.y; ++row) {
        if (!piece.is_aligned) {
            points.clear();
            for (int col = piece.begin.x; col < piece.end.x; ++col)
                points.emplace_back(col, row);
            to_common_grid(common, piece.place, points);
        }
        for (int col = piece.begin.x; col < piece.end.x; ++col) {
            const size_t target = out.index(col - origin.x, row - origin.y);
            if (!out.is_void[target]) continue;
            Sampled value;
            if (piece.is_aligned) {
                const size_t index = source.index(col - piece.begin.x, row - piece.begin.y);
                value = {source.height_m[index], source.is_void[index] != 0};
            } else {
                value = sample(source, points[static_cast<size_t>(col - piece.begin.x)]);
            }
            out.height_m[target] = value.height_m;
            out.is_void[target] = value.is_void;
        }
    }
}

lod::Result<std::vector<Piece>> lay_out_all(const std::vector<HeightRaster>& rasters) {
    std::vector<Piece> pieces;
    for (const HeightRaster& raster : rasters) {
        auto place = RasterPlace::make(raster.geo_transform, raster.crs_wkt, raster.width, raster.height);
        if (!place) return trouble(raster, place.message());
        pieces.push_back({&raster, std::move(*place), {}, {}, false});
    }
    for (Piece& piece : pieces) {
        if (piece.place.has_datum() != pieces[0].place.has_datum()) {
            return trouble(*piece.raster, std::string(piece.place.has_datum() ? "has a" : "has no") +
                                              " CRS, unlike '" + rasters[0].path + "'; expected all or none");
        }
        if (const auto done = lay_out(piece, pieces[0].place); !done) return done.error();
    }
    return pieces;
}

}  // namespace

lod::Result<HeightRaster> join(std::vector<HeightRaster> rasters) {
    CHECK(!rasters.empty());
    if (rasters.size() == 1) return std::move(rasters[0]);
    const auto pieces = lay_out_all(rasters);
    if (!pieces) return pieces.error();
    glm::ivec2 begin = (*pieces)[0].begin, end = (*pieces)[0].end;
    for (const Piece& piece : *pieces) {
        begin = glm::min(begin, piece.begin);
        end = glm::max(end, piece.end);
    }
    const int64_t cols = int64_t{end.x} - begin.x, rows = int64_t{end.y} - begin.y;
    if (cols > kMaxSamples || rows > kMaxSamples || cols * rows > kMaxSamples) {
        return trouble(rasters[0], "joining the sources on its grid takes " + std::to_string(cols) + " x " +
                                       std::to_string(rows) + " samples; expected at most 2^30");
    }
    try {
        HeightRaster out;
        out.path = rasters[0].path;
        out.width = static_cast<int>(cols);
        out.height = static_cast<int>(rows);
        out.crs_wkt = rasters[0].crs_wkt;
        out.geo_transform = rasters[0].geo_transform;
        auto& g = out.geo_transform;
        g[0] += g[1] * begin.x + g[2] * begin.y;
        g[3] += g[4] * begin.x + g[5] * begin.y;
        out.height_m.assign(static_cast<size_t>(cols * rows), 0.0f);
        out.is_void.assign(static_cast<size_t>(cols * rows), 1);
        for (const Piece& piece : *pieces)
            paste(piece, (*pieces)[0].place, begin, out);
        return out;
    } catch (const std::bad_alloc&) {
        return trouble(rasters[0], "joined samples do not fit into memory");
    }
}

}  // namespace data
