#include "terrain/rivals/block_ladder.h"

#include <cmath>
#include <limits>

#include "lod/base/check.h"
#include "lod/base/hash.h"

namespace terrain {
namespace {

constexpr double kFlat_px = 1e-30;  ///< worth refining at tolerance 0 only
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

void Ladders::add(std::span<const Rung> block_rungs) {
    rungs.insert(rungs.end(), block_rungs.begin(), block_rungs.end());
    first.push_back(static_cast<uint32_t>(rungs.size()));
    for (size_t i = rungs.size() - 1; i-- > rungs.size() - block_rungs.size();) {
        rungs[i].error_m = std::max(rungs[i].error_m, rungs[i + 1].error_m);
        for (int side = 0; side < 4; ++side) {
            rungs[i].side_error_m[side] =
                std::max(rungs[i].side_error_m[side], rungs[i + 1].side_error_m[side]);
        }
    }
}

LadderFront::LadderFront(const data::HeightGrid& grid, const BlockGrid& blocks)
    : grid_(grid),
      blocks_(blocks),
      sights_(blocks.count()),
      rung_(blocks.count(), 0),
      refine_(blocks.count()),
      coarsen_(blocks.count()) {
    boxes_.reserve(blocks.count());
    for (uint32_t block = 0; block < blocks.count(); ++block)
        boxes_.push_back(ground_box(grid, blocks.patch(block)));
}

void LadderFront::start(Ladders ladders) {
    ladders_ = std::move(ladders);
    for (uint32_t block = 0; block < blocks_.count(); ++block)
        triangles_ += triangles_of(block);
    for (uint32_t block = 0; block < blocks_.count(); ++block) {
        refine_.set_loosely(block, refine_key(block));
        coarsen_.set_loosely(block, coarsen_key(block));
    }
    coarsen_.reorder();
}

void LadderFront::begin_frame(std::span<const lod::View> views, double) {
    CHECK(!views.empty());
    views_.clear();
    for (const lod::View& view : views)
        views_.push_back(lod::metric_of(view));
    is_first_view_ = true;
    for (uint32_t block = 0; block < blocks_.count(); ++block)
        sights_[block] = sight_of(views_, boxes_[block]);
    for (uint32_t block = 0; block < blocks_.count(); ++block) {
        refine_.set_loosely(block, refine_key(block));
        coarsen_.set_loosely(block, coarsen_key(block));
    }
    refine_.reorder();
    coarsen_.reorder();
}

/// What standing on a rung costs, in the block and beside it; 0 when none of that is in view.
double LadderFront::error_at_px(uint32_t block, uint32_t rung) const {
    const Rung& r = ladders_.at(block, rung);
    double worst = is_visible(block) ? std::max(sights_[block].error_px(double(r.error_m)), kFlat_px) : 0.0;
    for (int side = 0; side < 4; ++side) {
        if (r.side_error_m[side] == 0.0f) continue;
        const uint32_t other = blocks_.neighbour(block, side);
        worst = std::max(worst, sights_[other].error_px(double(r.side_error_m[side])));
    }
    return worst;
}

double LadderFront::refine_key(uint32_t block) const {
    return rung_[block] == top_rung(block) ? 0.0 : error_at_px(block, rung_[block]);
}

double LadderFront::coarsen_key(uint32_t block) const {
    if (rung_[block] == 0) return -kInfinity;
    const double error_px = error_at_px(block, rung_[block] - 1u);
    return error_px <= kFlat_px ? 0.0 : -error_px;
}

double LadderFront::refine_error_px() {
    return refine_.top_key();
}

double LadderFront::coarsen_error_px() {
    return -coarsen_.top_key();
}

double LadderFront::error_px() {
    return refine_.top_key() <= kFlat_px ? 0.0 : refine_.top_key();
}

uint64_t LadderFront::triangles_around(uint32_t block) const {
    uint64_t sum = triangles_of(block);
    for (int side = 0; side < 4; ++side) {
        const uint32_t other = blocks_.neighbour(block, side);
        if (other != BlockGrid::kNoBlock) sum += triangles_of(other);
    }
    return sum;
}

lod::Step LadderFront::move(uint32_t block, uint32_t rung) {
    const uint32_t from = rung_[block];
    const uint64_t before = triangles_around(block);
    rung_[block] = static_cast<uint16_t>(rung);
    lod::Step step;
    step.steps = on_move(block, from, operations_);
    step.triangle_delta = static_cast<int64_t>(triangles_around(block)) - static_cast<int64_t>(before);
    triangles_ += static_cast<uint64_t>(step.triangle_delta);
    refine_.set(block, refine_key(block));
    coarsen_.set(block, coarsen_key(block));
    return step;
}

lod::Step LadderFront::refine() {
    if (refine_error_px() <= 0.0) return {};
    const uint32_t block = refine_.top();
    return move(block, rung_[block] + 1u);
}

lod::Step LadderFront::coarsen(double limit_px) {
    if (coarsen_error_px() > limit_px || coarsen_error_px() == kInfinity) return {};
    const uint32_t block = coarsen_.top();
    return move(block, rung_[block] - 1u);
}

uint64_t LadderFront::hash() const {
    uint64_t hash = blocks_.count();
    for (const uint16_t rung : rung_)
        hash = lod::hash_combine(hash, rung);
    return hash;
}

std::string LadderFront::validate() const {
    uint64_t triangles = 0;
    for (uint32_t block = 0; block < blocks_.count(); ++block) {
        const std::string name = "block " + std::to_string(block);
        if (rung_[block] > top_rung(block)) return name + " stands above its ladder";
        triangles += triangles_of(block);
        if (views_.empty()) continue;
        if (refine_.key(block) != refine_key(block)) return name + " has an old key for refinement";
        if (coarsen_.key(block) != coarsen_key(block)) return name + " has an old key for coarsening";
        if (refine_.key(block) > refine_.top_key() || coarsen_.key(block) > coarsen_.top_key())
            return name + " should be on top";
    }
    if (triangles == triangles_) return "";
    return "triangles: counted " + std::to_string(triangles) + ", said " + std::to_string(triangles_);
}

uint64_t LadderFront::memory_bytes() const {
    return ladders_.first.size() * sizeof(uint32_t) + ladders_.rungs.size() * sizeof(Rung) +
           boxes_.size() * (sizeof(GroundBox) + sizeof(Sight) + sizeof(uint16_t)) + refine_.memory_bytes() +
           coarsen_.memory_bytes();
}

bool LadderFront::take_first_view() {
    const bool is_first = is_first_view_;
    is_first_view_ = false;
    return is_first;
}

}  // namespace terrain
