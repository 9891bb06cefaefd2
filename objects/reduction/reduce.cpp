#include "objects/reduction/reduce.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "lod/base/check.h"
#include "lod/surface/surface_distance.h"
#include "objects/reduction/contraction.h"
#include "objects/reduction/cover.h"

namespace objects {

namespace {

constexpr int kRounds = 2;
constexpr double kWeldShare = 1.0 / 64.0;  ///< of the limit: cells in which points become one at once
constexpr double kCoverShare = 0.4;        ///< … faces nearer than that to larger ones go
constexpr double kSecondCoverShare = 0.1;  ///< … once parts have grown together
constexpr double kReachShare = 0.8;        ///< … how near to each other points of different parts join
constexpr double kToleranceShare = 0.6;  ///< … what contraction may guess; the rest is for what it overlooks
/// Of every proof.
constexpr lod::PieceSearch kSearch{.most_pieces = 4096, .smallest_share = 1.0 / 32};
constexpr double kTightening = 0.25;  ///< of the tolerance of points that failed
constexpr size_t kMendPart = 16;      ///< of the result's faces: so few failures are mended at once

/// What a proposal fails to keep.
struct Failures {
    std::vector<uint32_t> of_source;  ///< source faces that are not near the proposal
    std::vector<uint32_t> of_result;  ///< proposed faces that are not near the source

    size_t size() const { return of_source.size() + of_result.size(); }
};

FaceSoup choose_faces(const FaceSoup& soup, const std::vector<uint8_t>& is_chosen) {
    FaceSoup chosen;
    chosen.points = soup.points;
    for (size_t face = 0; face < soup.faces.size(); ++face) {
        if (!is_chosen[face]) continue;
        chosen.faces.push_back(soup.faces[face]);
        chosen.colours.push_back(soup.colours[face]);
    }
    return chosen;
}

Failures find_failures(const FaceSoup& source, const lod::TriangleTree& source_tree, const FaceSoup& result,
                       double limit_m) {
    Failures failures;
    lod::find_beyond(source.view(), lod::TriangleTree(result.view()), limit_m, failures.of_source, kSearch);
    lod::find_beyond(result.view(), source_tree, limit_m, failures.of_result, kSearch);
    return failures;
}

/// Less tolerance for every point that became a corner of a failing face.
/// @param base_tree  over `base`, what the proposal was made of
void tighten(const FaceSoup& source, const FaceSoup& base, const lod::TriangleTree& base_tree,
             const Contracted& proposal, const Failures& failures, std::vector<double>& tolerance_m) {
    std::vector<uint8_t> is_bad(tolerance_m.size(), 0);
    for (uint32_t face : failures.of_source) {
        const lod::Triangle t = source.view().triangle(face);
        for (const glm::dvec3& point : {t.a, t.b, t.c, (t.a + t.b + t.c) / 3.0}) {
            for (uint32_t corner : base.faces[base_tree.nearest(point).triangle])
                is_bad[proposal.group_of[corner]] = 1;
        }
    }
    for (uint32_t face : failures.of_result) {
        for (uint32_t corner : proposal.soup.faces[face])
            is_bad[corner] = 1;
    }
    for (size_t point = 0; point < tolerance_m.size(); ++point) {
        if (is_bad[proposal.group_of[point]]) tolerance_m[point] *= kTightening;
    }
}

/// Grows parts together first, so that what was a border is none any more when edges are judged.
Contracted propose(const FaceSoup& base, const std::vector<double>& tolerance_m, double limit_m) {
    const double reach_m = kReachShare * limit_m;
    const Contracted grown = contract(base, tolerance_m, {.close_m = reach_m, .longest_m = reach_m});
    std::vector<double> tolerance_left_m = tolerance_m;
    for (size_t point = 0; point < tolerance_m.size(); ++point) {
        double& left = tolerance_left_m[grown.group_of[point]];
        left = std::min(left, tolerance_m[point]);
    }
    Contracted proposal =
        contract(large_cover(grown.soup, kSecondCoverShare * limit_m), tolerance_left_m, {});
    std::vector<uint32_t> group_of(base.points.size());
    for (size_t point = 0; point < group_of.size(); ++point)
        group_of[point] = proposal.group_of[grown.group_of[point]];
    proposal.group_of = std::move(group_of);
    return proposal;
}

/// Takes out what is wrong, then puts in of the source's own faces what is missing, large ones first.
void mend(const FaceSoup& source, const Failures& failures, double limit_m, FaceSoup& result) {
    std::vector<uint8_t> is_good(result.faces.size(), 1);
    for (uint32_t face : failures.of_result)
        is_good[face] = 0;
    result = choose_faces(result, is_good);
    std::vector<uint32_t> missing = failures.of_source;
    if (!failures.of_result.empty()) {
        missing.clear();
        lod::find_beyond(source.view(), lod::TriangleTree(result.view()), limit_m, missing, kSearch);
    }
    FaceSoup patch;
    patch.points = source.points;
    for (uint32_t face : missing) {
        patch.faces.push_back(source.faces[face]);
        patch.colours.push_back(source.colours[face]);
    }
    const uint32_t settled = static_cast<uint32_t>(result.faces.size());
    append_soup(patch, glm::dmat3(1.0), glm::dvec3(0.0), result);
    result = large_cover(result, limit_m, settled);
}

}  // namespace

FaceSoup reduce_within(const FaceSoup& source, double limit_m) {
    CHECK(limit_m > 0.0);
    if (source.faces.empty()) return {};
    const FaceSoup welded = weld(source, kWeldShare * limit_m).soup;
    if (welded.faces.empty()) return source;  // smaller than a cell
    FaceSoup base = large_cover(welded, kCoverShare * limit_m);
    drop_unused_points(base);
    const lod::TriangleTree source_tree(source.view()), base_tree(base.view());
    std::vector<double> tolerance_m(base.points.size(), kToleranceShare * limit_m);
    FaceSoup best;
    Failures of_best;
    size_t least = source.faces.size();
    for (int round = 0; round < kRounds; ++round) {
        Contracted proposal = propose(base, tolerance_m, limit_m);
        Failures failures = find_failures(source, source_tree, proposal.soup, limit_m);
        const size_t few = proposal.soup.faces.size() / kMendPart;
        const bool is_done = failures.size() <= few;
        if (!is_done && round + 1 < kRounds)
            tighten(source, base, base_tree, proposal, failures, tolerance_m);
        if (proposal.soup.faces.size() + failures.size() < least) {
            least = proposal.soup.faces.size() + failures.size();
            best = std::move(proposal.soup);
            of_best = std::move(failures);
        }
        if (is_done) break;
    }
    if (least == source.faces.size()) return source;
    if (of_best.size() > 0) mend(source, of_best, limit_m, best);
    if (best.faces.size() >= source.faces.size()) return source;
    drop_unused_points(best);
    return best;
}

}  // namespace objects
