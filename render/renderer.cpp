#include "render/renderer.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/drawn_triangles.h"
#include "render/egl_context.h"
#include "render/freed_memory.h"
#include "render/geometry_pool.h"
#include "render/ground_texture.h"
#include "render/guard_band.h"
#include "render/indirect_pass.h"
#include "render/pattern_texture.h"
#include "render/target.h"
#include "render/window.h"

namespace render {

/// Members are destroyed from the last to the first: the context, which all others need, goes last.
struct Renderer::State {
    std::optional<EglContext> egl;  ///< one of these two has the context
    std::optional<Window> window;
    Target target;
    int guard_ratio = 1;  ///< of the target
    GeometryPool pool;
    PoolCapacity pool_capacity;
    IndirectPass pass;
    SurfaceTextures textures;
    Ground ground;
    bool has_textures = false;  ///< others than the plain ones to begin with
    Fence in_flight;            ///< end of the last draw, while it may still read the buffers
    DrawStats stats;
    uint32_t allocations_since_draw = 0;
    double drawn_near_m = 0.1;
};

namespace {

constexpr uint32_t kFirstAllocations = 9;  ///< two renderbuffers, five buffers, two textures

bool is_software_rasteriser(const std::string& device) {
    return device.find("llvmpipe") != std::string::npos || device.find("softpipe") != std::string::npos;
}

std::string device_name() {
    const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return name != nullptr ? name : "unknown device";
}

lod::Result<lod::Ok> check_driver() {
    if (epoxy_gl_version() < 45) {
        return lod::Error{"driver " + device_name() + " is too old, expected OpenGL 4.5"};
    }
    return lod::Ok{};
}

/// Linear light to display value. Source: IEC 61966-2-1 (sRGB).
float encode_srgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

void clear(const Target& target, const glm::vec3& colour) {
    const float display[4] = {encode_srgb(colour.x), encode_srgb(colour.y), encode_srgb(colour.z), 1.0f};
    const float infinitely_far = 0.0f;
    glClearNamedFramebufferfv(target.framebuffer.id(), GL_COLOR, 0, display);
    glClearNamedFramebufferfv(target.framebuffer.id(), GL_DEPTH, 0, &infinitely_far);
}

/// Doubles until `needed` fits, so that a growing scene grows seldom.
uint32_t grown_capacity(uint32_t capacity, size_t needed) {
    size_t grown = std::max<size_t>(capacity, 1);
    while (grown < needed)
        grown *= 2;
    return static_cast<uint32_t>(grown);
}

}  // namespace

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

lod::Result<Renderer> Renderer::create(const RendererOptions& options) {
    auto state = std::make_unique<State>();
    if (options.window) {
        auto window = Window::create(options.width_px, options.height_px, options.window_title);
        if (!window) return window.error();
        state->window.emplace(std::move(*window));
    } else {
        auto egl = EglContext::create();
        if (!egl) return egl.error();
        state->egl.emplace(std::move(*egl));
    }
    if (auto driver = check_driver(); !driver) return driver.error();
    if (is_software_rasteriser(device_name())) keep_freed_memory();

    auto target = make_target(options.width_px, options.height_px);
    if (!target) return target.error();
    state->target = std::move(*target);
    state->guard_ratio = guard_ratio(options.width_px, options.height_px);
    auto pool = make_geometry_pool(options.pool);
    if (!pool) return pool.error();
    state->pool = std::move(*pool);
    state->pool_capacity = options.pool;
    auto pass = make_indirect_pass(options.pool.commands);
    if (!pass) return pass.error();
    state->pass = std::move(*pass);
    state->textures.patterns = make_plain_patterns();
    state->allocations_since_draw = kFirstAllocations - 1;

    Renderer renderer(std::move(state));
    constexpr std::array<uint8_t, 4> kWhite{255, 255, 255, 255};
    if (auto ground = renderer.set_ground_texture(1, 1, kWhite, 1, 1); !ground) return ground.error();
    renderer.state_->has_textures = false;
    return renderer;
}

std::string Renderer::device() const {
    return device_name();
}

bool Renderer::is_software() const {
    return is_software_rasteriser(device_name());
}

lod::Result<lod::Ok> Renderer::set_ground_texture(int width, int height, std::span<const uint8_t> rgba,
                                                  int grid_width, int grid_height, double lead) {
    CHECK(grid_width > 0 && grid_height > 0);
    auto texture = make_ground_texture(width, height, rgba, is_software());
    if (!texture) return texture.error();
    state_->textures.ground = std::move(*texture);
    state_->has_textures = true;
    state_->ground.grid_width = grid_width;
    state_->ground.grid_height = grid_height;
    state_->ground.lead = lead;
    ++state_->allocations_since_draw;
    return lod::Ok{};
}

void Renderer::write_ground_texels(std::span<const TexelPatch> patches) {
    for (const TexelPatch& patch : patches)
        write_texels(state_->textures.ground, patch);
}

void Renderer::set_detail(const SurfaceDetail& detail) {
    state_->in_flight.wait();
    state_->ground.detail = detail;
    state_->textures.patterns = make_patterns(detail, is_software());
    state_->has_textures = true;
    ++state_->allocations_since_draw;
}

lod::Result<lod::Ok> Renderer::resize_pool(const PoolCapacity& capacity) {
    State& state = *state_;
    state.in_flight.wait();
    auto pool = make_geometry_pool(capacity);
    if (!pool) return pool.error();
    state.pool = std::move(*pool);
    state.allocations_since_draw += 2;
    if (capacity.commands > command_capacity(state.pass)) {
        if (auto resized = resize_commands(capacity.commands, state.pass); !resized) return resized.error();
        state.allocations_since_draw += 2;
    }
    state.pass.command_count = 0;
    return lod::Ok{};
}

void Renderer::draw(const lod::View& view, const lod::DrawList& list, const Atmosphere& atmosphere) {
    State& state = *state_;
    CHECK(view.width_px == state.target.width_px && view.height_px == state.target.height_px);
    state.in_flight.wait();

    const size_t needed = std::max(list.items.size(), list.instances.size());
    if (needed > command_capacity(state.pass)) {
        const auto grown = resize_commands(grown_capacity(command_capacity(state.pass), needed), state.pass);
        CHECK(bool(grown));
        state.allocations_since_draw += 2;
    }
    const FrameBlock frame = frame_block_of(view, atmosphere, state.ground, state.guard_ratio);
    uint64_t upload_bytes = place_writes(list, state.pool);
    upload_bytes += upload_frame(list, state.pool, frame, atmosphere.draw_sky, state.pass);

    clear(state.target, atmosphere.clear_colour);
    glBindFramebuffer(GL_FRAMEBUFFER, state.target.framebuffer.id());
    set_viewport(state.target.width_px, state.target.height_px, state.guard_ratio);
    const bool has_air = atmosphere.draw_sky || std::isfinite(atmosphere.visibility_m);
    submit(state.pool, state.textures, {state.has_textures, has_air}, state.pass);
    state.in_flight.place();

    state.drawn_near_m = view.near_m;
    state.stats = {.draw_calls = 1,
                   .commands = state.pass.command_count,
                   .upload_bytes = upload_bytes,
                   .allocations = std::exchange(state.allocations_since_draw, 0)};
}

void Renderer::finish() {
    state_->in_flight.wait();
    if (!state_->window) return;
    const Target& target = state_->target;
    state_->window->present(target.framebuffer.id(), target.width_px, target.height_px);
}

const DrawStats& Renderer::stats() const {
    return state_->stats;
}

ColourImage Renderer::read_colour() {
    return render::read_colour(state_->target);
}

DepthImage Renderer::read_depth() {
    return render::read_depth(state_->target, state_->drawn_near_m);
}

DrawnTriangles Renderer::read_triangles(const lod::View& view) {
    State& state = *state_;
    state.in_flight.wait();
    const auto commands = state.pass.commands.read(0, state.pass.command_count);
    const auto instances = state.pass.instances.read(0, state.pass.instance_count);
    const auto vertices = state.pool.vertices.read(0, state.pool.vertices.size());
    const auto indices = state.pool.indices.read(0, state.pool.indices.size());
    return triangles_of({commands, instances, vertices, indices}, view);
}

Renderer::Input Renderer::poll_input() {
    return state_->window ? state_->window->poll() : Input{};
}

}  // namespace render
