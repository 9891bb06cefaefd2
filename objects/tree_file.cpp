#include "objects/tree_file.h"

#include "lod/base/sealed_bytes.h"

namespace objects {
namespace {

constexpr lod::Seal kSeal{
    {'H', 'a', 'r', 'r', 'i', 'e', 'r', 'C'}, 5, "a cluster tree", "harrier objects build"};

/// All of a tree, in the file's order.
template <typename Tree, typename Values, typename Arrays>
void for_each_part(Tree& tree, const Values& value, const Arrays& array) {
    value(tree.end_s), value(tree.origin_site), value(tree.object_count);
    array(tree.clusters), array(tree.geometries), array(tree.vertices), array(tree.indices);
    array(tree.facings), array(tree.solids);
    array(tree.motions), array(tree.keys);
    array(tree.visibilities), array(tree.step_time_s), array(tree.step_value), array(tree.step_integral_s);
}

}  // namespace

std::vector<unsigned char> encode_tree(const ClusterTree& tree) {
    std::vector<unsigned char> bytes = lod::begin_sealed();
    size_t size_bytes = bytes.size() + sizeof(uint32_t);
    for_each_part(
        tree, [&](const auto& value) { size_bytes += sizeof(value); },
        [&](const auto& array) { size_bytes += sizeof(uint64_t) + array.size() * sizeof(array[0]); });
    bytes.reserve(size_bytes);
    lod::ByteWriter out(bytes);
    out.value(static_cast<uint32_t>(tree.is_on_earth ? 1 : 0));
    for_each_part(
        tree, [&out](const auto& value) { out.value(value); },
        [&out](const auto& array) { out.array(array); });
    lod::seal(bytes, kSeal);
    return bytes;
}

lod::Result<ClusterTree> decode_tree(std::span<const unsigned char> bytes) {
    const auto body = lod::unseal(bytes, kSeal);
    if (!body) return body.error();
    lod::ByteReader in(*body);
    ClusterTree tree;
    uint32_t is_on_earth = 0;
    in.value(is_on_earth);
    for_each_part(
        tree, [&in](auto& value) { in.value(value); }, [&in](auto& array) { in.array(array); });
    tree.is_on_earth = is_on_earth != 0;
    if (!in.is_done()) return lod::Error{"is damaged; expected a whole cluster tree, build it anew"};
    if (const std::string fault = fault_of(tree); !fault.empty()) return lod::Error{"holds " + fault};
    return tree;
}

}  // namespace objects
