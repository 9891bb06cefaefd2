#include "render/drawn_triangles.h"

namespace render {

namespace {

/// Where one instance's vertices are in the world.
struct Placement {
    const lod::Instance& instance;
    const lod::View& view;
    double lambda_px = 1.0;
};

glm::dvec3 vec_of(const float v[4]) {
    return {double(v[0]), double(v[1]), double(v[2])};
}

glm::dvec3 eye_of(const glm::dvec3& position, const Placement& at) {
    const auto& m = at.instance.eye_from_model;
    const glm::dvec3 from_eye = position - (vec_of(at.instance.origin_hi) + vec_of(at.instance.origin_lo));
    return {glm::dot(vec_of(m[0]), from_eye), glm::dot(vec_of(m[1]), from_eye),
            glm::dot(vec_of(m[2]), from_eye)};
}

glm::dvec3 world_of(const lod::Vertex& vertex, const Placement& at) {
    const glm::dvec3 model = lod::position_of(vertex);
    const bool is_foot = vertex.colour[3] == static_cast<uint8_t>(lod::Material::kWallFoot);
    if (at.instance.is_world == 1 && !is_foot) return model;
    const glm::dmat3 world_from_eye = glm::transpose(at.view.eye_from_world);
    const glm::dvec3 eye = eye_of(model, at);
    const glm::dvec3 world = at.instance.is_world == 1 ? model : at.view.eye_world + world_from_eye * eye;
    if (!is_foot) return world;
    const double lowered_m = double(at.instance.up_eye[3]) * -eye.z / at.lambda_px;
    return world - world_from_eye * vec_of(at.instance.up_eye) * lowered_m;
}

}  // namespace

DrawnTriangles triangles_of(const DrawnBuffers& buffers, const lod::View& view) {
    DrawnTriangles out;
    const double lambda_px = lod::metric_of(view).lambda_px;
    for (const DrawCommand& command : buffers.commands) {
        const lod::Instance& instance = buffers.instances[command.base_instance];
        if (instance.module == static_cast<uint32_t>(lod::Module::kSky)) continue;
        const Placement at{instance, view, lambda_px};
        for (uint32_t corner = 0; corner + 2 < command.index_count; corner += 3) {
            const uint32_t* named = &buffers.indices[command.first_index + corner];
            if (named[0] == named[1]) continue;  // fills a gap between others
            std::array<glm::dvec3, 3> triangle;
            for (uint32_t i = 0; i < 3; ++i) {
                const int64_t index = int64_t{named[i]};
                triangle[i] =
                    world_of(buffers.vertices[static_cast<size_t>(index + command.base_vertex)], at);
            }
            out.world.push_back(triangle);
            out.module.push_back(static_cast<lod::Module>(instance.module));
        }
    }
    return out;
}

}  // namespace render
