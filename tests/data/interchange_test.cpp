#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <assimp/Importer.hpp>
#include <map>

#include "data/object_plan.h"
#include "data/scenes/construction_site.h"
#include "data/scenes/scene_family.h"
#include "data/schedule_csv.h"
#include "data/timed_glb.h"
#include "data/timed_scene_file.h"
#include "tests/data/timed_folder.h"

namespace data {
namespace {

class Interchange : public TimedFolder {
  protected:
    /// The scene as a GLB with its schedule beside it.
    std::string write_scene(const TimedScene& scene) {
        const std::vector<char> glb = timed_glb_bytes(scene);
        write("scene.csv", schedule_csv(scene));
        return write("scene.glb", {glb.data(), glb.size()});
    }
};

/// All corners of an object's triangles in their order, at home in the object's frame.
std::vector<glm::vec3> corners(const TimedScene& scene, const TimedObject& object) {
    std::vector<glm::vec3> row;
    const TimedMesh& mesh = scene.meshes[object.mesh];
    for (const auto& triangle : mesh.triangles) {
        for (uint32_t corner : triangle)
            row.push_back(mesh.positions[corner]);
    }
    return row;
}

void expect_same(const TimedScene& a, const TimedScene& b) {
    EXPECT_EQ(a.end_s, b.end_s);
    EXPECT_LE(b.meshes.size(), a.meshes.size()) << "sharing is kept";
    ASSERT_EQ(a.objects.size(), b.objects.size());
    for (size_t i = 0; i < a.objects.size(); ++i) {
        const TimedObject &p = a.objects[i], &q = b.objects[i];
        ASSERT_EQ(p.id, q.id);
        const auto p_steps = steps_of(a, p), q_steps = steps_of(b, q);
        ASSERT_EQ(p_steps.size(), q_steps.size()) << p.id;
        for (size_t s = 0; s < p_steps.size(); ++s) {
            ASSERT_EQ(p_steps[s].time_s, q_steps[s].time_s) << p.id;
            ASSERT_EQ(p_steps[s].is_visible, q_steps[s].is_visible) << p.id;
        }
        const auto p_keys = keys_of(a, p), q_keys = keys_of(b, q);
        ASSERT_EQ(p_keys.size(), q_keys.size()) << p.id;
        for (size_t k = 0; k < p_keys.size(); ++k) {
            ASSERT_EQ(p_keys[k].position, q_keys[k].position) << p.id;
            ASSERT_NEAR(glm::dot(p_keys[k].rotation, q_keys[k].rotation), 1.0, 1e-15) << p.id;
        }
    }
    std::map<std::pair<uint32_t, uint32_t>, bool> compared;
    for (size_t i = 0; i < a.objects.size(); ++i) {
        const TimedObject &p = a.objects[i], &q = b.objects[i];
        if (!compared.insert({{p.mesh, q.mesh}, true}).second) continue;
        ASSERT_EQ(corners(a, p), corners(b, q)) << p.id;
        const TimedMesh &m = a.meshes[p.mesh], &n = b.meshes[q.mesh];
        for (size_t t = 0; t < m.triangles.size(); ++t) {
            for (size_t c = 0; c < 3; ++c) {
                ASSERT_EQ(m.colours[m.triangles[t][c]], n.colours[n.triangles[t][c]]) << p.id;
                ASSERT_LT(glm::distance(m.normals[m.triangles[t][c]], n.normals[n.triangles[t][c]]), 1e-5f)
                    << p.id;
            }
        }
    }
}

TEST_F(Interchange, GlbAndScheduleGiveTheFamilyBack) {
    const TimedScene scene = generate_family({.objects = 500, .events_per_object = 2.5, .moving_share = 0.3});
    const auto back = read_timed_scene(write_scene(scene));
    ASSERT_TRUE(back) << back.message();
    expect_same(scene, *back);
}

TEST_F(Interchange, GlbAndScheduleGiveTheConstructionSiteBack) {
    const TimedScene scene = generate_construction_site(0);
    const auto back = read_timed_scene(write_scene(scene));
    ASSERT_TRUE(back) << back.message();
    expect_same(scene, *back);
    const ClassCounts counts = count_classes(*back);
    EXPECT_EQ(counts.triangles, (std::array<uint64_t, 3>{66784, 2879506, 1313767}));
}

/// Assimp alone, without any of our reader: nodes, sharing, triangles and places.
TEST_F(Interchange, AssimpReadsTheGlb) {
    const TimedScene scene = generate_family({.objects = 300, .triangles = 71});
    const std::string path = write_scene(scene);
    Assimp::Importer importer;
    const aiScene* read = importer.ReadFile(path, 0);
    ASSERT_NE(read, nullptr) << importer.GetErrorString();
    EXPECT_EQ(read->mNumMeshes, 8u);
    const aiNode* root = read->mRootNode;
    ASSERT_EQ(root->mNumChildren, 300u);
    for (unsigned i = 0; i < root->mNumChildren; ++i) {
        const aiNode& node = *root->mChildren[i];
        ASSERT_EQ(node.mName.C_Str(), scene.objects[i].id);
        ASSERT_EQ(node.mNumMeshes, 1u);
        ASSERT_EQ(read->mMeshes[node.mMeshes[0]]->mNumFaces, 71u);
        const aiVector3D place =
            root->mTransformation * (node.mTransformation * aiVector3D(0.0f, 0.0f, 0.0f));
        const glm::dvec3& expected = keys_of(scene, scene.objects[i])[0].position;
        ASSERT_NEAR(static_cast<double>(place.x), expected.x, 1e-4);
        ASSERT_NEAR(static_cast<double>(place.y), expected.z, 1e-4) << "glTF is y up";
        ASSERT_NEAR(static_cast<double>(place.z), -expected.y, 1e-4);
    }
}

/// What the schedule's text says, cell by cell, against the scene it was read into.
TEST_F(Interchange, ASchedulePutsTimeIntoAModel) {
    const TimedScene plain = generate_family({.objects = 4, .events_per_object = 0.0});
    const std::vector<char> glb = timed_glb_bytes(plain);
    const std::string model = write("parts.glb", {glb.data(), glb.size()});
    const std::string schedule =
        write("when.csv",
              "# a comment\n"
              "appears_s;id;disappears_s;time_s;x_m;y_m;z_m;heading_deg;qx;qy;qz;qw\n"
              "10;part-1;20\n"
              "30;part-1;\n"
              ";part-2;5\n"
              "\n"
              "7;part-3;7\n"
              ";part-4;;60;4;5;6\n"
              ";\"part-4\";;20;1;2;3;90\n"
              ";;100\n");
    const auto scene = read_timed_scene(model, {.schedule = schedule});
    ASSERT_TRUE(scene) << scene.message();
    EXPECT_EQ(scene->end_s, 100.0);
    const auto seen = [&](size_t object) {
        std::string text;
        for (const double time_s : {0.0, 6.0, 15.0, 25.0, 99.0})
            text += is_visible(*scene, scene->objects[object], time_s) ? '1' : '0';
        return text;
    };
    EXPECT_EQ(seen(0), "00101");
    EXPECT_EQ(seen(1), "10000");
    EXPECT_EQ(seen(2), "00000") << "appears and disappears in one instant";
    EXPECT_EQ(seen(3), "11111");
    EXPECT_EQ(motion_class(*scene, scene->objects[3]), MotionClass::kDynamic);
    const ObjectPose pose = pose_at(*scene, scene->objects[3], 20.0);
    EXPECT_EQ(pose.position, glm::dvec3(1, 2, 3));
    const glm::dvec3 front = pose.rotation * glm::dvec3(0, -1, 0);
    EXPECT_NEAR(front.x, 1.0, 1e-12) << "the front of heading 90 looks east";
    EXPECT_EQ(pose_at(*scene, scene->objects[3], 60.0).position, glm::dvec3(4, 5, 6));
}

TEST_F(Interchange, ModelsComeWithTheSchedule) {
    const TimedScene plain = generate_family({.objects = 3, .events_per_object = 0.0});
    const std::vector<char> glb = timed_glb_bytes(plain);
    write("crane.glb", {glb.data(), glb.size()});
    const std::string path = write("alone.csv",
                                   "id,appears_s,time_s,x_m,y_m,z_m,model\n"
                                   "one,,0,0,0,0,crane.glb\n"
                                   "one,,50,9,0,0\n"
                                   "two,10,0,100,0,0,crane.glb\n");
    const auto scene = read_timed_scene(path);
    ASSERT_TRUE(scene) << scene.message();
    ASSERT_EQ(scene->objects.size(), 2u);
    EXPECT_EQ(scene->meshes.size(), 1u) << "one model, one mesh";
    EXPECT_EQ(scene->meshes[0].triangles.size(), 3u * 60u);
    EXPECT_EQ(scene->end_s, 50.0) << "the last time in the file";
    EXPECT_EQ(motion_class(*scene, scene->objects[0]), MotionClass::kDynamic);
    EXPECT_EQ(motion_class(*scene, scene->objects[1]), MotionClass::kPseudoDynamic);
}

TEST_F(Interchange, BadSchedulesAreRefusedInOneLine) {
    const TimedScene plain = generate_family({.objects = 2, .events_per_object = 0.0});
    const std::vector<char> glb = timed_glb_bytes(plain);
    const std::string model = write("parts.glb", {glb.data(), glb.size()});
    const auto refusal = [&](const std::string& text) {
        const auto scene = read_timed_scene(model, {.schedule = write("bad.csv", text)});
        EXPECT_FALSE(scene) << text;
        const std::string message = scene ? "" : scene.message();
        EXPECT_EQ(message.find('\n'), std::string::npos);
        EXPECT_NE(message.find("bad.csv"), std::string::npos) << message;
        return message;
    };
    const std::string head = "id,appears_s,disappears_s,time_s,x_m,y_m,z_m,qx,qy,qz,qw\n";
    EXPECT_NE(refusal("").find("empty"), std::string::npos);
    EXPECT_NE(refusal("appears_s\n1\n").find("no column id"), std::string::npos);
    EXPECT_NE(refusal("id,colour\n").find("'colour'"), std::string::npos);
    EXPECT_NE(refusal(head + "part-9,1\n").find("bad.csv:2: 'part-9'"), std::string::npos);
    EXPECT_NE(refusal(head + "part-1,soon\n").find("'soon'"), std::string::npos);
    EXPECT_NE(refusal(head + "part-1,nan\n").find("'nan'"), std::string::npos);
    EXPECT_NE(refusal(head + "part-1,,,inf,0,0,0\n").find("'inf'"), std::string::npos);
    EXPECT_NE(refusal(head + "part-1,,,1,0,0\n").find("z_m"), std::string::npos);
    EXPECT_NE(refusal(head + "part-1,,,1,0,0,0,1,2\n").find("quaternion"), std::string::npos);
    EXPECT_NE(refusal(head + "part-1,,,1,0,0,0,0,0,0,0\n").find("rotation"), std::string::npos);
    EXPECT_NE(refusal(head + ",,-5\n").find("end"), std::string::npos);
    EXPECT_NE(refusal(head + "part-1,1").find("cut short"), std::string::npos);
    EXPECT_FALSE(read_timed_scene(model, {.schedule = (folder_ / "missing.csv").string()}));
    EXPECT_FALSE(read_timed_scene((folder_ / "missing.glb").string()));
}

/// Nasty but defined, through files: no triangles, never there, for ever, 10^9 s, quoted ids.
TEST_F(Interchange, NastyScenesSurviveTheRoundTrip) {
    TimedScene scene = generate_family({.objects = 1, .events_per_object = 0.0});
    scene.end_s = 1e9;
    scene.meshes.push_back({});
    const auto add = [&](const std::string& id, uint32_t mesh, std::vector<VisibilityStep> events) {
        ASSERT_TRUE(append_object({mesh, id, std::move(events), {KeyFrame{}}}, scene));
    };
    const auto bare = static_cast<uint32_t>(scene.meshes.size() - 1);
    add("bare", bare, {{0.25, true}});
    add("never", 0, {{5.0, true}, {5.0, false}});
    add("a, \"quoted\" id", 1, {{123456789.125, true}, {999999999.5, false}});
    add("outside", 1, {{-7.5, true}, {2e9, false}});
    add("#4", 2, {{0.1, false}, {0.2, true}, {0.3, false}});
    const auto back = read_timed_scene(write_scene(scene));
    ASSERT_TRUE(back) << back.message();
    expect_same(scene, *back);
}

}  // namespace
}  // namespace data
