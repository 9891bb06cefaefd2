// Renderer: takes a draw list and makes the picture, with one glMultiDrawElementsIndirect per view.
//
// One code path for a surfaceless EGL context (Mesa llvmpipe or a GPU) and a GLFW window; OpenGL 4.5 core.
// Reversed-Z with a 32-bit float depth buffer and an infinite far plane. The geometry pool, the command and
// instance buffers are allocated once and written through persistent maps: a warm frame makes no GL object and
// resizes none.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lod/base/result.h"
#include "lod/draw_list.h"
#include "lod/view.h"
#include "render/mip_levels.h"

namespace render {

/// What the pool holds; vertices of lod::Vertex, 32-bit indices.
struct PoolCapacity {
    uint32_t vertices = 0;
    uint32_t indices = 0;
    uint32_t commands = 4096;  ///< draw items and instances of one frame
};

struct RendererOptions {
    int width_px = 640, height_px = 360;
    bool window = false;  ///< a GLFW window instead of an offscreen target
    std::string window_title = "Harrier";
    PoolCapacity pool;
};

/// Light, air and sky of one frame. Directions in the world frame, colours linear sRGB in [0, 1].
struct Atmosphere {
    glm::dvec3 sun_world{0.0, 0.0, 1.0};       ///< towards the sun, unit length
    glm::dvec3 up_world{0.0, 0.0, 1.0};        ///< local vertical at the eye, unit length
    glm::vec3 clear_colour{1.0f, 0.0f, 1.0f};  ///< magenta where nothing is drawn: holes show
    double visibility_m = 40000.0;  ///< distance at which haze leaves 5 % of the contrast; infinite: none
    double eye_height_m = 0.0;      ///< above the ground's datum, thins the haze
    glm::ivec2 ground_sample{0};    ///< column and row near the eye, where detail is most exact
    bool draw_sky = true;           ///< false: `clear_colour` shows wherever no item draws
};

/// Neither haze nor sky: nothing shows but what is drawn.
inline Atmosphere vacuum() {
    Atmosphere air;
    air.visibility_m = std::numeric_limits<double>::infinity();
    air.draw_sky = false;
    return air;
}

/// How the fine structure of surfaces lies on the ground; a fixed function of the place, not of the view.
struct SurfaceDetail {
    glm::dvec2 cell_m{30.0};            ///< spacing of the ground's samples, east-west and north-south
    glm::dvec3 sun_enu{0.0, 0.0, 1.0};  ///< towards the sun, unit length: lights the relief of the grass
};

/// Sizes in bytes and calls of the last frame, counted by the renderer itself.
struct DrawStats {
    uint32_t draw_calls = 0;
    uint32_t commands = 0;
    uint64_t upload_bytes = 0;
    uint32_t allocations = 0;  ///< GL buffers or textures created or resized since the draw before
};

/// Pictures, top row first.
struct ColourImage {
    int width = 0, height = 0;
    std::vector<uint8_t> rgba;
};
struct DepthImage {
    int width = 0, height = 0;
    std::vector<float>
        depth_m;  ///< along the line of sight (-z eye), metres; +infinity where nothing was drawn
};

/// Every triangle of the last draw, read back from the GPU's own buffers.
struct DrawnTriangles {
    std::vector<std::array<glm::dvec3, 3>> world;  ///< metres, as drawn
    std::vector<lod::Module> module;               ///< one per triangle
};

/// Owns the GL context; one at a time per thread. Move-only.
class Renderer {
  public:
    /// Fails with one line when no OpenGL 4.5 context or no display can be had.
    static lod::Result<Renderer> create(const RendererOptions& options);
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    ~Renderer();

    /// The driver's name, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)".
    std::string device() const;
    /// Whether processors do the work of a GPU here.
    bool is_software() const;

    /// Colour of the ground, row-major from the north-west; mipmapped. Alpha says how much of its fine structure
    /// shows (set_detail). Texel centres sit on samples when the
    /// image has the grid's size; `grid_width/height` say how many samples the image spans, `lead` how
    /// many of them before the first.
    lod::Result<lod::Ok> set_ground_texture(int width, int height, std::span<const uint8_t> rgba,
                                            int grid_width, int grid_height, double lead = 0.5);

    /// Replaces texels of the ground's colour on each level, from the next draw on. Allocates nothing.
    /// CHECKs that they lie in it.
    void write_ground_texels(std::span<const TexelPatch> patches);

    /// From now on ground, roofs and walls show structure finer than their colours: grass, roofing, windows. It
    /// melts into its mean where it is smaller than a pixel. Cost: about 0.2 s, once.
    void set_detail(const SurfaceDetail& detail);

    /// Grows the pool; contents are lost. Counts as an allocation.
    lod::Result<lod::Ok> resize_pool(const PoolCapacity& pool);

    /// Waits for the previous frame where it still reads what will be overwritten, places the writes, submits
    /// the list's items with one indirect draw: opaque, then the sky, then glass from the last to the first. Glass
    /// writes depth, too.
    /// CHECKs that the view has the renderer's size and the writes lie in the pool.
    void draw(const lod::View& view, const lod::DrawList& list, const Atmosphere& atmosphere);

    /// Blocks until the last draw is complete: the honest end of a frame. Presents it when there is a window.
    void finish();

    const DrawStats& stats() const;
    ColourImage read_colour();
    DepthImage read_depth();
    DrawnTriangles read_triangles(const lod::View& view);

    /// Keys and mouse of the window since the last call; all zero without a window.
    struct Input {
        bool close = false;
        double forward = 0, right = 0, up = 0;  ///< held keys, each in [-1, 1]
        double yaw = 0, pitch = 0, roll = 0;    ///< held keys and mouse motion, each in [-1, 1]
        bool faster = false, slower = false;
        // Once for each time the key goes down.
        bool pause = false;
        bool schedule_faster = false, schedule_slower = false, schedule_reverse = false;
        bool schedule_begin = false, schedule_end = false;
    };
    Input poll_input();

  private:
    struct State;
    explicit Renderer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// Writes 8-bit RGB PNG; the file appears complete or not at all.
lod::Result<lod::Ok> write_png(const std::string& path, const ColourImage& image);

}  // namespace render
