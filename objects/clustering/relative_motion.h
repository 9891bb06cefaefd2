// Relative motion: how far a body strays from a fixed place in the frame of another one, proved for every instant.
//
//     f(t) = member(t) x - carrier(t) place x        for a point x of the member
//
// Between two key frames positions are linear and rotations turn at an even rate: each of the two is a line and an arc,
// whose second derivative is at most the rate squared times the arm. So |f| between two instants h apart is at most the larger
// of both ends plus h^2/8 times the sum of those. At one instant f is affine in x: the corners of the member's box tell.
#pragma once

#include <limits>
#include <span>

#include "data/timed_scene.h"
#include "objects/clustering/step_function.h"

namespace objects {

/// Two bodies, one looked at from the other.
struct MovingPair {
    std::span<const data::KeyFrame> carrier, member;
    const StepFunction* presence = nullptr;  ///< only while it is not 0 the member counts
    glm::dvec3 box_min{0.0}, box_max{0.0};   ///< of the member, in its frame
    double end_s = 0.0;
};

/// A frame in another: outer = rotation * inner + offset.
struct FramePlace {
    glm::dmat3 rotation{1.0};
    glm::dvec3 offset{0.0};
};

/// Whether no place at all is within `most_m` of the member at some few instants. Cost: that of eight poses.
bool surely_strays(const MovingPair& pair, double most_m);

/// A place in the middle of where the member is seen from the carrier, on a grid of a few micrometres, so that equal
/// vehicles get equal ones.
FramePlace middle_place(const MovingPair& pair);

/// The most that any point of the member's box is off its place while it is there.
/// @returns  metres, proved but for rounding, which a micrometre makes up for; infinite when more than `most_m`
/// Cost: O(keys), more where both turn.
double drift_m(const MovingPair& pair, const FramePlace& place, double most_m);

}  // namespace objects
