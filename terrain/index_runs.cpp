#include "terrain/index_runs.h"

#include "lod/base/check.h"

namespace terrain {
namespace {

/// What the pool holds where nothing has been written yet: differs from everything.
constexpr uint32_t kUnknown = 0xffffffffu;

/// Negative where `point` lies on the left corner's side of the line from the apex to the middle.
int64_t side_of(const RunNode& node, GridPoint middle, GridPoint point) {
    const GridPoint apex = node.points[0];
    return int64_t{middle.x - apex.x} * (point.y - apex.y) - int64_t{middle.y - apex.y} * (point.x - apex.x);
}

GridPoint middle_of(const RunNode& node) {
    return {(node.points[1].x + node.points[2].x) / 2, (node.points[1].y + node.points[2].y) / 2};
}

}  // namespace

void IndexRuns::reset(uint32_t capacity) {
    list_.assign(capacity, kUnknown);
    fresh_.reserve(capacity);
    nodes_.reserve(2 * most_runs());
    free_pairs_.reserve(most_runs());
    changed_.reserve(most_runs());
    mark_all();
}

void IndexRuns::mark(GridPoint centre) {
    if (is_all_marked_) return;
    if (++mark_count_ > nodes_.size() / 2) return mark_all();  // cheaper than to find each
    mark_below(0, centre);
    mark_below(1, centre);
}

/// Two triangles have the centre on their hypotenuse: goes down to both.
void IndexRuns::mark_below(uint32_t id, GridPoint centre) {
    while (true) {
        RunNode& node = nodes_[id];
        const GridPoint middle = middle_of(node);
        const int64_t side = side_of(node, middle, centre);
        node.is_stale = true;
        if (middle == centre) node.is_hit = true;
        if (middle == centre || node.is_run()) return;
        if (side == 0) mark_below(node.children + 1, centre);
        id = node.children + (side > 0 ? 1 : 0);
    }
}

uint32_t IndexRuns::add_pair() {
    if (free_pairs_.empty()) {
        nodes_.resize(nodes_.size() + 2);
        return static_cast<uint32_t>(nodes_.size() - 2);
    }
    const uint32_t pair = free_pairs_.back();
    free_pairs_.pop_back();
    return pair;
}

RunNode IndexRuns::node_of(const Work& work, const BintreeTriangle& triangle, const Built& built) const {
    RunNode node;
    node.triangle = triangle;
    node.points = {work.mesh[triangle.apex].centre(), work.mesh[triangle.left].centre(),
                   work.mesh[triangle.right].centre()};
    node.children = built.children;
    node.count = built.count;
    node.fresh = built.children == 0 ? built.fresh : RunNode::kPlaced;
    return node;
}

/// Writes the leaves below a triangle; those of two children stay one run while they are few.
IndexRuns::Built IndexRuns::build(const Work& work, const BintreeTriangle& triangle) {
    const auto begin = static_cast<uint32_t>(fresh_.size());
    if (is_leaf(work.mesh, triangle)) {
        work.writer.write(triangle);
        return {begin, static_cast<uint32_t>(fresh_.size()) - begin, 0};
    }
    const auto [left, right] = children_of(work.mesh, triangle);
    const Built first = build(work, left), second = build(work, right);
    if (first.children == 0 && second.children == 0 && first.count + second.count <= kMost)
        return {first.fresh, first.count + second.count, 0};
    const uint32_t pair = add_pair();
    nodes_[pair] = node_of(work, left, first);
    nodes_[pair + 1] = node_of(work, right, second);
    return {0, first.count + second.count, pair};
}

/// What was drawn of a node is gone, and what hung below it.
void IndexRuns::retire(const Work& work, const RunNode& node) {
    if (node.is_run()) {
        const bool is_placed = node.fresh == RunNode::kPlaced;
        const std::span<const uint32_t> all(is_placed ? list_ : fresh_);
        return work.writer.release(all.subspan(is_placed ? node.first : node.fresh, node.count));
    }
    retire(work, nodes_[node.children]);
    retire(work, nodes_[node.children + 1]);
    free_pairs_.push_back(node.children);
}

void IndexRuns::rebuild(const Work& work, uint32_t id) {
    const RunNode old = nodes_[id];
    const Built built = build(work, old.triangle);
    retire(work, old);
    RunNode& node = nodes_[id];
    node = node_of(work, old.triangle, built);
    node.first = old.first;
    node.room = old.room;
    node.lacks_room = !node.is_run() || node.count > node.room;
}

void IndexRuns::rebuild_all(const Work& work) {
    is_all_marked_ = false;
    work.writer.patches.clear();
    fresh_.clear();
    nodes_.resize(2);
    free_pairs_.clear();
    for (int half = 0; half < 2; ++half) {
        const BintreeTriangle root = root_triangle(work.mesh, half);
        const Built built = build(work, root);
        nodes_[static_cast<size_t>(half)] = node_of(work, root, built);
        nodes_[static_cast<size_t>(half)].lacks_room = true;
    }
    CHECK(!work.writer.patches.is_overfull());
}

/// Bottom-up over what is stale: contents first, then their places.
void IndexRuns::refresh(const Work& work, uint32_t id) {
    if (!nodes_[id].is_stale) return;
    nodes_[id].has_news = true;
    const uint32_t pair = nodes_[id].children;
    if (pair == 0 || nodes_[id].is_hit) {
        rebuild(work, id);
        return make_room(id);
    }
    refresh(work, pair);
    refresh(work, pair + 1);
    const RunNode &left = nodes_[pair], &right = nodes_[pair + 1];
    RunNode& node = nodes_[id];
    node.is_stale = false;
    node.count = left.count + right.count;
    node.lacks_room = left.lacks_room || right.lacks_room;
    if (left.is_run() && right.is_run() && node.count < kFew) rebuild(work, id);
    make_room(id);
}

void IndexRuns::update(const DiamondMesh& mesh, const LeafWriter& writer) {
    DCHECK(&writer.indices == &fresh_);
    const Work work{mesh, writer};
    writer.patches.begin();
    fresh_.clear();
    changed_.clear();
    mark_count_ = 0;
    if (!is_all_marked_ && !nodes_[0].is_stale && !nodes_[1].is_stale) return;
    if (!is_all_marked_) {
        refresh(work, 0);
        refresh(work, 1);
    }
    // For a while there are vertices of what goes beside those of what comes: alone they fit.
    if (is_all_marked_ || writer.patches.is_overfull()) rebuild_all(work);
    const uint32_t count = nodes_[0].count + nodes_[1].count, room = nodes_[0].room + nodes_[1].room;
    if (nodes_[0].lacks_room || nodes_[1].lacks_room || room > 2 * count + kMost) make_room_for_all();
    writer.patches.sweep();
    put_below(0);
    put_below(1);
}

}  // namespace terrain
