#include "lod/progressive/hpm_format.h"

#include "lod/base/sealed_bytes.h"
#include "lod/progressive/hierarchy_check.h"

namespace lod {
namespace {

constexpr Seal kSeal{{'H', 'a', 'r', 'r', 'i', 'e', 'r', 'M'}, 2, "a progressive mesh", "harrier mesh build"};

/// All arrays of a hierarchy, in the file's order.
template <typename Hierarchy, typename Visit>
void for_each_array(Hierarchy& h, const Visit& visit) {
    visit(h.position), visit(h.parent), visit(h.children), visit(h.triangles);
    visit(h.vertex_node), visit(h.normal), visit(h.colour), visit(h.triangle_vertices);
    visit(h.removed_begin), visit(h.removed), visit(h.kept_begin), visit(h.kept), visit(h.kept_vertex);
    visit(h.error_m), visit(h.centre), visit(h.radius_m), visit(h.cone_axis), visit(h.cone_cos);
}

void read_node(ByteReader& in, ProgressiveNode& node) {
    in.array(node.name);
    in.value(node.parent);
    in.value(node.parent_from_node);
}

void read_part(ByteReader& in, ProgressivePart& part) {
    uint32_t is_glass = 0;
    in.value(part.node);
    in.value(is_glass);
    in.value(part.report);
    part.is_glass = is_glass != 0;
    in.value(part.hierarchy.leaf_count);
    for_each_array(part.hierarchy, [&in](auto& array) { in.array(array); });
}

/// What the model is made of must be there.
std::string fault_of(const ProgressiveModel& model) {
    for (size_t i = 0; i < model.nodes.size(); ++i) {
        if (model.nodes[i].parent < -1 || model.nodes[i].parent >= static_cast<int64_t>(i))
            return "node '" + model.nodes[i].name + "' has a parent behind it; expected parents first";
    }
    for (const ProgressivePart& part : model.parts) {
        if (part.node >= model.nodes.size()) return "a part of no node; expected one of the model";
        if (std::string fault = fault_of(part.hierarchy); !fault.empty()) return fault;
    }
    return "";
}

}  // namespace

std::vector<unsigned char> encode_hpm(const ProgressiveModel& model) {
    std::vector<unsigned char> bytes = begin_sealed();
    ByteWriter out(bytes);
    out.value(model.file_from_model);
    out.value(static_cast<uint64_t>(model.nodes.size()));
    for (const ProgressiveNode& node : model.nodes) {
        out.array(node.name);
        out.value(node.parent);
        out.value(node.parent_from_node);
    }
    out.value(static_cast<uint64_t>(model.parts.size()));
    for (const ProgressivePart& part : model.parts) {
        out.value(part.node);
        out.value(static_cast<uint32_t>(part.is_glass ? 1 : 0));
        out.value(part.report);
        out.value(part.hierarchy.leaf_count);
        for_each_array(part.hierarchy, [&out](const auto& array) { out.array(array); });
    }
    seal(bytes, kSeal);
    return bytes;
}

Result<ProgressiveModel> decode_hpm(std::span<const unsigned char> bytes) {
    const auto body = unseal(bytes, kSeal);
    if (!body) return body.error();
    ByteReader in(*body);
    ProgressiveModel model;
    uint64_t nodes = 0, parts = 0;
    in.value(model.file_from_model);
    in.value(nodes);
    for (uint64_t i = 0; i < nodes && in.is_whole(); ++i)
        read_node(in, model.nodes.emplace_back());
    in.value(parts);
    for (uint64_t i = 0; i < parts && in.is_whole(); ++i)
        read_part(in, model.parts.emplace_back());
    if (!in.is_done()) return Error{"is damaged; expected a whole .hpm file, build it anew"};
    if (std::string fault = fault_of(model); !fault.empty()) return Error{"holds " + fault};
    return model;
}

}  // namespace lod
