#include "objects/reduction/stand_in.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lod/surface/surface_distance.h"
#include "objects/for_each_item.h"
#include "objects/reduction/fit.h"
#include "objects/reduction/gather.h"
#include "objects/reduction/part_shapes.h"
#include "objects/reduction/parts.h"
#include "objects/reduction/spread.h"

namespace objects {

namespace {

constexpr size_t kMostLoose = 5;      ///< faces of shapes that are no solid: a tent's
constexpr size_t kMostFaces = 4096;   ///< of a part; what has more is hardly a prism
constexpr double kUprightCos = 0.9;   ///< what is longest that way is seen from above only
constexpr double kSampleShare = 0.8;  ///< of the limit, between samples one above the other
constexpr lod::PieceSearch kSearch{.most_pieces = 1024, .smallest_share = 1.0 / 16};

/// A shape, and the axis it was made along.
struct Proposal {
    PartShape shape;
    const SeenPart* seen = nullptr;
};

std::vector<glm::dvec3> used_points(const FaceSoup& part) {
    std::vector<uint8_t> is_used(part.points.size(), 0);
    std::vector<glm::dvec3> points;
    for (const auto& face : part.faces) {
        for (uint32_t corner : face) {
            if (is_used[corner] == 0) points.push_back(part.points[corner]);
            is_used[corner] = 1;
        }
    }
    return points;
}

bool are_all_within(const FaceSoup& from, const lod::TriangleTree& to, double limit_m) {
    lod::PieceSearch search = kSearch;
    for (size_t face = 0; face < from.faces.size(); ++face) {
        if (!lod::is_within(from.view().triangle(face), to, limit_m, search)) return false;
    }
    return true;
}

bool is_of_one_kind(const FaceSoup& part) {
    return std::all_of(part.colours.begin(), part.colours.end(), [&](const glm::u8vec4& colour) {
        return is_glass(colour) == is_glass(part.colours[0]);
    });
}

/// A part that is asked what may stand for it.
class Asked {
  public:
    Asked(const FaceSoup& part, double limit_m) : part_(part), tree_(part.view()), limit_m_(limit_m) {}

    const lod::TriangleTree& tree() const { return tree_; }

    /// A shape that is near enough, moved where its faces are loose and it has to be.
    std::optional<FaceSoup> settled(const PartShape& shape, const SeenPart& seen) const {
        if (is_near(shape.soup, shape.pieces)) return shape.soup;
        if (!shape.is_loose) return std::nullopt;
        const std::vector<glm::dvec3> samples = prism_samples(seen, kSampleShare * limit_m_);
        std::vector<lod::Triangle> faces;
        for (size_t face = 0; face < shape.soup.faces.size(); ++face)
            faces.push_back(shape.soup.view().triangle(face));
        if (!fit({samples, part_.view(), &tree_}, limit_m_, faces)) return std::nullopt;
        FaceSoup moved = shape.soup;
        moved.points.clear();
        for (const lod::Triangle& t : faces)
            moved.points.insert(moved.points.end(), {t.a, t.b, t.c});
        if (!is_near(moved, moved)) return std::nullopt;
        return moved;
    }

  private:
    const FaceSoup& part_;
    lod::TriangleTree tree_;
    double limit_m_;

    bool is_near(const FaceSoup& soup, const FaceSoup& pieces) const {
        return are_all_within(pieces, tree_, limit_m_) &&
               are_all_within(part_, lod::TriangleTree(soup.view()), limit_m_);
    }
};

/// How broad the faces of a shape are that stands for an opaque part, and how they are lit: loose ones all alike, through the
/// gaps between them their backs are seen, too.
void settle_look(const FaceSoup& part, const lod::TriangleTree& tree, double limit_m, bool is_loose,
                 FaceSoup& shape) {
    if (is_glass(part.colours[0])) return;
    for (glm::u8vec4& colour : shape.colours)
        colour.w = kByNormal;
    if (shape.faces.size() > kMostLoose) return;
    std::vector<FaceLoad> loads = share_out(part, shape, limit_m);
    if (loads.empty()) return;
    if (is_loose) shape.points.clear();
    Outlook whole;
    for (const FaceLoad& load : loads)
        whole.add(load.outlook);
    for (size_t face = 0; face < loads.size(); ++face) {
        FaceLoad& load = loads[face];
        if (is_loose) {
            if (!load.corners.empty())
                spread({load.corners, part.view(), &tree}, load.corners, limit_m, load.outlook.covering_m2(),
                       load.face);
            shape.points.insert(shape.points.end(), {load.face.a, load.face.b, load.face.c});
        }
        shape.colours[face].w = (is_loose ? whole : load.outlook).finish(lod::area_vector_m2(load.face));
    }
}

/// Faces that were gathered, and the stand-ins of parts of which none was: these are better by themselves, may be cards.
void put_together(const std::vector<Gathered>& gathered, StandIns& parts) {
    std::vector<uint8_t> is_gathered(parts.part_count(), 0);
    for (const Gathered& group : gathered) {
        for (const uint32_t load : group.loads) {
            if (group.loads.size() > 1) is_gathered[parts.to_gather[load].part] = 1;
        }
    }
    parts.soup = {};
    parts.faces_of_part.assign(parts.part_count(), {});
    for (const Gathered& group : gathered) {
        if (is_gathered[parts.to_gather[group.loads[0]].part] == 0) continue;
        const uint32_t corner = static_cast<uint32_t>(parts.soup.points.size());
        parts.soup.points.insert(parts.soup.points.end(), {group.face.a, group.face.b, group.face.c});
        for (const uint32_t load : group.loads)
            parts.faces_of_part[parts.to_gather[load].part].push_back(
                static_cast<uint32_t>(parts.soup.faces.size()));
        parts.soup.faces.push_back({corner, corner + 1, corner + 2});
        parts.soup.colours.push_back(group.colour);
    }
    for (uint32_t part = 0; part < parts.part_count(); ++part) {
        if (is_gathered[part] != 0) continue;
        for (size_t i = 0; i < parts.of_part[part].faces.size(); ++i)
            parts.faces_of_part[part].push_back(static_cast<uint32_t>(parts.soup.faces.size() + i));
        append_soup(parts.of_part[part], glm::dmat3(1.0), glm::dvec3(0.0), parts.soup);
    }
}

}  // namespace

StandIn stand_in(const FaceSoup& part, double limit_m) {
    if (part.faces.size() < 2 || part.faces.size() > kMostFaces || !is_of_one_kind(part)) return {};
    const std::vector<glm::dvec3> points = used_points(part);
    const glm::dvec3 upright(0, 0, 1), longest = long_axis(points);
    std::vector<SeenPart> views = {see_along(points, upright)};
    if (std::abs(longest.z) < kUprightCos) views.push_back(see_along(points, longest));
    std::vector<Proposal> proposals;
    for (const SeenPart& seen : views) {
        std::vector<PartShape> shapes;
        propose_shapes(seen, part.faces.size(), limit_m, shapes);
        for (PartShape& shape : shapes)
            proposals.push_back({std::move(shape), &seen});
    }
    std::stable_sort(proposals.begin(), proposals.end(), [](const Proposal& a, const Proposal& b) {
        return a.shape.soup.faces.size() < b.shape.soup.faces.size();
    });
    if (proposals.empty()) return {};
    const Asked asked(part, limit_m);
    StandIn found;
    for (Proposal& proposal : proposals) {
        const PartShape& shape = proposal.shape;
        if (shape.soup.faces.size() >= part.faces.size()) break;
        if (shape.is_for_gathering && !found.to_gather.faces.empty()) continue;
        std::optional<FaceSoup> near = asked.settled(shape, *proposal.seen);
        if (!near) continue;
        near->colours.assign(near->faces.size(), part.colours[0]);
        if (shape.is_for_gathering || shape.is_loose) found.to_gather = *near;
        if (shape.is_for_gathering) continue;
        settle_look(part, asked.tree(), limit_m, shape.is_loose, *near);
        found.soup = std::move(*near);
        found.is_card = shape.is_card;
        break;
    }
    return found;
}

StandIns stand_ins(const FaceSoup& source, double limit_m, double cell_m, unsigned threads) {
    StandIns out;
    out.part_of_source.resize(source.faces.size());
    const WeldedSoup welded = weld(source, cell_m);
    const std::vector<std::vector<uint32_t>> parts =
        parts_of(source, welded.point_of, welded.soup.points.size());
    out.of_part.resize(parts.size());
    std::vector<StandIn> found(parts.size());
    std::vector<std::vector<FaceLoad>> loads(parts.size());
    for_each_item(parts.size(), threads, [&](size_t i) {
        out.of_part[i] = part_of(source, parts[i]);
        found[i] = stand_in(out.of_part[i], limit_m);
        if (!found[i].to_gather.faces.empty())
            loads[i] = share_out(out.of_part[i], found[i].to_gather, limit_m);
    });
    for (uint32_t i = 0; i < parts.size(); ++i) {
        for (const uint32_t face : parts[i])
            out.part_of_source[face] = i;
        const bool is_found = !found[i].soup.faces.empty();
        out.is_replaced.push_back(is_found);
        append_soup(is_found && !found[i].is_card ? found[i].soup : out.of_part[i], glm::dmat3(1.0),
                    glm::dvec3(0.0), out.to_grow);
        if (!is_found) continue;
        out.of_part[i] = std::move(found[i].soup);
        for (FaceLoad& load : loads[i]) {
            if (load.corners.empty()) continue;
            load.part = i;
            out.to_gather.push_back(std::move(load));
        }
    }
    put_together({}, out);
    return out;
}

void gather_stand_ins(const FaceSoup& source, const lod::TriangleTree& source_tree, double limit_m,
                      std::span<const uint8_t> is_wanted, unsigned threads, StandIns& parts) {
    std::erase_if(parts.to_gather, [&](const FaceLoad& load) { return is_wanted[load.part] == 0; });
    put_together(gather(source, source_tree, limit_m, parts.to_gather, threads), parts);
    parts.are_gathered = true;
}

}  // namespace objects
