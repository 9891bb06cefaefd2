#include "terrain/validate.h"

#include <set>

#include "lod/base/hash.h"

namespace terrain {
namespace {

std::string fault(DiamondIndex index, const Diamond& d, const std::string& what) {
    return "diamond " + std::to_string(index) + " at (" + std::to_string(d.x) + ", " + std::to_string(d.y) +
           ") level " + std::to_string(d.level) + ": " + what;
}

/// Parents are where geometry says, and are split.
std::string check_parents(const DiamondMesh& mesh, DiamondIndex index) {
    const Diamond& d = mesh[index];
    const Domain& domain = mesh.domain();
    int present = 0;
    for (uint32_t which = 0; which < 2; ++which) {
        const GridPoint apex =
            step_from(d.centre(), static_cast<int>(d.apex_dir + 4 * which), domain.reach(d.level));
        const DiamondIndex parent = d.parent(which);
        if (domain.contains(apex) == (parent == kOutside))
            return fault(index, d, "parent does not match the domain");
        if (!is_record(parent)) {
            if (d.is_split && parent == kUnsplit)
                return fault(index, d, "is split without both parents: T-junction");
            continue;
        }
        ++present;
        if (mesh[parent].centre() != apex) return fault(index, d, "parent is not its apex");
        if (!mesh[parent].is_used() || !mesh[parent].is_split) return fault(index, d, "parent is not split");
        if (parent >= kCornerCount && mesh.child(parent, static_cast<int>(d.slot(which))) != index) {
            return fault(index, d, "parent does not know it");
        }
    }
    return present == 0 ? fault(index, d, "has no parent") : "";
}

/// Children lie on the sides and know their parent.
std::string check_children(const DiamondMesh& mesh, DiamondIndex index) {
    const Diamond& d = mesh[index];
    const Domain& domain = mesh.domain();
    if (!d.is_split)
        return d.kids != kNoKids || d.split_kids != 0 ? fault(index, d, "unsplit with children") : "";
    if (d.level == domain.finest_level())
        return d.kids == kNoKids ? "" : fault(index, d, "finer than the grid");
    int split_kids = 0;
    for (int side = 0; side < 4; ++side) {
        const GridPoint at = step_from(d.centre(), d.apex_dir + 2 * side + 1, domain.child_step(d.level));
        const DiamondIndex child = mesh.child(index, side);
        if (domain.contains(at) != is_record(child))
            return fault(index, d, "child missing or beyond the domain");
        if (!is_record(child)) continue;
        const Diamond& c = mesh[child];
        if (!c.is_used() || c.centre() != at || c.level != d.level + 1) return fault(index, d, "wrong child");
        if (c.parent0 != index && c.parent1 != index) return fault(index, d, "child does not know it");
        split_kids += c.is_split ? 1 : 0;
    }
    return split_kids == d.split_kids ? "" : fault(index, d, "miscounts its split children");
}

}  // namespace

std::string validate_mesh(const DiamondMesh& mesh) {
    uint64_t triangles = 0, hash = 0;
    uint32_t live = 0;
    std::set<std::pair<int, int>> centres;
    for (DiamondIndex index = kRoot; index < mesh.record_count(); ++index) {
        const Diamond& d = mesh[index];
        if (!d.is_used()) continue;
        ++live;
        if (!centres.insert({d.x, d.y}).second) return fault(index, d, "exists twice");
        if (std::string found = check_parents(mesh, index); !found.empty()) return found;
        if (std::string found = check_children(mesh, index); !found.empty()) return found;
        if (d.is_split) hash ^= lod::mix64((uint64_t(d.y) << 32) | d.x);
        // A leaf triangle: a split parent of an unsplit diamond; below the finest level, every split one has two a side.
        const int parents = int(is_record(d.parent0)) + int(is_record(d.parent1));
        if (!d.is_split) triangles += static_cast<uint64_t>(parents);
        if (d.is_split && d.level == mesh.domain().finest_level())
            triangles += 2 * static_cast<uint64_t>(parents);
    }
    if (live != mesh.live_count()) return "live records: counted " + std::to_string(live);
    if (triangles != mesh.triangles())
        return "triangles: counted " + std::to_string(triangles) + ", said " +
               std::to_string(mesh.triangles());
    return hash == mesh.hash() ? "" : "hash does not match the split diamonds";
}

}  // namespace terrain
