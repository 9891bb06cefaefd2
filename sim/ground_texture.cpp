#include "sim/ground_texture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lod/base/parallel.h"
#include "sim/ground_colour.h"
#include "sim/noise.h"
#include "sim/relief.h"
#include "sim/street_cover.h"
#include "sim/sunlight.h"

namespace sim {
namespace {

constexpr glm::vec3 kStreet{0.62f, 0.61f, 0.585f};  // asphalt in the middle, paler pavements beside it
constexpr float kStreetDetail = 0.3f, kPhotoDetail = 0.5f, kSeaDetail = 0.35f;  // share of the fine structure

/// What is interpolated between samples. All floats, so that it can be mixed as an array.
struct Sample {
    glm::vec3 height_gradient{0.0f};  ///< height [m], rise per metre east, rise per metre south
    glm::vec2 land{0.0f};             ///< prominence [m], sunlight [0, 1]
    glm::vec2 sea{0.0f};              ///< share of sea, shore [m]
};

Sample mix(const Sample& a, const Sample& b, float t) {
    return {glm::mix(a.height_gradient, b.height_gradient, t), glm::mix(a.land, b.land, t),
            glm::mix(a.sea, b.sea, t)};
}

/// Everything the painting of one texel reads.
struct Painting {
    const data::HeightGrid& grid;
    const data::Image& imagery;
    Relief relief;
    Climate climate;
    glm::vec2 cell_m{1.0f};
    float steepening = 1.0f;  ///< for the light only: coarse samples have smoothed the slopes they measured
    float flat_light = 1.0f;  ///< luminance of level ground, what a photograph was taken under
    StreetCover streets{};
    int averaged = 1;  ///< samples a texel, each way
};

Sample sample_at(const Painting& painting, int col, int row) {
    const data::HeightGrid& grid = painting.grid;
    const int west = std::max(col - 1, 0), east = std::min(col + 1, grid.width - 1);
    const int north = std::max(row - 1, 0), south = std::min(row + 1, grid.height - 1);
    Sample sample;
    sample.height_gradient.x = grid.at(col, row);
    if (east > west) {
        sample.height_gradient.y =
            (grid.at(east, row) - grid.at(west, row)) / (static_cast<float>(east - west) * painting.cell_m.x);
    }
    if (south > north) {
        sample.height_gradient.z = (grid.at(col, south) - grid.at(col, north)) /
                                   (static_cast<float>(south - north) * painting.cell_m.y);
    }
    const size_t index = painting.relief.index(col, row);
    sample.land = {painting.relief.prominence_m[index],
                   static_cast<float>(painting.relief.sunlight[index]) / 255.0f};
    if (!painting.relief.shore.empty() && painting.relief.shore[index] != 255) {
        sample.sea = {1.0f, static_cast<float>(painting.relief.shore[index]) * painting.cell_m.x};
    }
    return sample;
}

/// The two rows of samples, within the relief's range, around a line of texels, made when the line moves on.
class SampleRows {
  public:
    explicit SampleRows(const Painting& painting) : painting_(painting) {}

    void move_to(double row) {
        const data::SampleRange& range = painting_.relief.range;
        const int last = range.max.y;
        const int north = std::clamp(static_cast<int>(std::floor(row)), range.min.y, last);
        part_ = std::clamp(static_cast<float>(row - north), 0.0f, 1.0f);
        if (north == row_) return;
        row_ = north;
        fill(north_, north);
        fill(south_, std::min(north + 1, last));
    }

    Sample at(double col) const {
        const int first = painting_.relief.range.min.x, last = painting_.relief.range.max.x;
        const int west = std::clamp(static_cast<int>(std::floor(col)), first, last);
        const auto w = static_cast<size_t>(west - first),
                   e = static_cast<size_t>(std::min(west + 1, last) - first);
        const float part = std::clamp(static_cast<float>(col - west), 0.0f, 1.0f);
        return mix(mix(north_[w], north_[e], part), mix(south_[w], south_[e], part), part_);
    }

  private:
    void fill(std::vector<Sample>& line, int row) {
        const data::SampleRange& range = painting_.relief.range;
        line.resize(static_cast<size_t>(range.columns()));
        for (int col = range.min.x; col <= range.max.x; ++col)
            line[static_cast<size_t>(col - range.min.x)] = sample_at(painting_, col, row);
    }

    const Painting& painting_;
    std::vector<Sample> north_, south_;
    int row_ = -1;
    float part_ = 0.0f;
};

/// Cosine to the sun of a surface with this gradient (east, south).
float cosine_to_sun(const glm::vec2& gradient) {
    const glm::vec3 normal = glm::normalize(glm::vec3(-gradient.x, gradient.y, 1.0f));
    return std::max(glm::dot(normal, glm::vec3(kSunEnu)), 0.0f);
}

/// Nearest pixel of the imagery; straight alpha in w.
glm::vec4 imagery_at(const Painting& painting, double col, double row) {
    const data::Image& image = painting.imagery;
    const int x = static_cast<int>((col + 0.5) / painting.grid.width * image.width);
    const int y = static_cast<int>((row + 0.5) / painting.grid.height * image.height);
    const auto pixel =
        static_cast<size_t>(std::clamp(y, 0, image.height - 1)) * static_cast<size_t>(image.width) +
        static_cast<size_t>(std::clamp(x, 0, image.width - 1));
    const uint8_t* p = &image.rgba[pixel * 4];
    return glm::vec4(p[0], p[1], p[2], p[3]) / 255.0f;
}

/// Display colour and, in w, how much fine structure shows. @param street  share of the spot that is street
glm::vec4 colour_at(const Painting& painting, const SampleRows& rows, const glm::dvec2& at, float street) {
    const double col = at.x, row = at.y;
    const Sample sample = rows.at(col);
    glm::vec2 gradient(sample.height_gradient.y, sample.height_gradient.z);
    GroundSpot spot;
    spot.position_m = glm::vec2(col, row) * painting.cell_m;
    spot.height_m = sample.height_gradient.x;
    spot.slope = glm::length(gradient);
    spot.prominence_m = sample.land.x;
    spot.sea = sample.sea.x;
    spot.shore_m = sample.sea.y;
    const glm::vec3 albedo = glm::mix(ground_albedo(spot, painting.climate), kStreet, street);
    float detail = glm::mix(glm::mix(1.0f, kSeaDetail, spot.sea), kStreetDetail, street);

    const float openness = std::clamp(0.85f + sample.land.x / 400.0f, 0.5f, 1.05f);
    const float lambert = cosine_to_sun(gradient * painting.steepening) * sample.land.y;
    glm::vec3 colour = lit(albedo, lambert, openness);
    if (painting.imagery.width > 0) {
        const glm::vec4 photo = imagery_at(painting, col, row);
        const float light = glm::dot(lit(glm::vec3(1.0f), lambert, openness), glm::vec3(0.3f, 0.6f, 0.1f));
        const float shading = glm::mix(1.0f, light / painting.flat_light, 0.45f);  // it has light of its own
        colour = glm::mix(colour, glm::vec3(photo) * shading, photo.w);
        detail = glm::mix(detail, kPhotoDetail, photo.w);
    }
    return glm::vec4(colour, detail);
}

/// Rows [begin, end) of a rectangle.
void paint_rows(const Painting& painting, data::Image& out, const TexelRect& rect, size_t begin, size_t end) {
    SampleRows rows(painting);
    const int averaged = painting.averaged;
    const double col_step = static_cast<double>(painting.grid.width) / out.width;
    const double row_step = static_cast<double>(painting.grid.height) / out.height;
    std::vector<glm::vec4> line(static_cast<size_t>(rect.width));
    for (size_t y = begin + static_cast<size_t>(rect.y); y < end + static_cast<size_t>(rect.y); ++y) {
        std::fill(line.begin(), line.end(), glm::vec4(0.0f));
        for (int sub_row = 0; sub_row < averaged; ++sub_row) {
            const double row = (static_cast<double>(y) + (sub_row + 0.5) / averaged) * row_step - 0.5;
            rows.move_to(row);
            for (size_t i = 0; i < line.size(); ++i) {
                const int x = rect.x + static_cast<int>(i);
                const float street = painting.streets.at(x, static_cast<int>(y));
                for (int sub_col = 0; sub_col < averaged; ++sub_col) {
                    const double col = (x + (sub_col + 0.5) / averaged) * col_step - 0.5;
                    line[i] += colour_at(painting, rows, {col, row}, street);
                }
            }
        }
        uint8_t* texel = &out.rgba[(y * static_cast<size_t>(out.width) + static_cast<size_t>(rect.x)) * 4];
        for (const glm::vec4& sum : line) {
            const glm::vec4 colour = sum / static_cast<float>(averaged * averaged);
            for (int i = 0; i < 4; ++i)
                *texel++ = static_cast<uint8_t>(std::clamp(colour[i], 0.0f, 1.0f) * 255.0f + 0.5f);
        }
    }
}

void paint_rect(const Painting& painting, data::Image& out, const TexelRect& rect, unsigned threads) {
    lod::parallel_for(static_cast<size_t>(rect.height), threads,
                      [&](size_t begin, size_t end) { paint_rows(painting, out, rect, begin, end); });
}

/// Texels per sample when finer, samples per texel when coarser; one of the two is 1.
struct Ratio {
    int finer = 1, coarser = 1;
};

Ratio ratio_of(const data::HeightGrid& grid, const data::Image& imagery,
               const GroundTextureOptions& options) {
    const int longer = std::max(grid.width, grid.height);
    Ratio ratio;
    if (longer > options.max_px) ratio.coarser = (longer + options.max_px - 1) / options.max_px;
    ratio.finer = std::max(1, options.detail_px / longer);
    const int photo = (std::max(imagery.width, imagery.height) + longer - 1) / longer;
    ratio.finer = std::max(ratio.finer, std::min(photo, options.max_px / std::max(longer, 1)));
    ratio.finer = std::clamp(ratio.finer, 1, 16);
    return ratio;
}

/// @param texture_px  size of the image
Painting make_painting(const data::HeightGrid& grid, const data::Image& imagery,
                       const GroundTextureOptions& options, Relief relief, const glm::ivec2& texture_px) {
    const double middle_col = (grid.width - 1) / 2.0, middle_row = (grid.height - 1) / 2.0;
    const double latitude_deg =
        grid.frame.world().has_datum ? grid.frame.site_from_grid(middle_col, middle_row).y : 45.0;
    Painting painting{grid, imagery, std::move(relief), climate_at(latitude_deg * std::numbers::pi / 180.0),
                      glm::vec2(grid.frame.cell_m())};
    painting.steepening = 1.0f + 1.2f * glm::smoothstep(5.0f, 90.0f, painting.cell_m.x);
    painting.flat_light =
        glm::dot(lit(glm::vec3(1.0f), static_cast<float>(kSunEnu.z), 0.85f), glm::vec3(0.3f, 0.6f, 0.1f));
    painting.streets = cover_streets(options.streets, grid, texture_px);
    painting.averaged = ratio_of(grid, imagery, options).coarser;
    return painting;
}

/// Samples that an edit may light or colour anew: with their neighbours, whose slopes change, and what they shade.
data::SampleRange touched_by(const data::HeightGrid& grid, const data::HeightBlock& before) {
    const data::SampleRange& changed = before.range;
    float low_m = before.height_m.front(), high_m = low_m;
    size_t next = 0;
    for (int row = changed.min.y; row <= changed.max.y; ++row) {
        for (int col = changed.min.x; col <= changed.max.x; ++col) {
            const float was_m = before.height_m[next++], now_m = grid.at(col, row);
            low_m = std::min({low_m, was_m, now_m});
            high_m = std::max({high_m, was_m, now_m});
        }
    }
    const data::SampleRange wide{changed.min - 1 - shadow_reach(grid, double(high_m) - double(low_m)),
                                 changed.max + 1};
    return data::common(wide, data::range_of(grid));
}

/// The texels between whose samples one of the range may be.
TexelRect texels_over(const data::HeightGrid& grid, const data::SampleRange& range,
                      const data::Image& image) {
    const auto first = [](int sample, int samples, int texels) {
        return std::clamp(static_cast<int>(std::floor((sample - 0.5) * texels / samples)), 0, texels - 1);
    };
    const auto last = [](int sample, int samples, int texels) {
        return std::clamp(static_cast<int>(std::floor((sample + 1.5) * texels / samples)), 0, texels - 1);
    };
    TexelRect rect;
    rect.x = first(range.min.x, grid.width, image.width);
    rect.y = first(range.min.y, grid.height, image.height);
    rect.width = last(range.max.x, grid.width, image.width) - rect.x + 1;
    rect.height = last(range.max.y, grid.height, image.height) - rect.y + 1;
    return rect;
}

}  // namespace

data::Image paint_ground(const data::HeightGrid& grid, const data::Image& imagery,
                         const GroundTextureOptions& options) {
    const Ratio ratio = ratio_of(grid, imagery, options);
    data::Image image;
    image.width = std::max(grid.width * ratio.finer / ratio.coarser, 1);
    image.height = std::max(grid.height * ratio.finer / ratio.coarser, 1);
    const Painting painting = make_painting(grid, imagery, options, measure_relief(grid, options.threads),
                                            {image.width, image.height});
    image.rgba.resize(static_cast<size_t>(image.width) * static_cast<size_t>(image.height) * 4);
    paint_rect(painting, image, {0, 0, image.width, image.height}, options.threads);
    return image;
}

TexelRect repaint_ground(const data::HeightGrid& grid, const data::Image& imagery,
                         const GroundTextureOptions& options, const data::HeightBlock& before,
                         data::Image& image) {
    if (before.range.is_empty() || image.width == 0) return {};
    const data::SampleRange touched = touched_by(grid, before);
    const TexelRect rect = texels_over(grid, touched, image);
    // What these texels lie between: a sample more each way, or as many as a texel is wide.
    const glm::ivec2 margin(grid.width / image.width + 2, grid.height / image.height + 2);
    const data::SampleRange read =
        data::common({touched.min - 2 * margin, touched.max + 2 * margin}, data::range_of(grid));
    const Painting painting = make_painting(
        grid, imagery, options, measure_relief(grid, read, options.threads), {image.width, image.height});
    paint_rect(painting, image, rect, options.threads);
    return rect;
}

}  // namespace sim
