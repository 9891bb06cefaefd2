#include "objects/cluster_sieve.h"

#include <algorithm>

#include "objects/for_each_item.h"

namespace objects {

namespace {

constexpr size_t kFramesPerStrip = 4;  ///< when it does not pay
constexpr size_t kFewest = 64;         ///< triangles that say something
/// Of all that are asked, so many must be left out for it to pay, and fewer for it to go on. On two cores it saves processor
/// time from a third on: asking takes 0.12 us a triangle, one that is hidden 0.37 us (city_flight).
constexpr double kPayingShare = 0.4, kLosingShare = 0.3;

std::span<const uint32_t> indices_of(const ClusterSieve::Scene& scene, const lod::DrawItem& item) {
    return std::span(scene.tree.indices)
        .subspan(item.first_index - scene.region.first_index, item.index_count);
}

/// Columns of the picture that a box reaches into; all when it reaches through the near plane.
lod::Columns columns_of(const ClusterSieve::Scene& scene, std::span<const glm::dvec3> box_eye) {
    lod::Columns columns{1e30f, -1e30f};
    for (const glm::dvec3& corner : box_eye) {
        if (-corner.z <= scene.sight.metric.near_m) return {};
        const double x_px = 0.5 * scene.view.width_px + scene.sight.metric.lambda_px * corner.x / -corner.z;
        columns.left_px = std::min(columns.left_px, static_cast<float>(x_px) - 1.0f);
        columns.right_px = std::max(columns.right_px, static_cast<float>(x_px) + 1.0f);
    }
    return columns;
}

bool meet(const lod::Columns& a, const lod::Columns& b) {
    return a.left_px < b.right_px && b.left_px < a.right_px;
}

}  // namespace

void ClusterSieve::begin(const lod::View& view) {
    pieces_.clear();
    kept_.clear();
    left_out_ = asked_ = 0;
    const float width_px = static_cast<float>(view.width_px) / kStrips;
    for (size_t i = 0; i < kStrips; ++i) {
        strips_[i] = {};
        if (i > 0) strips_[i].left_px = static_cast<float>(i) * width_px;
        if (i + 1 < kStrips) strips_[i].right_px = static_cast<float>(i + 1) * width_px;
    }
}

void ClusterSieve::add(const Scene& scene, const Cluster& cluster, size_t first_item,
                       const lod::DrawList& out) {
    Piece piece{.geometry = cluster.geometry, .first_item = first_item, .end_item = first_item};
    piece.first_triangle = piece.end_triangle = pieces_.empty() ? 0 : pieces_.back().end_triangle;
    // Glass comes last and stays.
    for (; piece.end_item < out.items.size() && !out.items[piece.end_item].is_glass; ++piece.end_item)
        piece.end_triangle += out.items[piece.end_item].index_count / 3;
    if (piece.end_triangle == piece.first_triangle) return;
    if (pays_ || frames_idle_ % kFramesPerStrip == 0) {
        piece.box_eye = box_in_eye(scene.tree, cluster, scene.sight, scene.time_s);
        piece.columns = columns_of(scene, piece.box_eye);
        const lod::Columns& asked = strips_[frames_idle_ / kFramesPerStrip % kStrips];
        piece.is_asked = pays_ || (asked.hold(piece.columns.left_px) && asked.hold(piece.columns.right_px));
    }
    asked_ += piece.is_asked ? piece.end_triangle - piece.first_triangle : 0;
    pieces_.push_back(piece);
}

void ClusterSieve::judge(const Scene& scene, const lod::DrawList& list, size_t strip) {
    lod::TriangleSieve& sieve = sieves_[strip];
    sieve.begin(scene.view, strips_[strip]);
    for (const Piece& piece : pieces_) {
        if (!piece.is_asked || !meet(piece.columns, strips_[strip]) || sieve.hides(piece.box_eye)) continue;
        const ClusterGeometry& geometry = scene.tree.geometries[piece.geometry];
        const auto vertices =
            std::span(scene.tree.vertices).subspan(geometry.first_vertex, geometry.vertex_count);
        size_t triangle = piece.first_triangle;
        for (size_t i = piece.first_item; i < piece.end_item; ++i) {
            const lod::DrawItem& item = list.items[i];
            const size_t count = item.index_count / 3;
            sieve.sift(vertices, indices_of(scene, item), list.instances[item.instance],
                       std::span(shows_).subspan(triangle, count));
            triangle += count;
        }
    }
}

/// Appends what may show of a piece, its indices counted from the pool's first vertex. @returns how many
uint32_t ClusterSieve::keep(const Scene& scene, const Piece& piece) {
    const size_t before = kept_.size();
    size_t triangle = piece.first_triangle;
    for (size_t i = piece.first_item; i < piece.end_item; ++i) {
        const std::span<const uint32_t> indices = indices_of(scene, items_[i]);
        const auto base = static_cast<uint32_t>(items_[i].base_vertex);
        for (size_t k = 0; k < indices.size(); ++k) {
            if (!piece.is_asked || shows_[triangle + k / 3] != 0) kept_.push_back(base + indices[k]);
        }
        triangle += indices.size() / 3;
    }
    return static_cast<uint32_t>(kept_.size() - before);
}

void ClusterSieve::replace_items(const Scene& scene, lod::DrawList& out) {
    constexpr size_t kNone = SIZE_MAX - 1;
    const uint32_t room = scene.region.first_index + static_cast<uint32_t>(scene.tree.indices.size());
    items_ = out.items;
    out.items.resize(pieces_[0].first_item);
    size_t last_kept = kNone, next = 0;
    for (size_t i = pieces_[0].first_item; i < items_.size();) {
        const bool is_piece = next < pieces_.size() && pieces_[next].first_item == i;
        const Piece& piece = pieces_[is_piece ? next++ : 0];
        const size_t triangles = piece.end_triangle - piece.first_triangle;
        if (!is_piece || kept_.size() + 3 * triangles > kRoom) {
            out.items.push_back(items_[i++]);
            continue;
        }
        const uint32_t instance = items_[i].instance, at = room + static_cast<uint32_t>(kept_.size());
        const uint32_t count = keep(scene, piece);
        left_out_ += triangles - count / 3;
        i = piece.end_item;
        if (count == 0) continue;
        const bool joins = last_kept + 1 == out.items.size() && out.items.back().instance == instance;
        if (joins)
            out.items.back().index_count += count;
        else
            out.items.push_back({count, at, 0, instance, false});
        last_kept = out.items.size() - 1;
    }
    if (!kept_.empty()) out.index_writes.push_back({room, kept_});
}

uint64_t ClusterSieve::finish(const Scene& scene, unsigned threads, lod::DrawList& out) {
    if (!pieces_.empty()) {
        shows_.assign(pieces_.back().end_triangle, 0);
        if (asked_ > 0) for_each_item(kStrips, threads, [&](size_t strip) { judge(scene, out, strip); });
        replace_items(scene, out);
    }
    learn();
    return left_out_;
}

void ClusterSieve::learn() {
    frames_idle_ = pays_ ? 0 : frames_idle_ + 1;
    if (asked_ >= kFewest)
        pays_ = static_cast<double>(left_out_) >=
                (pays_ ? kLosingShare : kPayingShare) * static_cast<double>(asked_);
}

uint64_t ClusterSieve::memory_bytes() const {
    return pieces_.capacity() * sizeof(Piece) + shows_.capacity() + kept_.capacity() * sizeof(uint32_t) +
           items_.capacity() * sizeof(lod::DrawItem);
}

}  // namespace objects
