#include "sim/cluster_file.h"

#include "data/file_bytes.h"
#include "objects/tree_file.h"
#include "sim/whole_file.h"

namespace sim {

lod::Result<objects::ClusterTree> read_cluster_file(const std::string& path) {
    constexpr size_t kMost_bytes = size_t{1} << 40;
    const auto bytes = data::read_file(path, kMost_bytes);
    if (!bytes) return bytes.error();
    auto tree = objects::decode_tree(*bytes);
    if (!tree) return lod::Error{path + ": " + tree.message()};
    return tree;
}

lod::Result<uint64_t> write_cluster_file(const std::string& path, const objects::ClusterTree& tree) {
    const std::vector<unsigned char> bytes = objects::encode_tree(tree);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (auto written = write_whole(path, text); !written) return written.error();
    return uint64_t{bytes.size()};
}

}  // namespace sim
