#include "objects/reduction/reduce.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "lod/base/check.h"
#include "lod/surface/surface_distance.h"
#include "objects/reduction/breadth.h"
#include "objects/reduction/contraction.h"
#include "objects/reduction/cover.h"
#include "objects/reduction/recolour.h"
#include "objects/reduction/stand_in.h"
#include "objects/reduction/upper_side.h"

namespace objects {

namespace {

constexpr double kWeldShare = 1.0 / 64.0;  ///< of the limit: cells in which points become one at once
constexpr double kFirstShare =
    0.05;  ///< … what is finely bent becomes plain first: strips would go one by one
constexpr double kCoverShare = 0.4;        ///< … faces nearer than that to larger ones go
constexpr double kSecondCoverShare = 0.3;  ///< … once parts have grown together
constexpr double kReachShare = 0.8;        ///< … how near to each other points of different parts join
constexpr double kToleranceShare = 0.6;  ///< … what contraction may guess; the rest is for what it overlooks
constexpr double kGrownShare =
    0.5;  ///< of stand-ins' faces; what has grown together so far has no gaps to be gathered across …
constexpr double kMissingShare = 0.25;  ///< … unless so many of the source's faces are not near it
/// Of every proof.
constexpr lod::PieceSearch kSearch{.most_pieces = 4096, .smallest_share = 1.0 / 32};

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

/// @param missing  out: faces of the source that are not near to what is left of the result
void take_out_wrong(const FaceSoup& source, const lod::TriangleTree& source_tree, double limit_m,
                    std::vector<uint32_t>& missing, FaceSoup& result) {
    std::vector<uint32_t> wrong;
    lod::find_beyond(result.view(), source_tree, limit_m, wrong, kSearch);
    std::vector<uint8_t> is_right(result.faces.size(), 1);
    for (const uint32_t face : wrong)
        is_right[face] = 0;
    if (!wrong.empty()) result = choose_faces(result, is_right);
    lod::find_beyond(source.view(), lod::TriangleTree(result.view()), limit_m, missing, kSearch);
}

/// Grows parts together first, so that what was a border is none any more when edges are judged.
FaceSoup propose(const FaceSoup& welded, double limit_m) {
    const std::vector<double> first_m(welded.points.size(), kFirstShare * limit_m);
    FaceSoup base = large_cover(contract(welded, first_m, {}), kCoverShare * limit_m);
    drop_unused_points(base);
    const double reach_m = kReachShare * limit_m;
    const std::vector<double> tolerance_m(base.points.size(), kToleranceShare * limit_m);
    const FaceSoup grown = contract(base, tolerance_m, {.close_m = reach_m, .longest_m = reach_m});
    return contract(large_cover(grown, kSecondCoverShare * limit_m), tolerance_m, {});
}

std::vector<uint8_t> all_of(const StandIns& parts) {
    return std::vector<uint8_t>(parts.part_count(), 1);
}

/// Takes out what is wrong, then puts in what is missing: the stand-ins of parts, or of the source's own faces some, large
/// ones first.
void mend(const FaceSoup& source, const lod::TriangleTree& source_tree, double limit_m, unsigned threads,
          StandIns& parts, FaceSoup& result) {
    std::vector<uint32_t> missing;
    take_out_wrong(source, source_tree, limit_m, missing, result);
    if (missing.empty()) return;
    std::vector<uint8_t> is_missing(parts.part_count(), 0);
    for (const uint32_t face : missing)
        is_missing[parts.part_of_source[face]] = 1;
    if (!parts.are_gathered) {
        const bool has_failed =
            static_cast<double>(missing.size()) > kMissingShare * static_cast<double>(source.faces.size());
        gather_stand_ins(source, source_tree, limit_m, has_failed ? all_of(parts) : is_missing, threads,
                         parts);
    }
    std::vector<uint8_t> is_wanted(parts.soup.faces.size(), 0);
    for (uint32_t part = 0; part < parts.part_count(); ++part) {
        if (is_missing[part] == 0 || parts.is_replaced[part] == 0) continue;
        for (const uint32_t wanted : parts.faces_of_part[part])
            is_wanted[wanted] = 1;
    }
    FaceSoup patch;
    patch.points = source.points;
    for (const uint32_t face : missing) {
        if (parts.is_replaced[parts.part_of_source[face]] != 0) continue;
        patch.faces.push_back(source.faces[face]);
        patch.colours.push_back(source.colours[face]);
    }
    append_soup(choose_faces(parts.soup, is_wanted), glm::dmat3(1.0), glm::dvec3(0.0), result);
    const uint32_t settled = static_cast<uint32_t>(result.faces.size());
    append_soup(patch, glm::dmat3(1.0), glm::dvec3(0.0), result);
    result = large_cover(result, limit_m, settled);
}

/// Whether no part that has a stand-in has two colours: then nothing of the colours is left to settle.
bool are_of_one_colour(const FaceSoup& source, const StandIns& parts) {
    std::vector<uint32_t> first_face(parts.part_count(), kNoFace);
    for (uint32_t face = 0; face < source.faces.size(); ++face) {
        const uint32_t part = parts.part_of_source[face];
        if (parts.is_replaced[part] == 0) continue;
        if (first_face[part] == kNoFace) first_face[part] = face;
        if (source.colours[face] != source.colours[first_face[part]]) return false;
    }
    return true;
}

}  // namespace

FaceSoup reduce_within(const FaceSoup& source, double limit_m, unsigned threads) {
    CHECK(limit_m > 0.0);
    if (source.faces.empty()) return {};
    const lod::TriangleTree source_tree(source.view());
    StandIns parts = stand_ins(source, limit_m, kWeldShare * limit_m, threads);
    const FaceSoup welded = weld(parts.to_grow, kWeldShare * limit_m).soup;
    if (welded.faces.empty()) return source;  // smaller than a cell
    FaceSoup grown;
    // A single part with a stand-in has nothing to grow together with.
    if (parts.part_count() > 1 || parts.is_replaced[0] == 0) {
        grown = propose(welded, limit_m);
        if (static_cast<double>(grown.faces.size()) >
            kGrownShare * static_cast<double>(parts.soup.faces.size()))
            gather_stand_ins(source, source_tree, limit_m, all_of(parts), threads, parts);
        if (grown.faces.size() < parts.soup.faces.size())
            mend(source, source_tree, limit_m, threads, parts, grown);
        else
            grown = {};
    }
    const bool are_parts = grown.faces.empty() || parts.soup.faces.size() <= grown.faces.size();
    FaceSoup result = are_parts ? parts.soup : std::move(grown);
    if (result.faces.size() >= source.faces.size()) return source;
    drop_unused_points(result);
    turn_open_parts_up(kWeldShare * limit_m, result);
    if (are_parts && are_of_one_colour(source, parts)) return result;
    const NearestFaces nearest = nearest_faces(source, result, limit_m);
    recolour(source, source_tree, nearest, limit_m, result);
    if (are_parts) return result;
    keep_breadth(source, source_tree, nearest, limit_m, result);
    if (result.faces.size() >= source.faces.size()) return source;
    turn_open_parts_up(kWeldShare * limit_m, result);  // rods' cards, too
    return result;
}

}  // namespace objects
