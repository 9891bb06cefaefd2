// What a build of a cluster tree is asked for: how many levels, and what each of them may merge and lose.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace objects {

struct BuildOptions {
    uint32_t levels =
        0;  ///< L, all of which merge; 0: as many as lie between the objects' and the scene's size
    bool is_linear = false;  ///< w(l) = (l/L) W as in the source; else w doubles from level to level up to W
    uint32_t fine_doublings =
        2;  ///< unless L is given: of w on the first levels, where objects only get reduced parents
    uint32_t levels_per_doubling =
        2;  ///< … of which one merges, the others only reduce; more: fewer faces, slower, larger
    double first_sizes =
        9.5;  ///< w of the first level that merges, in usual objects, whatever the scene's size
    double error_share = 0.01;  ///< epsilon(l) = error_share * w(l)
    double spent_share = 0.25;  ///< of epsilon(l): what is off by more is no source; more: faster, more faces
    double gamma_share = 0.25;  ///< gamma(L) = gamma_share; gamma(l) is in proportion to w(l)
    uint32_t most_children = 16;
    double visibility_slack =
        1.0 / 64.0;                  ///< visibilities of many steps may be off by so much, counted in gamma
    double least_rest_share = 0.01;  ///< of T: a mover that rests so long is a leaf of its own meanwhile
    unsigned threads = 1;
};

/// Levels on which nothing is merged yet.
inline uint32_t fine_levels(const BuildOptions& options) {
    return options.fine_doublings * options.levels_per_doubling;
}

/// Whether clusters of a level may be merged, or only be reduced each by itself.
inline bool merges(const BuildOptions& options, uint32_t level) {
    return level > fine_levels(options) &&
           (level > options.levels || (options.levels - level) % options.levels_per_doubling == 0);
}

/// What clusters of one level may be.
struct LevelThresholds {
    double size_m = 0.0;   ///< w(l)
    double error_m = 0.0;  ///< epsilon(l)
    double gamma = 0.0;    ///< gamma(l) / T
};

/// @param level   1 … levels; beyond levels what is left is joined: errors go on growing, size and time do not matter
/// @param size_m  W: of the whole scene, or a little more
inline LevelThresholds thresholds_at(const BuildOptions& options, uint32_t level, double size_m) {
    const double last = static_cast<double>(options.levels), now = static_cast<double>(level);
    const double share =
        options.is_linear ? now / last : std::exp2((now - last) / options.levels_per_doubling);
    LevelThresholds at{share * size_m, options.error_share * share * size_m, options.gamma_share * share};
    if (level <= options.levels) return at;
    at.size_m = 1e30;
    at.gamma = 1e30;
    return at;
}

}  // namespace objects
