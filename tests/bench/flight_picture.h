// Pictures of a flight over a planar raster, before a magenta background, and the holes in them.
//
// The drawn surface is continuous over the raster and nowhere below its lowest sample: a ray that meets that height over
// the raster has met the surface before, so its pixel must be covered.
#pragma once

#include <cmath>

#include "lod/front.h"
#include "render/renderer.h"
#include "terrain/diamond_table.h"

namespace bench {

class FlightPicture {
  public:
    /// @param pool  of all the fronts that are drawn
    static lod::Result<FlightPicture> create(int width_px, int height_px, const render::PoolCapacity& pool) {
        render::RendererOptions options;
        options.width_px = width_px;
        options.height_px = height_px;
        options.pool = pool;
        auto renderer = render::Renderer::create(options);
        if (!renderer) return renderer.error();
        return FlightPicture(std::move(*renderer), width_px, height_px);
    }

    lod::View sized(lod::View view) const {
        view.width_px = width_px_;
        view.height_px = height_px_;
        return view;
    }

    /// Emits, draws, and waits until the picture is complete.
    void draw(lod::Front& front, const lod::View& view) {
        list_.clear();
        front.emit(view, list_);
        renderer_.draw(view, list_, render::vacuum());
        renderer_.finish();
    }

    /// Background pixels of the last picture where ground must be; `expected` grows by how many must be ground.
    uint64_t hole_pixels(const terrain::DiamondTable& table, const lod::View& view, uint64_t& expected) {
        const render::ColourImage image = renderer_.read_colour();
        uint64_t holes = 0;
        for (int y = 0; y < height_px_; ++y) {
            for (int x = 0; x < width_px_; ++x) {
                if (!must_be_ground(table, view, x, y)) continue;
                ++expected;
                const uint8_t* rgba = &image.rgba[4 * static_cast<size_t>(y * width_px_ + x)];
                if (rgba[0] == 255 && rgba[1] == 0 && rgba[2] == 255) ++holes;
            }
        }
        return holes;
    }

  private:
    static constexpr double kMargin_cells = 3.0;

    FlightPicture(render::Renderer renderer, int width_px, int height_px)
        : renderer_(std::move(renderer)), width_px_(width_px), height_px_(height_px) {}

    bool must_be_ground(const terrain::DiamondTable& table, const lod::View& view, int x, int y) const {
        const double tan_y = std::tan(view.fov_y_rad / 2.0);
        const glm::dvec3 ray_eye((x + 0.5 - width_px_ / 2.0) * 2.0 * tan_y / height_px_,
                                 (height_px_ / 2.0 - y - 0.5) * 2.0 * tan_y / height_px_, -1.0);
        const glm::dvec3 ray = glm::transpose(view.eye_from_world) * ray_eye;
        if (ray.z >= 0.0) return false;
        const glm::dvec3 at = view.eye_world + ray * ((double(table.min_m) - view.eye_world.z) / ray.z);
        const glm::dvec2 margin = kMargin_cells * table.frame.cell_m();
        const glm::dvec3 first = table.frame.world_from_sample(0, table.domain.height - 1, 0.0);
        const glm::dvec3 last = table.frame.world_from_sample(table.domain.width - 1, 0, 0.0);
        return at.x > first.x + margin.x && at.x < last.x - margin.x && at.y > first.y + margin.y &&
               at.y < last.y - margin.y;
    }

    render::Renderer renderer_;
    int width_px_, height_px_;
    lod::DrawList list_;
};

}  // namespace bench
