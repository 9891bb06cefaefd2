#include "data/image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>

#include "data/picture.h"
#include "data/raster_place.h"

namespace data {

namespace {

constexpr int kBlock_px = 32;  // of the target, within which the way to a source is taken as bilinear
constexpr double kWayError_px =
    0.2;  // of the source; where the middle of a block is off by more, all is exact
constexpr int kLattice = 65;

// One source and its place.
struct Layer {
    RasterFile file;
    RasterPlace place;
};

// The picture's pixels and the terrain's grid.
struct Canvas {
    const HeightGrid& grid;
    Image image;

    glm::dvec2 cells_per_pixel() const {
        return {double(grid.width) / image.width, double(grid.height) / image.height};
    }
    // Positions are pixel centres at integers, as in grids.
    void source_from_pixels(const RasterPlace& place, std::span<glm::dvec2> points) const {
        for (glm::dvec2& point : points) {
            const glm::dvec2 at = (point + 0.5) * cells_per_pixel() - 0.5;
            const SitePoint site = grid.frame.site_from_grid(at.x, at.y);
            point = {site.x, site.y};
        }
        place.grid_from_sites(points);
    }
};

lod::Error trouble(const RasterFile& file, const std::string& what) {
    return lod::Error{"imagery '" + file.path + "': " + what};
}

lod::Result<std::vector<Layer>> open_layers(const std::vector<std::string>& paths, const HeightGrid& grid) {
    std::vector<Layer> layers;
    const bool has_datum = grid.frame.world().has_datum;
    for (const std::string& path : paths) {
        auto file = open_raster(path, "imagery");
        if (!file) return file.error();
        if (!file->has_place) return trouble(*file, "has no geotransform; expected a georeferenced raster");
        const std::string crs =
            has_datum ? file->crs_wkt : "";  // without a datum x and y are taken as they are
        auto place = RasterPlace::make(file->geo_transform, crs, file->width, file->height);
        if (!place) return trouble(*file, place.message());
        if (has_datum && !place->has_datum())
            return trouble(*file, "has no CRS; expected one, as the terrain has");
        layers.push_back({std::move(*file), std::move(*place)});
    }
    return layers;
}

// Source pixels per cell of the terrain, where the source's middle lies.
double pixels_per_cell(const Layer& layer, const HeightGrid& grid) {
    const glm::dvec2 middle = glm::dvec2(layer.file.width - 1, layer.file.height - 1) * 0.5;
    std::array<glm::dvec2, 3> points = {middle, middle + glm::dvec2(1, 0), middle + glm::dvec2(0, 1)};
    layer.place.sites_from_grid(points);
    for (glm::dvec2& point : points)
        point = grid.frame.grid_from_site({point.x, point.y, 0.0});
    const double cells = std::min(glm::distance(points[0], points[1]), glm::distance(points[0], points[2]));
    return cells > 0.0 ? 1.0 / cells : 0.0;  // also for NaN
}

glm::ivec2 size_of(const std::vector<Layer>& layers, const HeightGrid& grid, int max_size_px) {
    double finest = 0.0;
    for (const Layer& layer : layers)
        finest = std::max(finest, pixels_per_cell(layer, grid));
    const double scale = std::min(finest, double(max_size_px) / std::max(grid.width, grid.height));
    const glm::dvec2 size = glm::round(glm::dvec2(grid.width, grid.height) * scale);
    return glm::ivec2(glm::clamp(size, glm::dvec2(1.0), glm::dvec2(max_size_px)));
}

// The part of the source the canvas may need; of no size where they do not meet.
PixelWindow window_for(const Canvas& canvas, const Layer& layer) {
    const glm::dvec2 extent(canvas.image.width, canvas.image.height);
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
    double widest_step = 0.0;
    for (int j = 0; j < kLattice; ++j) {
        glm::dvec2 previous(std::numeric_limits<double>::quiet_NaN());
        for (int i = 0; i < kLattice; ++i) {
            glm::dvec2 point = extent * glm::dvec2(i, j) / double(kLattice - 1) - 0.5;
            canvas.source_from_pixels(layer.place, {&point, 1});
            if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
            low = glm::min(low, point);
            high = glm::max(high, point);
            const double step = glm::distance(previous, point);
            if (step < 1e9) widest_step = std::max(widest_step, step);
            previous = point;
        }
    }
    const glm::dvec2 size(layer.file.width, layer.file.height);
    const glm::dvec2 begin = glm::clamp(glm::floor(low - widest_step - 1.0), glm::dvec2(0.0), size);
    const glm::dvec2 end = glm::clamp(glm::ceil(high + widest_step + 2.0), glm::dvec2(0.0), size);
    return {glm::ivec2(begin), glm::ivec2(end) - glm::ivec2(begin)};
}

// A window as read, and the way from source pixels to its own.
struct Sampler {
    const Image& image;
    glm::dvec2 begin, source_per_pixel;

    // Premultiplied RGBA in [0, 255], bilinear, the border's value beyond the border.
    glm::dvec4 at(const glm::dvec2& source) const {
        const glm::dvec2 last(image.width - 1, image.height - 1);
        const glm::dvec2 own = (source + 0.5 - begin) / source_per_pixel - 0.5;
        const glm::dvec2 inside = glm::clamp(own, glm::dvec2(0.0), last);
        const glm::ivec2 low(inside), high = glm::min(low + 1, glm::ivec2(last));
        const glm::dvec2 share = inside - glm::dvec2(low);
        return glm::mix(glm::mix(texel(low.x, low.y), texel(high.x, low.y), share.x),
                        glm::mix(texel(low.x, high.y), texel(high.x, high.y), share.x), share.y);
    }
    glm::dvec4 texel(int col, int row) const {
        const size_t i =
            4 * (static_cast<size_t>(row) * static_cast<size_t>(image.width) + static_cast<size_t>(col));
        const double alpha = image.rgba[i + 3];
        return {glm::dvec3(image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]) * (alpha / 255.0), alpha};
    }
};

// Puts a premultiplied colour under what the pixel holds already.
void put_under(const glm::dvec4& below, uint8_t* pixel) {
    const double top = pixel[3], free = 1.0 - top / 255.0;
    const double alpha = top + below.w * free;
    if (alpha <= 0.0) return;
    for (int c = 0; c < 3; ++c) {
        const double premultiplied = pixel[c] * (top / 255.0) + below[c] * free;
        pixel[c] = static_cast<uint8_t>(std::lround(std::min(255.0, premultiplied * 255.0 / alpha)));
    }
    pixel[3] = static_cast<uint8_t>(std::lround(alpha));
}

// Source positions of the target's pixels [begin, begin + size), row by row.
void map_block(const Canvas& canvas, const RasterPlace& place, const glm::ivec2& begin,
               const glm::ivec2& size, std::vector<glm::dvec2>& out) {
    const glm::dvec2 first(begin), last = first + glm::dvec2(size - 1);
    std::array<glm::dvec2, 5> p = {first, {last.x, first.y}, {first.x, last.y}, last, (first + last) * 0.5};
    canvas.source_from_pixels(place, p);
    const bool is_bilinear = glm::distance((p[0] + p[1] + p[2] + p[3]) * 0.25, p[4]) <= kWayError_px;
    const glm::dvec2 span = glm::max(glm::dvec2(size - 1), glm::dvec2(1.0));
    out.clear();
    for (int row = 0; row < size.y; ++row) {
        for (int col = 0; col < size.x; ++col) {
            const glm::dvec2 at(col, row), share = at / span;
            out.push_back(
                is_bilinear ? glm::mix(glm::mix(p[0], p[1], share.x), glm::mix(p[2], p[3], share.x), share.y)
                            : first + at);
        }
    }
    if (!is_bilinear) canvas.source_from_pixels(place, out);
}

// Lays the source under what is there; returns how many pixels it reaches.
uint64_t lay_under(const Layer& layer, const Sampler& sampler, Canvas& canvas) {
    uint64_t reached = 0;
    std::vector<glm::dvec2> sources;
    Image& image = canvas.image;
    const glm::dvec2 beyond(layer.file.width - 0.5, layer.file.height - 0.5);
    for (int top = 0; top < image.height; top += kBlock_px) {
        for (int left = 0; left < image.width; left += kBlock_px) {
            const glm::ivec2 begin(left, top);
            const glm::ivec2 size =
                glm::min(glm::ivec2(kBlock_px), glm::ivec2(image.width, image.height) - begin);
            map_block(canvas, layer.place, begin, size, sources);
            for (size_t k = 0; k < sources.size(); ++k) {
                const glm::dvec2& s = sources[k];
                if (!(s.x >= -0.5 && s.y >= -0.5 && s.x <= beyond.x && s.y <= beyond.y)) continue;
                ++reached;
                const size_t col = static_cast<size_t>(left) + k % static_cast<size_t>(size.x);
                const size_t row = static_cast<size_t>(top) + k / static_cast<size_t>(size.x);
                put_under(sampler.at(s), &image.rgba[4 * (row * static_cast<size_t>(image.width) + col)]);
            }
        }
    }
    return reached;
}

std::string extent_text(std::span<const glm::dvec2> sites) {
    glm::dvec2 low = sites[0], high = sites[0];
    for (const glm::dvec2& site : sites) {
        low = glm::min(low, site);
        high = glm::max(high, site);
    }
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), "%.8g..%.8g, %.8g..%.8g", low.x, high.x, low.y, high.y);
    return text.data();
}

lod::Error no_overlap(const Layer& layer, const HeightGrid& grid) {
    const auto corners = [](int width, int height) {
        const double right = width - 0.5, bottom = height - 0.5;
        return std::array<glm::dvec2, 4>{{{-0.5, -0.5}, {right, -0.5}, {-0.5, bottom}, {right, bottom}}};
    };
    std::array<glm::dvec2, 4> own = corners(layer.file.width, layer.file.height);
    layer.place.sites_from_grid(own);
    std::array<glm::dvec2, 4> terrain = corners(grid.width, grid.height);
    for (glm::dvec2& point : terrain) {
        const SitePoint site = grid.frame.site_from_grid(point.x, point.y);
        point = {site.x, site.y};
    }
    return trouble(layer.file, "covers " + extent_text(own) + "; expected an overlap with the terrain, " +
                                   extent_text(terrain));
}

lod::Result<lod::Ok> drape(const Layer& layer, Canvas& canvas) {
    const PixelWindow window = window_for(canvas, layer);
    if (window.size.x <= 0 || window.size.y <= 0) return no_overlap(layer, canvas.grid);
    const double source_px = pixels_per_cell(layer, canvas.grid) *
                             std::min(canvas.cells_per_pixel().x, canvas.cells_per_pixel().y);
    const int decimation = std::max(1, static_cast<int>(std::min(source_px, 1e6)));
    const glm::ivec2 size = (window.size + decimation - 1) / decimation;
    const auto picture = read_picture(layer.file, window, size);
    if (!picture) return picture.error();
    const Sampler sampler{*picture, glm::dvec2(window.begin), glm::dvec2(window.size) / glm::dvec2(size)};
    if (lay_under(layer, sampler, canvas) == 0) return no_overlap(layer, canvas.grid);
    return lod::Ok{};
}

}  // namespace

lod::Result<Image> read_imagery(const std::vector<std::string>& paths, const HeightGrid& grid,
                                int max_size_px) {
    CHECK(max_size_px >= 1);
    if (paths.empty()) return lod::Error{"imagery: no source is named; expected at least one raster"};
    const auto layers = open_layers(paths, grid);
    if (!layers) return layers.error();
    const glm::ivec2 size = size_of(*layers, grid, max_size_px);
    Canvas canvas{grid, {size.x, size.y, {}}};
    canvas.image.rgba.assign(static_cast<size_t>(size.x) * static_cast<size_t>(size.y) * 4, 0);
    for (const Layer& layer : *layers) {
        if (const auto done = drape(layer, canvas); !done) return done.error();
    }
    return std::move(canvas.image);
}

}  // namespace data
