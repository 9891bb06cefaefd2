// The scheduler on a front so simple that the best cut is known: independent places whose error halves per level.
#include "lod/scheduler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace {

/// Never drawn: nothing but what the scheduler asks.
class Undrawn : public lod::Front {
  public:
    void begin_frame(std::span<const lod::View>, double) override {}
    double error_px() override { return refine_error_px(); }
    lod::OperationCounts operations() const override { return {}; }
    uint64_t hash() const override { return 0; }
    lod::PoolRegion pool_need() const override { return {}; }
    void place(const lod::PoolRegion&) override {}
    void emit(const lod::View&, lod::DrawList&) override {}
    uint64_t emitted_triangles() const override { return 0; }
    std::string validate() const override { return ""; }
};

/// Each place has an error of base / 2^level; a level costs two triangles.
class Halving final : public Undrawn {
  public:
    explicit Halving(std::vector<double> base, double coarsen_ratio = 0.6)
        : base_(std::move(base)), level_(base_.size(), 0), coarsen_ratio_(coarsen_ratio) {}

    double refine_error_px() override { return error_at(worst()); }
    double coarsen_error_px() override {
        const size_t i = cheapest();
        return i == level_.size() ? std::numeric_limits<double>::infinity() : 2.0 * error_at(i);
    }
    double coarsen_ratio() const override { return coarsen_ratio_; }
    lod::Step refine() override {
        ++level_[worst()];
        return {2, 1};
    }
    lod::Step coarsen(double limit_px) override {
        if (coarsen_error_px() > limit_px) return {};
        --level_[cheapest()];
        return {-2, 1};
    }
    uint64_t triangles() const override {
        uint64_t sum = 2 * level_.size();
        for (int level : level_)
            sum += 2 * static_cast<uint64_t>(level);
        return sum;
    }

    std::vector<double> base_;
    std::vector<int> level_;
    double coarsen_ratio_;

  private:
    double error_at(size_t i) const { return std::ldexp(base_[i], -level_[i]); }
    size_t worst() const {
        size_t best = 0;
        for (size_t i = 1; i < base_.size(); ++i)
            best = error_at(i) > error_at(best) ? i : best;
        return best;
    }
    size_t cheapest() const {
        size_t best = level_.size();
        for (size_t i = 0; i < base_.size(); ++i) {
            if (level_[i] > 0 && (best == level_.size() || error_at(i) < error_at(best))) best = i;
        }
        return best;
    }
};

/// A hundred cheap things that go one a frame, as one must have glided away before the next can; ten dear ones, at any time.
class Gliding final : public Undrawn {
  public:
    static constexpr double kCheap_px = 2.0, kDear_px = 500.0;

    void begin_frame(std::span<const lod::View>, double) override { is_leaving_ = false; }
    double refine_error_px() override { return dear_ < 10 ? kDear_px : cheap_ < 100 ? kCheap_px : 0.0; }
    double coarsen_error_px() override {
        if (cheap_ > 0 && !is_leaving_) return kCheap_px;
        return dear_ > 0 ? kDear_px : std::numeric_limits<double>::infinity();
    }
    lod::Step refine() override {
        ++(dear_ < 10 ? dear_ : cheap_);
        return {2, 1};
    }
    lod::Step coarsen(double limit_px) override {
        if (coarsen_error_px() > limit_px) return {};
        if (coarsen_error_px() == kDear_px) {
            --dear_;
        } else {
            --cheap_;
            is_leaving_ = true;
        }
        return {-2, 1};
    }
    uint64_t triangles() const override { return 2 * (cheap_ + dear_); }
    uint64_t leaving_triangles() const override { return is_leaving_ ? 2 : 0; }

    uint64_t cheap_ = 100, dear_ = 10;

  private:
    bool is_leaving_ = false;
};

/// A limit that falls at once is reached when what is cheap has had time to go, not by giving up whatever can go now.
TEST(Scheduler, WaitsForWhatIsCheapInsteadOfGivingUpWhatIsDear) {
    Gliding front;
    lod::Front* fronts[] = {&front};
    for (int frame = 0; frame < 40; ++frame) {
        front.begin_frame({}, 0.0);
        lod::schedule(fronts, {.tolerance_px = 1.0, .max_triangles = 180}, lod::operation_limit(1000));
        EXPECT_EQ(front.dear_, 10u) << "frame " << frame;
    }
    EXPECT_EQ(front.triangles(), 180u);
    // What nothing cheap can do for is done by what there is.
    for (int frame = 0; frame < 100; ++frame) {
        front.begin_frame({}, 0.0);
        lod::schedule(fronts, {.tolerance_px = 1.0, .max_triangles = 10}, lod::operation_limit(1000));
    }
    EXPECT_EQ(front.triangles(), 10u);
}

TEST(Scheduler, ReachesTheToleranceAndStops) {
    Halving a({40.0, 3.0, 0.5}), b({100.0});
    lod::Front* fronts[] = {&a, &b};
    EXPECT_TRUE(lod::schedule(fronts, {.tolerance_px = 1.0}, lod::operation_limit(1000)).converged);
    EXPECT_LE(std::max(a.error_px(), b.error_px()), 1.0);
    EXPECT_EQ(lod::schedule(fronts, {.tolerance_px = 1.0}, lod::operation_limit(1000)).operations, 0u);
}

/// What one front clings to keeps no other from letting go.
TEST(Scheduler, TakesBackByEachFrontsOwnHysteresis) {
    Halving clinging({8.0}, 0.6), letting_go({8.0}, 0.95);
    lod::Front* fronts[] = {&clinging, &letting_go};
    lod::schedule(fronts, {.tolerance_px = 1.0}, lod::operation_limit(1000));
    ASSERT_EQ(clinging.level_[0], 3);
    clinging.base_ = {3.4}, letting_go.base_ = {3.6};  // a level less is 0.85 and 0.9 px
    lod::schedule(fronts, {.tolerance_px = 1.0}, lod::operation_limit(1000));
    EXPECT_EQ(clinging.level_[0], 3);
    EXPECT_EQ(letting_go.level_[0], 2);
    letting_go.base_ = {3.96};  // 0.99
    lod::schedule(fronts, {.tolerance_px = 1.0}, lod::operation_limit(1000));
    EXPECT_EQ(letting_go.level_[0], 2);
}

TEST(Scheduler, SharesOneLimitBetweenFronts) {
    Halving a(std::vector<double>(100, 8.0)), b(std::vector<double>(100, 64.0));
    lod::Front* fronts[] = {&a, &b};
    const lod::Budget budget{.tolerance_px = 0.1, .max_triangles = 1200};
    const lod::ScheduleResult result = lod::schedule(fronts, budget, lod::operation_limit(100'000));
    EXPECT_TRUE(result.converged);
    EXPECT_LE(a.triangles() + b.triangles(), 1200u);
    EXPECT_GE(a.triangles() + b.triangles(), 1200u - 66u);
    EXPECT_LE(std::abs(std::log2(a.error_px() / b.error_px())), 1.0) << "triangles went where they buy less";
}

TEST(Scheduler, MovesTrianglesWhenTheErrorMoves) {
    Halving a(std::vector<double>(100, 64.0)), b(std::vector<double>(100, 1.0));
    lod::Front* fronts[] = {&a, &b};
    const lod::Budget budget{.tolerance_px = 0.1, .max_triangles = 1000};
    lod::schedule(fronts, budget, lod::operation_limit(100'000));
    const double before = a.error_px();
    std::swap(a.base_, b.base_);
    EXPECT_TRUE(lod::schedule(fronts, budget, lod::operation_limit(100'000)).converged);
    EXPECT_LE(b.error_px(), 2.0 * before);
    EXPECT_LE(a.triangles() + b.triangles(), 1000u);
}

TEST(Scheduler, SettlesAtALimit) {
    for (uint64_t limit = 400; limit < 480; ++limit) {
        Halving a({97.0, 31.0, 5.0, 77.0, 12.0, 64.0, 23.0, 41.0}), b(std::vector<double>(180, 3.0));
        lod::Front* fronts[] = {&a, &b};
        const lod::Budget budget{.tolerance_px = 0.01, .max_triangles = limit};
        EXPECT_TRUE(lod::schedule(fronts, budget, lod::operation_limit(10'000)).converged) << limit;
        EXPECT_LE(lod::schedule(fronts, budget, lod::operation_limit(10'000)).operations, 2u) << limit;
    }
}

TEST(Scheduler, StopsAfterAnyOperation) {
    for (uint64_t limit = 0; limit < 50; ++limit) {
        Halving a({1000.0, 1.0});
        lod::Front* fronts[] = {&a};
        const lod::ScheduleResult result =
            lod::schedule(fronts, {.tolerance_px = 0.001}, lod::operation_limit(limit));
        EXPECT_LE(result.operations, limit);
    }
}

}  // namespace
