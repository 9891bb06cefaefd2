#include "lod/rigid_front.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lod/base/check.h"
#include "lod/base/hash.h"
#include "lod/screen_error.h"

namespace lod {

namespace {

constexpr uint32_t kNoInstance = UINT32_MAX;

/// Around the bounding box's centre; the margin covers the rounding of its own computation.
Sphere bounding_sphere(std::span<const Vertex> vertices) {
    if (vertices.empty()) return {};
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const Vertex& vertex : vertices) {
        low = glm::min(low, position_of(vertex));
        high = glm::max(high, position_of(vertex));
    }
    Sphere sphere{(low + high) * 0.5, 0.0};
    for (const Vertex& vertex : vertices) {
        sphere.radius_m = std::max(sphere.radius_m, glm::distance(position_of(vertex), sphere.centre));
    }
    sphere.radius_m += 1e-15 * glm::length(sphere.centre);
    return sphere;
}

uint64_t hash_of(std::span<const Vertex> vertices, std::span<const uint32_t> indices) {
    const auto bytes_of = [](const auto& items) {
        return std::span(reinterpret_cast<const unsigned char*>(items.data()), items.size_bytes());
    };
    return hash_bytes(bytes_of(indices), hash_bytes(bytes_of(vertices)));
}

}  // namespace

RigidFront::RigidFront(Module module, std::vector<RigidPart> parts, std::vector<BodyPose> bodies)
    : module_(module), bodies_(std::move(bodies)), instance_of_body_(bodies_.size(), kNoInstance) {
    size_t vertex_count = 0, index_count = 0;
    for (const RigidPart& part : parts) {
        vertex_count += part.vertices.size();
        index_count += part.indices.size();
    }
    CHECK(vertex_count <= INT32_MAX && index_count <= UINT32_MAX);
    vertices_.reserve(vertex_count);
    indices_.reserve(index_count);
    parts_.reserve(parts.size());
    for (const RigidPart& part : parts) {
        CHECK(part.body < bodies_.size() && part.indices.size() % 3 == 0);
        for (uint32_t index : part.indices)
            CHECK(index < part.vertices.size());
        const Sphere sphere = bounding_sphere(part.vertices);
        parts_.push_back({.centre = sphere.centre,
                          .radius_m = sphere.radius_m,
                          .body = part.body,
                          .first_vertex = static_cast<uint32_t>(vertices_.size()),
                          .vertex_count = static_cast<uint32_t>(part.vertices.size()),
                          .first_index = static_cast<uint32_t>(indices_.size()),
                          .index_count = static_cast<uint32_t>(part.indices.size()),
                          .is_glass = part.is_glass});
        vertices_.insert(vertices_.end(), part.vertices.begin(), part.vertices.end());
        indices_.insert(indices_.end(), part.indices.begin(), part.indices.end());
    }
    triangles_ = index_count / 3;
    hash_ = hash_of(vertices_, indices_);
}

void RigidFront::set_pose(uint32_t body, const BodyPose& pose) {
    CHECK(body < bodies_.size());
    bodies_[body] = pose;
}

void RigidFront::rewrite(uint32_t part, uint32_t first_vertex, std::span<const Vertex> vertices) {
    CHECK(part < parts_.size());
    Placed& placed = parts_[part];
    CHECK(vertices.size() <= placed.vertex_count && first_vertex <= placed.vertex_count - vertices.size());
    const uint32_t first = placed.first_vertex + first_vertex;
    const std::span<Vertex> old = std::span(vertices_).subspan(first, vertices.size());
    hash_ ^= hash_combine(hash_of(old, {}), first);
    std::copy(vertices.begin(), vertices.end(), old.begin());
    hash_ ^= hash_combine(hash_of(old, {}), first);
    const Sphere sphere =
        bounding_sphere(std::span(vertices_).subspan(placed.first_vertex, placed.vertex_count));
    placed.centre = sphere.centre;
    placed.radius_m = sphere.radius_m;
    rewritten_.push_back({first, static_cast<uint32_t>(vertices.size())});
}

void RigidFront::set_ground_error_px(double error_px) {
    ground_error_px_ = error_px;
}

void RigidFront::set_up_world(const glm::dvec3& up_world) {
    up_world_ = glm::normalize(up_world);
}

void RigidFront::begin_frame(std::span<const View>, double) {}

double RigidFront::coarsen_error_px() {
    return std::numeric_limits<double>::infinity();
}

uint64_t RigidFront::hash() const {
    return hash_;
}

PoolRegion RigidFront::pool_need() const {
    return {.vertex_capacity = static_cast<uint32_t>(vertices_.size()),
            .index_capacity = static_cast<uint32_t>(indices_.size())};
}

void RigidFront::place(const PoolRegion& region) {
    CHECK(region.vertex_capacity >= vertices_.size() && region.index_capacity >= indices_.size());
    region_ = region;
    is_written_ = false;
}

bool RigidFront::is_outside(const Placed& part, const ViewMetric& metric) const {
    const Sphere sphere = sphere_in_eye({part.centre, part.radius_m}, bodies_[part.body], metric);
    const double reach_m = glm::length(sphere.centre) + sphere.radius_m;
    const double lowered_m =
        ground_error_px_ * reach_m / metric.lambda_px;  // feet of walls may hang this deep
    return distance_outside_m(metric, sphere.centre, sphere.radius_m + lowered_m) > 0.0;
}

Instance RigidFront::instance_of(const BodyPose& pose, const View& view) const {
    Instance instance = make_body_instance(view, pose, module_);
    const glm::dvec3 up_eye = view.eye_from_world * up_world_;
    for (int axis = 0; axis < 3; ++axis)
        instance.up_eye[axis] = static_cast<float>(up_eye[axis]);
    instance.up_eye[3] = static_cast<float>(ground_error_px_);
    return instance;
}

void RigidFront::emit_writes(DrawList& out) {
    if (is_written_) {
        for (const VertexRange& range : rewritten_) {
            out.vertex_writes.push_back(
                {region_.first_vertex + range.first, std::span(vertices_).subspan(range.first, range.count)});
        }
    }
    rewritten_.clear();
    if (is_written_ || vertices_.empty()) return;
    CHECK(region_.vertex_capacity >= vertices_.size());  // place() comes before the first emit
    out.vertex_writes.push_back({region_.first_vertex, vertices_});
    out.index_writes.push_back({region_.first_index, indices_});
    is_written_ = true;
}

void RigidFront::emit(const View& view, DrawList& out) {
    emit_writes(out);
    emitted_ = 0;
    const ViewMetric metric = metric_of(view);
    std::fill(instance_of_body_.begin(), instance_of_body_.end(), kNoInstance);
    for (const Placed& part : parts_) {
        if (part.index_count == 0 || is_outside(part, metric)) continue;
        uint32_t& instance = instance_of_body_[part.body];
        if (instance == kNoInstance) {
            instance = static_cast<uint32_t>(out.instances.size());
            out.instances.push_back(instance_of(bodies_[part.body], view));
        }
        out.items.push_back({.index_count = part.index_count,
                             .first_index = region_.first_index + part.first_index,
                             .base_vertex = static_cast<int32_t>(region_.first_vertex + part.first_vertex),
                             .instance = instance,
                             .is_glass = part.is_glass});
        emitted_ += part.index_count / 3;
    }
}

std::string RigidFront::validate() const {
    for (size_t body = 0; body < bodies_.size(); ++body) {
        if (!is_valid(bodies_[body])) {
            return "body " + std::to_string(body) + ": its pose is not a rotation times a scale and a place";
        }
    }
    for (size_t index = 0; index < parts_.size(); ++index) {
        const Placed& part = parts_[index];
        for (const Vertex& vertex : std::span(vertices_).subspan(part.first_vertex, part.vertex_count)) {
            if (glm::distance(position_of(vertex), part.centre) <= part.radius_m + 1e-6) continue;
            return "part " + std::to_string(index) + ": a vertex lies outside its sphere, or is not a number";
        }
        for (uint32_t corner : std::span(indices_).subspan(part.first_index, part.index_count)) {
            if (corner >= part.vertex_count)
                return "part " + std::to_string(index) + ": an index beyond its vertices";
        }
    }
    return {};
}

}  // namespace lod
