#include "data/timed_fbx.h"

#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <map>
#include <set>

#include "data/fbx_node.h"
#include "data/object_plan.h"
#include "data/scenes/construction_site.h"
#include "data/scenes/scene_family.h"
#include "data/timed_scene_file.h"
#include "tests/data/timed_folder.h"

namespace data {
namespace {

class TimedFbx : public TimedFolder {
  protected:
    std::string write_scene(const TimedScene& scene) {
        const auto bytes = timed_fbx_bytes(scene);
        EXPECT_TRUE(bytes) << bytes.message();
        return write("scene.fbx", *bytes);
    }
};

constexpr double kTickS = 1.1e-11;  // and float64's rounding of some thousand seconds

std::map<std::string, const TimedObject*> by_id(const TimedScene& scene) {
    std::map<std::string, const TimedObject*> objects;
    for (const TimedObject& object : scene.objects)
        objects[object.id] = &object;
    return objects;
}

/// Visibility to the tick, places of what rests to the last bit, of what moves to float32.
void expect_same(const TimedScene& a, const TimedScene& b) {
    EXPECT_NEAR(a.end_s, b.end_s, kTickS);
    EXPECT_LE(b.meshes.size(), a.meshes.size()) << "sharing is kept";
    ASSERT_EQ(a.objects.size(), b.objects.size());
    const auto others = by_id(b);
    for (const TimedObject& p : a.objects) {
        ASSERT_TRUE(others.contains(p.id)) << p.id;
        const TimedObject& q = *others.at(p.id);
        ASSERT_EQ(a.meshes[p.mesh].triangles.size(), b.meshes[q.mesh].triangles.size()) << p.id;
        const auto p_steps = steps_of(a, p), q_steps = steps_of(b, q);
        ASSERT_EQ(p_steps.size(), q_steps.size()) << p.id;
        for (size_t s = 0; s < p_steps.size(); ++s) {
            ASSERT_NEAR(p_steps[s].time_s, q_steps[s].time_s, 1e-9) << p.id;
            ASSERT_EQ(p_steps[s].is_visible, q_steps[s].is_visible) << p.id;
        }
        const auto p_keys = keys_of(a, p), q_keys = keys_of(b, q);
        ASSERT_EQ(p_keys.size(), q_keys.size()) << p.id;
        const bool rests = p_keys.size() == 1;
        for (size_t k = 0; k < p_keys.size(); ++k) {
            ASSERT_TRUE(rests || std::abs(p_keys[k].time_s - q_keys[k].time_s) < 1e-9) << p.id;
            const double off_m = glm::distance(p_keys[k].position, q_keys[k].position);
            ASSERT_LE(off_m, rests ? 0.0 : 1e-7 * glm::length(p_keys[k].position)) << p.id;
            const double turn = std::abs(glm::dot(p_keys[k].rotation, q_keys[k].rotation));
            ASSERT_NEAR(turn, 1.0, rests ? 1e-14 : 1e-12) << p.id;
        }
    }
}

TEST_F(TimedFbx, GivesTheFamilyBack) {
    const TimedScene scene = generate_family({.objects = 400, .events_per_object = 2.5, .moving_share = 0.3});
    const auto back = read_timed_scene(write_scene(scene));
    ASSERT_TRUE(back) << back.message();
    expect_same(scene, *back);
    const TimedMesh &mesh = scene.meshes[scene.objects[7].mesh],
                    &other = back->meshes[by_id(*back).at(scene.objects[7].id)->mesh];
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (size_t c = 0; c < 3; ++c) {
            const uint32_t i = mesh.triangles[t][c], k = other.triangles[t][c];
            ASSERT_EQ(mesh.positions[i], other.positions[k]);
            ASSERT_EQ(mesh.colours[i], other.colours[k]);
            ASSERT_LT(glm::distance(mesh.normals[i], other.normals[k]), 1e-5f);
        }
    }
}

TEST_F(TimedFbx, GivesTheConstructionSiteBack) {
    const TimedScene scene = generate_construction_site(3);
    const auto back = read_timed_scene(write_scene(scene));
    ASSERT_TRUE(back) << back.message();
    expect_same(scene, *back);
    const ClassCounts counts = count_classes(*back);
    EXPECT_EQ(counts.objects, (std::array<uint64_t, 3>{498, 40010, 15649}));
    EXPECT_EQ(counts.triangles, (std::array<uint64_t, 3>{66784, 2879506, 1313767}));
}

/// Assimp alone: models, sharing, triangles, places, and curves of what moves; of visibility it keeps nothing.
TEST_F(TimedFbx, AssimpReadsIt) {
    const TimedScene scene = generate_family({.objects = 200, .triangles = 71, .moving_share = 0.25});
    const std::string path = write_scene(scene);
    Assimp::Importer importer;
    const aiScene* read = importer.ReadFile(path, 0);
    ASSERT_NE(read, nullptr) << importer.GetErrorString();
    EXPECT_EQ(read->mNumMeshes, 8u);
    const auto objects = by_id(scene);
    size_t found = 0;
    const auto visit = [&](const auto& self, const aiNode& node, const aiMatrix4x4& above) -> void {
        const aiMatrix4x4 placed = above * node.mTransformation;
        if (node.mNumMeshes > 0) {
            ++found;
            ASSERT_TRUE(objects.contains(node.mName.C_Str())) << node.mName.C_Str();
            const TimedObject& object = *objects.at(node.mName.C_Str());
            ASSERT_EQ(read->mMeshes[node.mMeshes[0]]->mNumFaces, 71u);
            const aiVector3D place = placed * aiVector3D(0.0f, 0.0f, 0.0f);
            const glm::dvec3& expected = keys_of(scene, object)[0].position;
            ASSERT_LT(glm::distance(glm::dvec3(place.x, place.y, place.z), expected), 1e-3) << object.id;
        }
        for (unsigned i = 0; i < node.mNumChildren; ++i)
            self(self, *node.mChildren[i], placed);
    };
    visit(visit, *read->mRootNode, aiMatrix4x4());
    EXPECT_EQ(found, 200u);
    ASSERT_EQ(read->mNumAnimations, 1u);
    std::set<std::string> moving;
    for (unsigned i = 0; i < read->mAnimations[0]->mNumChannels; ++i) {
        const std::string name = read->mAnimations[0]->mChannels[i]->mNodeName.C_Str();
        moving.insert(name.substr(0, name.find("_$AssimpFbx$")));
    }
    EXPECT_EQ(moving.size(), count_classes(scene).objects[2]);
}

TEST_F(TimedFbx, NastyScenesSurviveTheRoundTrip) {
    TimedScene scene = generate_family({.objects = 1, .events_per_object = 0.0});
    scene.end_s = 1e8;
    const auto add = [&](const std::string& id, std::vector<VisibilityStep> events,
                         std::vector<KeyFrame> keys) {
        const auto added = append_object({0, id, std::move(events), std::move(keys)}, scene);
        ASSERT_TRUE(added) << added.message();
    };
    const auto turned = [](double time_s, double w, double x, double y, double z) {
        return KeyFrame{time_s, {1.0, 2.0, 3.0}, glm::normalize(glm::dquat(w, x, y, z))};
    };
    add("never", {{5.0, true}, {5.0, false}}, {KeyFrame{}});
    add("outside", {{-7.5, true}, {1.5e8, false}}, {KeyFrame{}});
    add("at first", {{0.25, false}, {0.5, true}, {0.75, false}}, {KeyFrame{}});
    add("upright", {}, {turned(0.0, 1.0, 0.0, 1.0, 0.0)});  // a quarter about y: where Euler angles lock
    add("backwards", {}, {turned(0.0, 1.0, 0.0, -1.0, 0.0)});
    add("any way", {}, {turned(0.0, 0.3, -0.5, 0.7, 0.2), turned(2.0, -0.4, 0.1, 0.6, -0.9)});
    const auto back = read_timed_scene(write_scene(scene));
    ASSERT_TRUE(back) << back.message();
    expect_same(scene, *back);
}

TEST_F(TimedFbx, SaysWhatFbxCannotHold) {
    TimedScene scene = generate_family({.objects = 1});
    scene.end_s = 1e9;
    const auto bytes = timed_fbx_bytes(scene);
    ASSERT_FALSE(bytes);
    EXPECT_NE(bytes.message().find("199 million"), std::string::npos);
}

TEST_F(TimedFbx, CutFilesAreRefused) {
    const auto bytes = timed_fbx_bytes(generate_family({.objects = 12, .moving_share = 0.5}));
    ASSERT_TRUE(bytes);
    ASSERT_TRUE(parse_fbx(*bytes, "whole"));
    const size_t records = bytes->size() - 200;  // the rest is the footer, which says nothing
    for (size_t length = 0; length < records; length += 1 + length / 97)
        ASSERT_FALSE(parse_fbx(std::string_view(*bytes).substr(0, length), "cut")) << length;
    std::string broken = *bytes;
    for (size_t i = 27; i < broken.size(); i += 131) {  // whatever comes of it, it ends
        const char was = broken[i];
        broken[i] = static_cast<char>(~was);
        (void)parse_fbx(broken, "broken").operator bool();
        broken[i] = was;
    }
}

}  // namespace
}  // namespace data
