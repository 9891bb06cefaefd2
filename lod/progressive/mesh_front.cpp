#include "lod/progressive/mesh_front.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lod/base/check.h"
#include "lod/base/hash.h"
#include "lod/screen_error.h"

namespace lod {

MeshFront::MeshFront(Module module, std::vector<ProgressiveMesh> meshes,
                     std::span<const MeshPlacement> placements, const MeshOptions& options)
    : module_(module), meshes_(std::move(meshes)) {
    scale_.reference_px =
        options.ranks.tolerance_px > 0.0 ? static_cast<float>(options.ranks.tolerance_px) : 1.0f;
    bodies_.reserve(placements.size());
    for (const MeshPlacement& placement : placements) {
        CHECK(placement.mesh < meshes_.size());
        bodies_.emplace_back(meshes_[placement.mesh], placement, options);
    }
    worst_.places.resize(bodies_.size());
    cheapest_.places.resize(bodies_.size());
    worst_.unasked.reserve(bodies_.size());
    cheapest_.unasked.reserve(bodies_.size());
}

void MeshFront::set_pose(uint32_t body, const BodyPose& pose) {
    CHECK(body < bodies_.size());
    bodies_[body].pose = pose;
}

void MeshFront::BodyQueue::move(uint32_t body, bool is_queued, Bucket bucket) {
    Place& place = places[body];
    place.is_asked = true;
    if (place.is_queued && is_queued && place.bucket == bucket) return;
    if (place.is_queued) queue.remove(places, body, place.bucket);
    place.is_queued = is_queued;
    place.bucket = bucket;
    if (is_queued) queue.push(places, body, bucket);
}

namespace {

/// Where an error falls among those of other bodies. The queues' own edges: a bucket's error is inside of it.
Bucket bucket_of(const BucketScale& scale, double error_px) {
    if (error_px <= 0.0) return kHiddenBucket;
    return scale.bucket_of(static_cast<float>(std::min(error_px, 1e30)));
}

}  // namespace

void MeshFront::BodyQueue::forget(uint32_t body) {
    if (!places[body].is_asked) return;
    places[body].is_asked = false;
    unasked.push_back(body);
}

/// The body has changed: it is asked for an end of its queues, which evaluates the heads, when somebody wants to know.
void MeshFront::forget(uint32_t body) {
    worst_.forget(body);
    cheapest_.forget(body);
}

void MeshFront::ask_worst() {
    for (uint32_t body : worst_.unasked) {
        const double error_px = bodies_[body].body.refine_error_px();
        worst_.move(body, error_px > 0.0, bucket_of(scale_, error_px));
    }
    worst_.unasked.clear();
}

void MeshFront::ask_cheapest() {
    for (uint32_t body : cheapest_.unasked) {
        const double error_px = bodies_[body].body.coarsen_error_px();
        cheapest_.move(body, std::isfinite(error_px), bucket_of(scale_, error_px));
    }
    cheapest_.unasked.clear();
}

void MeshFront::begin_frame(std::span<const View> views, double time_s) {
    CHECK(!views.empty());
    is_first_view_ = true;
    triangles_ = 0;
    for (uint32_t body = 0; body < body_count(); ++body) {
        Entry& entry = bodies_[body];
        views_body_.clear();
        for (const View& view : views)
            views_body_.push_back(view_from_body(view, entry.pose));
        const bool was_asleep = entry.body.is_asleep();
        entry.body.begin_frame(views_body_, time_s);
        triangles_ += entry.body.triangles();
        if (!was_asleep || !entry.body.is_asleep()) forget(body);
    }
}

double MeshFront::refine_error_px() {
    ask_worst();
    if (worst_.queue.is_empty()) return 0.0;
    return bodies_[worst_.queue.head(worst_.queue.highest())].body.refine_error_px();
}

double MeshFront::coarsen_error_px() {
    ask_cheapest();
    if (cheapest_.queue.is_empty()) return std::numeric_limits<double>::infinity();
    return bodies_[cheapest_.queue.head(cheapest_.queue.lowest())].body.coarsen_error_px();
}

Step MeshFront::account(uint32_t body, const Step& step) {
    triangles_ = static_cast<uint64_t>(static_cast<int64_t>(triangles_) + step.triangle_delta);
    forget(body);
    return step;
}

Step MeshFront::refine() {
    ask_worst();
    if (worst_.queue.is_empty()) return {};
    const uint32_t body = worst_.queue.head(worst_.queue.highest());
    return account(body, bodies_[body].body.refine());
}

Step MeshFront::coarsen(double limit_px) {
    if (coarsen_error_px() > limit_px) return {};
    const uint32_t body = cheapest_.queue.head(cheapest_.queue.lowest());
    return account(body, bodies_[body].body.coarsen(limit_px));
}

double MeshFront::error_px() {
    double worst = 0.0;
    for (const Entry& entry : bodies_)
        worst = std::max(worst, entry.body.error_px());
    return worst;
}

uint64_t MeshFront::leaving_triangles() const {
    uint64_t sum = 0;
    for (const Entry& entry : bodies_)
        sum += entry.body.leaving_triangles();
    return sum;
}

double MeshFront::jump_px() const {
    double farthest = 0.0;
    for (const Entry& entry : bodies_)
        farthest = std::max(farthest, entry.body.jump_px());
    return farthest;
}

OperationCounts MeshFront::operations() const {
    OperationCounts sum;
    for (const Entry& entry : bodies_) {
        for (size_t kind = 0; kind < sum.count.size(); ++kind)
            sum.count[kind] += entry.body.operations().count[kind];
    }
    return sum;
}

uint64_t MeshFront::hash() const {
    uint64_t hash = bodies_.size();
    for (const Entry& entry : bodies_)
        hash = hash_combine(hash, entry.body.cut().hash());
    return hash;
}

uint64_t MeshFront::evaluations() const {
    uint64_t sum = 0;
    for (const Entry& entry : bodies_)
        sum += entry.body.ranks().evaluations();
    return sum;
}

PoolRegion MeshFront::pool_need() const {
    PoolRegion need;
    for (const Entry& entry : bodies_) {
        const PoolRegion own = MeshSheet::need(entry.body.cut().mesh());
        need.vertex_capacity += own.vertex_capacity;
        need.index_capacity += own.index_capacity;
    }
    return need;
}

void MeshFront::place(const PoolRegion& region) {
    PoolRegion rest = region;
    for (Entry& entry : bodies_) {
        PoolRegion own = MeshSheet::need(entry.body.cut().mesh());
        CHECK(own.vertex_capacity <= rest.vertex_capacity && own.index_capacity <= rest.index_capacity);
        own.first_vertex = rest.first_vertex;
        own.first_index = rest.first_index;
        entry.sheet.place(own);
        rest.first_vertex += own.vertex_capacity;
        rest.vertex_capacity -= own.vertex_capacity;
        rest.first_index += own.index_capacity;
        rest.index_capacity -= own.index_capacity;
    }
}

/// What changed since the last frame, of all bodies that are awake.
void MeshFront::write(DrawList& out) {
    staged_.clear();
    for (Entry& entry : bodies_) {
        if (entry.body.is_asleep()) continue;
        entry.sheet.update(entry.body.cut(), entry.body.glides(), entry.body.strayed(), staged_);
        entry.body.strayed().clear();
    }
    staged_.append_to(out);
}

void MeshFront::emit(const View& view, DrawList& out) {
    if (is_first_view_) write(out);
    is_first_view_ = false;
    emitted_ = 0;
    const ViewMetric metric = metric_of(view);
    for (const Entry& entry : bodies_) {
        if (entry.body.is_asleep()) continue;
        const ProgressiveMesh& mesh = entry.body.cut().mesh();
        const Sphere sphere = sphere_in_eye({mesh.centre, mesh.radius_m}, entry.pose, metric);
        if (distance_outside_m(metric, sphere.centre, sphere.radius_m) > 0.0) continue;
        entry.sheet.emit(static_cast<uint32_t>(out.instances.size()), out.items);
        out.instances.push_back(make_body_instance(view, entry.pose, module_));
        emitted_ += entry.body.cut().triangle_count();
    }
}

std::string MeshFront::validate() const {
    uint64_t triangles = 0;
    for (uint32_t body = 0; body < body_count(); ++body) {
        const Entry& entry = bodies_[body];
        const std::string name = "body " + std::to_string(body) + ": ";
        if (!is_valid(entry.pose)) return name + "its pose is not a rotation times a scale and a place";
        std::string fault = entry.body.validate();
        if (fault.empty()) fault = entry.sheet.validate(entry.body.cut());
        if (!fault.empty()) return name + fault;
        triangles += entry.body.triangles();
    }
    return triangles == triangles_ ? "" : "the triangles of all bodies are miscounted";
}

}  // namespace lod
