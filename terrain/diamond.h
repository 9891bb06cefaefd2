// Diamonds: the bintree of right isosceles triangles, named by its vertices.
//
// Two triangles that share a hypotenuse form a diamond; splitting both puts a vertex on its centre. So one grid
// vertex is one diamond, and a mesh is nothing but the set of diamonds that have been split:
//
//        C1                    level even ("square")        level odd ("turned")
//       / | \                    C1 ----- C0                       C1
//     C2--m--C0                  |    m    |                    C2  m  C0
//       \ | /                    C2 ----- C3                       C3
//        C3
//
// C0 and C2 are the apexes: the centres of the two parent diamonds, one level up. C1 and C3 end the hypotenuse.
// Side i joins C_i and C_{i+1}; its middle is the centre of child i. A diamond can be split when both parents
// are (what is missing is a forced split) and merged when no child is split.
//
// Sources: Duchaineau et al., ROAMing Terrain (1997); Lindstrom et al. (1996) for the vertex correspondence.
#pragma once

#include <cstdint>

namespace terrain {

inline constexpr int8_t kDirX[8] = {1, 1, 0, -1, -1, -1, 0, 1};
inline constexpr int8_t kDirY[8] = {0, 1, 1, 1, 0, -1, -1, -1};

/// Grid vertex of the virtual (2^k + 1)^2 domain.
struct GridPoint {
    int x = 0;
    int y = 0;
    bool operator==(const GridPoint&) const = default;
};

/// The domain: the smallest square of 2^k cells that covers a raster. Vertices beyond the raster stand for its
/// nearest border sample (`clamped`), which squeezes the surplus triangles to nothing and keeps the mesh
/// conforming for any raster size.
struct Domain {
    int width = 0, height = 0;  ///< raster samples
    int log2_side = 0;          ///< k >= 1

    int side() const { return 1 << log2_side; }
    /// Levels 0 .. finest_level(); 2 log2(side) of them.
    int finest_level() const { return 2 * log2_side - 1; }
    /// Half the width of a diamond of this level, from centre to C0 along an axis, in cells.
    int reach(int level) const { return side() >> (level / 2 + 1); }
    /// From the centre of a diamond to its children's, along an axis.
    int child_step(int level) const { return (level & 1) != 0 ? reach(level) / 2 : reach(level); }

    bool contains(GridPoint p) const {
        const unsigned last = static_cast<unsigned>(side());  // as unsigned, a negative number is a large one
        return static_cast<unsigned>(p.x) <= last && static_cast<unsigned>(p.y) <= last;
    }
    bool in_raster(GridPoint p) const { return p.x >= 0 && p.y >= 0 && p.x < width && p.y < height; }
    GridPoint clamped(GridPoint p) const {
        return {p.x < width ? p.x : width - 1, p.y < height ? p.y : height - 1};
    }
};

/// Cells a side of the largest domain: the Earth at half an arc second.
inline constexpr int kMostLog2Side = 22;
inline constexpr int kMostLevels = 2 * kMostLog2Side;

/// The domain of a raster; width and height at least 2, at most 2^kMostLog2Side + 1.
inline Domain make_domain(int width, int height) {
    Domain domain{width, height, 1};
    while (domain.side() + 1 < width || domain.side() + 1 < height)
        ++domain.log2_side;
    return domain;
}

/// Point `steps` cells from p in one of the eight directions (0: +x, 1: +x+y, 2: +y, …).
inline GridPoint step_from(GridPoint p, int direction, int steps) {
    return {p.x + kDirX[direction & 7] * steps, p.y + kDirY[direction & 7] * steps};
}

/// Direction from a diamond's centre to one of its apexes; the other is opposite (+4).
/// Square diamonds: apexes are the corners whose coordinates, in units of 2*reach, have an odd sum.
/// Turned ones: one coordinate of the centre is an odd multiple of reach, the other even; the apexes lie along the
/// axis of the even one.
inline int apex_direction(const Domain& domain, GridPoint centre, int level) {
    const int reach = domain.reach(level);
    if ((level & 1) == 0) {
        const int sum = (centre.x + reach) / (2 * reach) + (centre.y + reach) / (2 * reach);
        return (sum & 1) != 0 ? 1 : 3;
    }
    return (centre.x / reach & 1) != 0 ? 2 : 0;
}

}  // namespace terrain
