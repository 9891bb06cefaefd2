// The surface distance beside CGAL's bounded-error Hausdorff distance, which shares nothing with it.
#include <CGAL/Simple_cartesian.h>

#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/distance.h>  // after its kernel
#include <gtest/gtest.h>

#include "lod/surface/surface_distance.h"
#include "tests/lod/soups.h"

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Mesh cgal_mesh(const lod_test::OwnedSoup& soup) {
    Mesh mesh;
    for (const glm::dvec3& p : soup.points)
        mesh.add_vertex({p.x, p.y, p.z});
    for (const auto& [a, b, c] : soup.triangles)
        mesh.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c));
    return mesh;
}

TEST(SurfaceBesideCgal, OneSidedDistancesAgree) {
    const double bound = 1e-3;
    struct Case {
        double bump_m;
        uint32_t hole_begin, hole_end;
    };
    const lod_test::OwnedSoup fine = lod_test::bumpy_square(16, 0.7, 0, 0);
    for (const Case& one : {Case{0.7, 3, 3}, Case{0.2, 0, 0}, Case{0.7, 4, 9}, Case{0.0, 0, 5}}) {
        const lod_test::OwnedSoup other =
            lod_test::bumpy_square(16, one.bump_m, one.hole_begin, one.hole_end);
        for (const auto& [from, to] : {std::pair(&fine, &other), std::pair(&other, &fine)}) {
            const double theirs =
                CGAL::Polygon_mesh_processing::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(
                    cgal_mesh(*from), cgal_mesh(*to), bound);
            const lod::DistanceBounds ours =
                lod::one_sided_distance(from->view(), lod::TriangleTree(to->view()), bound, 2);
            EXPECT_LE(ours.lower_m, theirs + bound);
            EXPECT_GE(ours.upper_m, theirs - bound);
        }
    }
}

}  // namespace
