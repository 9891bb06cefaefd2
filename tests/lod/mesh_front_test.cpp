// MeshFront behind the scheduler: valid after every operation, within its error, the same on every run, quiet when
// nothing moves.
#include "lod/progressive/mesh_front.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "lod/base/hash.h"
#include "lod/base/rng.h"
#include "lod/scheduler.h"
#include "tests/lod/mesh_distance.h"
#include "tests/lod/plain_hierarchy.h"

namespace {

using lod::MeshFront;
using lod::View;
using lod_test::PlainMesh;

const PlainMesh& source() {
    static const PlainMesh mesh =
        lod_test::joined(lod_test::bumpy_sheet(40, 5), lod_test::bumpy_ring(60, 24, 6));
    return mesh;
}
const lod::VertexHierarchy& hierarchy() {
    static const lod::VertexHierarchy made = lod_test::make_plain_history(source()).hierarchy;
    return made;
}

std::vector<lod::ProgressiveMesh> one_mesh() {
    std::vector<lod::ProgressiveMesh> meshes;
    meshes.push_back(lod::make_progressive_mesh(hierarchy()));
    return meshes;
}

lod::MeshOptions options(double glide_s, double tolerance_px = 1.0) {
    lod::MeshOptions made;
    made.ranks.tolerance_px = tolerance_px;
    made.glide_s = glide_s;
    return made;
}

glm::dmat3 rotation(lod::Rng& rng) {
    return lod::eye_from_attitude(glm::dmat3(1.0), rng.between(0, 6.3), rng.between(-1.5, 1.5),
                                  rng.between(0, 6.3));
}

/// Looks at about the middle of the mesh.
View view_from(const glm::dvec3& eye, const glm::dvec3& target = {2.0, 0.2, 0.0}) {
    View optics;
    optics.width_px = 1280;
    optics.height_px = 720;
    optics.near_m = 0.02;
    return lod::look_at(eye, target, {0.0, 0.0, 1.0}, optics);
}

View random_view(lod::Rng& rng) {
    const double away = std::exp(rng.between(0.5, 6.0));
    const glm::dvec3 way(rng.between(-1, 1), rng.between(-1, 1), rng.between(-1, 1));
    const glm::dvec3 target(rng.between(0, 4), rng.between(-1, 1), rng.between(-0.3, 0.3));
    return view_from(glm::dvec3(2.0, 0.2, 0.0) + glm::normalize(way) * away, target);
}

uint64_t converge(MeshFront& front, const View& view, double time_s, double tolerance_px = 1.0) {
    lod::Front* fronts[] = {&front};
    lod::Budget budget;
    budget.tolerance_px = tolerance_px;
    front.begin_frame({&view, 1}, time_s);
    return lod::schedule(fronts, budget, lod::operation_limit(UINT64_MAX)).operations;
}

TEST(MeshFront, IsValidAfterAnyNumberOfOperations) {
    for (const double glide_s : {0.0, 0.3}) {
        MeshFront front(lod::Module::kInstruments, one_mesh(), std::vector<lod::MeshPlacement>(1),
                        options(glide_s));
        lod::Front* fronts[] = {&front};
        lod::Rng rng(1);
        double time_s = 0.0;
        View view = view_from({2.0, -3.0, 1.0});
        for (int frame = 0; frame < 300; ++frame) {
            if (frame % 40 == 0) view = random_view(rng);
            view.eye_world +=
                glm::dvec3(rng.between(-0.1, 0.1), rng.between(-0.1, 0.1), rng.between(-0.1, 0.1));
            front.begin_frame({&view, 1}, time_s += 1.0 / 60.0);
            ASSERT_EQ(front.validate(), "") << "frame " << frame << " begun";
            lod::Budget budget;
            budget.max_triangles = 500 + rng.below(3000);
            lod::schedule(fronts, budget, lod::operation_limit(rng.below(60)));
            ASSERT_EQ(front.validate(), "") << "frame " << frame << ", glide " << glide_s;
        }
        EXPECT_GT(front.operations()[lod::OperationKind::kVsplit], 1000u);
        EXPECT_GT(front.operations()[lod::OperationKind::kEcol], 300u);
    }
}

/// Every point of the full mesh in view is as near to the drawn one as told, on the screen, and the other way round.
TEST(MeshFront, NothingInViewDepartsByMoreThanTold) {
    lod::Rng rng(2);
    lod::MeshOptions plain = options(0.0);
    plain.ranks.silhouette_weight = 1.0;
    MeshFront front(lod::Module::kInstruments, one_mesh(), std::vector<lod::MeshPlacement>(1), plain);
    double worst_share = 0.0;
    for (int look = 0; look < 16; ++look) {
        const View view = random_view(rng);
        lod::Front* fronts[] = {&front};
        front.begin_frame({&view, 1}, look);
        // Any moment may be the last.
        const uint64_t limit = look % 3 == 0 ? rng.below(2000) : UINT64_MAX;
        lod::schedule(fronts, {}, lod::operation_limit(limit));
        const double told_px = front.error_px();
        const lod_test::Departure found =
            lod_test::departure_px(source(), lod_test::drawn(front.body(0).cut()), lod::metric_of(view), rng);
        EXPECT_LE(found.full_to_drawn_px, told_px + 1e-9) << "look " << look;
        EXPECT_LE(found.drawn_to_full_px, told_px + 1e-9) << "look " << look;
        if (limit == UINT64_MAX) {
            EXPECT_LE(told_px, 1.0);
        }
        const double farthest_px = std::max(found.full_to_drawn_px, found.drawn_to_full_px);
        if (told_px > 0.0) worst_share = std::max(worst_share, farthest_px / told_px);
    }
    EXPECT_GT(worst_share, 0.1);
    RecordProperty("worst_share", std::to_string(worst_share));
}

/// Nor while vertices are under way, in the frame they set out least of all: what is drawn then is the mesh of before.
TEST(MeshFront, NothingDepartsByMoreThanToldWhileVerticesGlide) {
    lod::Rng rng(4);
    lod::MeshOptions gliding = options(0.3);
    gliding.ranks.silhouette_weight = 1.0;
    MeshFront front(lod::Module::kInstruments, one_mesh(), std::vector<lod::MeshPlacement>(1), gliding);
    lod::Front* fronts[] = {&front};
    double away = 30.0, time_s = 0.0, worst_share = 0.0;
    size_t most_gliding = 0;
    for (int frame = 0; frame < 5; ++frame) {
        away *= frame < 4 ? 0.8 : 1.2;
        const View view = view_from(glm::dvec3(2.0, 0.2, 0.0) + glm::dvec3(0.1, -0.9, 0.4) * away);
        front.begin_frame({&view, 1}, time_s += 1.0 / 60.0);
        lod::schedule(fronts, {}, lod::operation_limit(frame % 3 == 0 ? rng.below(40) : UINT64_MAX));
        const lod::MeshBody& body = front.body(0);
        most_gliding = std::max(most_gliding, body.glides().all().size());
        const lod_test::Soup soup =
            lod_test::drawn(body.cut(), [&](lod::NodeId node) { return body.glides().displacement_m(node); });
        const lod_test::Departure found = lod_test::departure_px(source(), soup, lod::metric_of(view), rng);
        const double told_px = front.error_px();
        const double farthest_px = std::max(found.full_to_drawn_px, found.drawn_to_full_px);
        EXPECT_LE(farthest_px, told_px + 1e-9) << "frame " << frame;
        worst_share = std::max(worst_share, farthest_px / told_px);
    }
    EXPECT_GT(most_gliding, 100u);
    EXPECT_GT(worst_share, 0.1);
    RecordProperty("worst_share", std::to_string(worst_share));
}

TEST(MeshFront, ZeroToleranceIsTheFullMesh) {
    MeshFront front(lod::Module::kInstruments, one_mesh(), std::vector<lod::MeshPlacement>(1), options(0.0));
    converge(front, view_from({2.0, -14.0, 3.0}), 0.0, 0.0);
    EXPECT_EQ(front.triangles(), source().triangles.size());
    EXPECT_EQ(front.error_px(), 0.0);
}

TEST(MeshFront, CostFollowsChange) {
    MeshFront front(lod::Module::kInstruments, one_mesh(), std::vector<lod::MeshPlacement>(1),
                    options(0.0, 0.3));
    View view = view_from({2.0, -4.0, 1.0});
    converge(front, view, 0.0, 0.3);
    const uint64_t hash = front.hash(), triangles = front.triangles();
    EXPECT_GT(triangles, 2000u);
    uint64_t before = front.evaluations();
    for (int frame = 1; frame < 50; ++frame)
        EXPECT_EQ(converge(front, view, frame / 60.0, 0.3), 0u);
    EXPECT_LE(front.evaluations() - before, 2u * 50u) << "standing still: the heads at most";
    EXPECT_EQ(front.hash(), hash);
    before = front.evaluations();
    for (int frame = 1; frame < 100; ++frame) {  // a centimetre a frame, four metres away
        view.eye_world.x += 0.01;
        converge(front, view, 1.0 + frame / 60.0, 0.3);
    }
    EXPECT_LT((front.evaluations() - before) / 100, triangles / 10) << "not the whole front every frame";
    EXPECT_EQ(front.validate(), "");
}

TEST(MeshFront, OutOfViewSleepsAndGoesOnWhereItWas) {
    MeshFront front(lod::Module::kInstruments, one_mesh(), std::vector<lod::MeshPlacement>(1), options(0.2));
    const View there = view_from({2.0, -3.0, 1.0}), away = view_from({2.0, -3.0, 1.0}, {2.0, -9.0, 3.0});
    converge(front, there, 0.0);
    const uint64_t hash = front.hash(), evaluations = front.evaluations(), triangles = front.triangles();
    const lod::OperationCounts operations = front.operations();
    for (int frame = 1; frame < 20; ++frame)
        EXPECT_EQ(converge(front, away, frame / 60.0), 0u);
    EXPECT_EQ(front.evaluations(), evaluations);
    EXPECT_EQ(front.operations().count, operations.count);
    EXPECT_EQ(front.triangles(), 0u);
    EXPECT_EQ(front.error_px(), 0.0);
    EXPECT_EQ(front.validate(), "");
    converge(front, there, 1.0);
    EXPECT_EQ(front.hash(), hash);
    EXPECT_EQ(front.triangles(), triangles);
}

/// Twelve bodies of one mesh, three sizes, in the world and in the cockpit, some turning like needles.
TEST(MeshFront, ManyBodiesShareOneMeshAndOneBudget) {
    lod::Rng rng(4);
    std::vector<lod::MeshPlacement> placements(12);
    for (size_t i = 0; i < placements.size(); ++i) {
        const double scale = i % 3 == 0 ? 0.1 : i % 3 == 1 ? 1.0 : 20.0;
        placements[i].pose.frame = i < 6 ? lod::BodyPose::Frame::kPlaced : lod::BodyPose::Frame::kEye;
        placements[i].pose.reference_from_body = rotation(rng) * scale;
        placements[i].pose.origin =
            (i < 6 ? glm::dvec3(6.37e6, 0.0, 0.0) : glm::dvec3(0.0)) +
            scale * glm::dvec3(rng.between(-4, 4), rng.between(-4, 4), i < 6 ? rng.between(-4, 4) : -9.0);
    }
    std::array<uint64_t, 2> hashes{};
    for (uint64_t& hash : hashes) {
        MeshFront front(lod::Module::kInstruments, one_mesh(), placements, options(0.1));
        lod::Front* fronts[] = {&front};
        for (int frame = 0; frame < 120; ++frame) {
            const double s = frame / 60.0;
            for (uint32_t i = 0; i < placements.size(); i += 2) {
                lod::BodyPose pose = placements[i].pose;
                pose.reference_from_body *=
                    glm::dmat3(std::cos(s), std::sin(s), 0, -std::sin(s), std::cos(s), 0, 0, 0, 1);
                front.set_pose(i, pose);
            }
            const View view = view_from({6.37e6 + 2.0 + s, -10.0, 1.0}, {6.37e6, 3.0 * s, 0.0});
            front.begin_frame({&view, 1}, s);
            lod::Budget budget;
            budget.max_triangles = 9000;
            lod::schedule(fronts, budget, lod::operation_limit(400));
            if (frame > 60) {
                EXPECT_LE(front.triangles(), budget.max_triangles);
            }
            hash = lod::hash_combine(hash, front.hash());
            if (frame % 20 == 0) {
                ASSERT_EQ(front.validate(), "") << frame;
            }
        }
        EXPECT_EQ(front.validate(), "");
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(MeshFront, SilhouettesAreFinerThanTheRest) {
    std::array<uint64_t, 2> triangles{};
    lod::VertexHierarchy coned = hierarchy();
    // As if all of it faced +x: only a view from the side sees an edge.
    coned.cone_axis.assign(coned.node_count(), {1.0f, 0.0f, 0.0f});
    coned.cone_cos.assign(coned.node_count(), 0.95f);
    for (const bool from_side : {false, true}) {
        std::vector<lod::ProgressiveMesh> meshes;
        meshes.push_back(lod::make_progressive_mesh(coned));
        MeshFront front(lod::Module::kInstruments, std::move(meshes), std::vector<lod::MeshPlacement>(1),
                        options(0.0));
        const glm::dvec3 way = from_side ? glm::dvec3(0.0, -1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
        converge(front, view_from(glm::dvec3(2.0, 0.2, 0.0) + 160.0 * way), 0.0);
        triangles[from_side] = front.triangles();
        EXPECT_LE(front.error_px(), 1.0);
        EXPECT_EQ(front.validate(), "");
    }
    EXPECT_GT(triangles[1], triangles[0] * 5 / 4);
}

TEST(MeshFront, TheSizePolicyGivesTheSharesOfThePaper) {
    lod::MeshOptions by_size = options(0.0);
    by_size.policy = lod::DetailPolicy::kSize;
    MeshFront front(lod::Module::kInstruments, one_mesh(), std::vector<lod::MeshPlacement>(1), by_size);
    const lod::ProgressiveMesh& mesh = front.body(0).cut().mesh();
    const double full = static_cast<double>(source().triangles.size());
    const std::map<double, double> shares{{320, 1.0}, {275, 0.8}, {225, 0.6},
                                          {175, 0.4}, {125, 0.2}, {80, 0.1}};
    for (const auto& [size_px, share] : shares) {
        const View view = view_from(mesh.centre + glm::dvec3(0, -1, 0), mesh.centre);
        const double away = 2.0 * mesh.radius_m * lod::metric_of(view).lambda_px / size_px;
        converge(front, view_from(mesh.centre + glm::dvec3(0, -away, 0), mesh.centre), size_px);
        EXPECT_NEAR(static_cast<double>(front.triangles()) / full, share, 0.03) << size_px << " px";
        EXPECT_EQ(front.validate(), "");
    }
}

}  // namespace
