// Front: the current cut through one level-of-detail hierarchy, valid and drawable after every operation.
//
// The project's one run-time interface. Terrain, object clusters and instruments each sit behind it; the
// scheduler (scheduler.h) trades operations between them in one currency, pixels of screen error.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "lod/draw_list.h"
#include "lod/view.h"

namespace lod {

/// What an operation did, for the frame report.
enum class OperationKind : uint8_t {
    kSplit,
    kForcedSplit,
    kMerge,
    kEnhMerge,
    kClusterRefine,
    kClusterCoarsen,
    kVsplit,
    kEcol,
    kCount
};

/// How often each kind was done.
struct OperationCounts {
    std::array<uint64_t, static_cast<size_t>(OperationKind::kCount)> count{};

    uint64_t& operator[](OperationKind kind) { return count[static_cast<size_t>(kind)]; }
    uint64_t operator[](OperationKind kind) const { return count[static_cast<size_t>(kind)]; }
};

/// The outcome of one refine or coarsen.
struct Step {
    int64_t triangle_delta = 0;  ///< change of triangles(); 0 with steps == 0: there was nothing to do
    uint32_t steps = 0;          ///< elementary changes it was made of, 1 for the plain operation; its cost
};

/// A cut through a hierarchy. Not thread-safe; one thread drives one front.
class Front {
  public:
    Front() = default;
    Front(const Front&) = delete;
    Front& operator=(const Front&) = delete;
    virtual ~Front() = default;

    /// New viewpoints and simulation time. Re-evaluates what the motion may have changed. Geometry
    /// stays, but for one case: a front may take back at once what an incoherent frame (a cut, a fast turn) has
    /// put out of view; it counts that in operations().
    /// @param views   one per channel, at least one; errors are the maximum over them
    /// @param time_s  simulation time, seconds
    virtual void begin_frame(std::span<const View> views, double time_s) = 0;

    /// The largest screen error one refine() would work on, px; 0 when nothing is left to refine in view.
    virtual double refine_error_px() = 0;

    /// The smallest screen error one coarsen() would introduce, px; +infinity when nothing can be coarsened.
    virtual double coarsen_error_px() = 0;

    /// Hysteresis, in (0, 1]: what stays below the tolerance times this is taken back, so that what the eye's next tremor
    /// would refine again is not.
    virtual double coarsen_ratio() const { return 0.6; }

    /// Refines the worst place. Does nothing (steps == 0) when refine_error_px() is 0 or memory is full.
    virtual Step refine() = 0;

    /// Coarsens the cheapest place, and whatever hangs below it, introducing no error above `limit_px`.
    /// Does nothing (steps == 0) when coarsen_error_px() > limit_px.
    virtual Step coarsen(double limit_px) = 0;

    /// Looks again at what was put off while the cut changed. Asked when nothing else is left to do; emit() and error_px()
    /// do it by themselves. @returns whether errors may have risen, so that there may be something to do again
    virtual bool settle() { return false; }

    /// Triangles of the cut, in view or not.
    virtual uint64_t triangles() const = 0;

    /// Triangles that are not counted any more but drawn until what glides away has gone.
    virtual uint64_t leaving_triangles() const { return 0; }

    /// Guaranteed upper bound of the screen error over everything inside the views, px.
    virtual double error_px() = 0;

    /// The farthest that anything which was in view in the last frame, and is now, has moved since because the cut
    /// changed, or what it is a cut of, px; a bound. 0 for fronts that do not say. A frame that has nothing in common
    /// with the last (a cut) is not a movement.
    virtual double jump_px() const { return 0.0; }

    /// Operations since construction.
    virtual OperationCounts operations() const = 0;

    /// A hash of the cut: equal cuts have equal hashes, on every machine.
    virtual uint64_t hash() const = 0;

    /// What the front needs of the geometry pool, and where it got it. place() is called before the first emit
    /// and again whenever pool_need() has outgrown the region; all geometry is then emitted anew.
    virtual PoolRegion pool_need() const = 0;
    virtual void place(const PoolRegion& region) = 0;

    /// Appends the draw items of one view; culls what that view cannot see. Allocates nothing once warm.
    /// Writes into the pool are appended with the first view of a frame only.
    virtual void emit(const View& view, DrawList& out) = 0;

    /// Triangles the last emit() put into the list.
    virtual uint64_t emitted_triangles() const = 0;

    /// Proves every invariant; empty when all hold, else one line naming the first that does not. Slow.
    virtual std::string validate() const = 0;
};

}  // namespace lod
