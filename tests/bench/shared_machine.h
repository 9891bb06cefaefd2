// A machine that others use, too: how much slower than usual each frame of fixed work is. By measurement (two threads at
// 30 Hz on two virtual cores, 3,600 frames): one frame in eight takes 1.3 times as long and more, one in fifteen 1.5, one in
// thirty twice, in bursts of two frames at most. A formula, so that a run can be had again.
#pragma once

#include <cmath>

#include "lod/base/rng.h"

namespace bench {

class SharedMachine {
  public:
    explicit SharedMachine(uint64_t seed = 11) : rng_(seed) {}

    /// Of the next frame, times what is usual.
    double slowness() {
        if (left_ == 0) begin_burst();
        --left_;
        return burst_ * rng_.between(0.92, 1.08);
    }

  private:
    void begin_burst() {
        const double chance = rng_.unit();
        const bool is_stall = chance > 0.93;
        left_ = is_stall ? 1 : 2;
        burst_ = is_stall        ? rng_.between(1.5, 3.5)
                 : chance > 0.62 ? 1.0 + 0.6 * std::pow((chance - 0.62) / 0.31, 1.4)
                                 : 1.0;
    }

    lod::Rng rng_;
    int left_ = 0;
    double burst_ = 1.0;
};

}  // namespace bench
