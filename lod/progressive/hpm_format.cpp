#include "lod/progressive/hpm_format.h"

#include <array>
#include <bit>
#include <cstring>
#include <type_traits>

#include "lod/base/hash.h"
#include "lod/progressive/hierarchy_check.h"

namespace lod {
namespace {

static_assert(std::endian::native == std::endian::little, "files are read and written as they lie in memory");

constexpr std::array<char, 8> kName = {'H', 'a', 'r', 'r', 'i', 'e', 'r', 'M'};
constexpr uint64_t kVersion = 1;

struct Preamble {
    std::array<char, 8> name = kName;
    uint64_t version = kVersion;
    uint64_t size_bytes = 0;  ///< of the whole file
    uint64_t checksum = 0;    ///< hash_bytes of all that follows
};
static_assert(sizeof(Preamble) == 32);

/// Appends values; arrays behind their length.
class Writer {
  public:
    explicit Writer(std::vector<unsigned char>& bytes) : bytes_(bytes) {}

    template <typename Value>
    void value(const Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        raw(&value, sizeof(Value));
    }
    template <typename Array>
    void array(const Array& array) {
        value(static_cast<uint64_t>(array.size()));
        if (!array.empty()) raw(array.data(), array.size() * sizeof(array[0]));
    }

  private:
    void raw(const void* from, size_t size) {
        const auto* begin = static_cast<const unsigned char*>(from);
        bytes_.insert(bytes_.end(), begin, begin + size);
    }
    std::vector<unsigned char>& bytes_;
};

/// Takes values off the front; after the first that is not there, everything is empty and is_whole() false.
class Reader {
  public:
    explicit Reader(std::span<const unsigned char> bytes) : rest_(bytes) {}

    template <typename Value>
    void value(Value& value) {
        raw(&value, sizeof(Value));
    }
    template <typename Array>
    void array(Array& array) {
        uint64_t count = 0;
        value(count);
        if (count > rest_.size() / sizeof(array[0])) is_whole_ = false;
        if (!is_whole_) return;
        array.resize(count);
        if (count > 0) raw(array.data(), count * sizeof(array[0]));
    }
    bool is_whole() const { return is_whole_; }
    size_t left() const { return rest_.size(); }

  private:
    void raw(void* to, size_t size) {
        if (!is_whole_ || size > rest_.size()) {
            is_whole_ = false;
            return;
        }
        std::memcpy(to, rest_.data(), size);
        rest_ = rest_.subspan(size);
    }
    std::span<const unsigned char> rest_;
    bool is_whole_ = true;
};

/// All arrays of a hierarchy, in the file's order.
template <typename Hierarchy, typename Visit>
void for_each_array(Hierarchy& h, const Visit& visit) {
    visit(h.position), visit(h.parent), visit(h.children), visit(h.triangles);
    visit(h.vertex_node), visit(h.normal), visit(h.colour), visit(h.triangle_vertices);
    visit(h.removed_begin), visit(h.removed), visit(h.kept_begin), visit(h.kept), visit(h.kept_vertex);
    visit(h.error_m), visit(h.centre), visit(h.radius_m), visit(h.cone_axis), visit(h.cone_cos);
}

void read_node(Reader& in, ProgressiveNode& node) {
    in.array(node.name);
    in.value(node.parent);
    in.value(node.parent_from_node);
}

void read_part(Reader& in, ProgressivePart& part) {
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

Result<ProgressiveModel> read_model(std::span<const unsigned char> bytes) {
    const Error damaged{"is damaged; expected a whole .hpm file, build it anew"};
    Reader in(bytes);
    ProgressiveModel model;
    uint64_t nodes = 0, parts = 0;
    in.value(model.file_from_model);
    in.value(nodes);
    for (uint64_t i = 0; i < nodes && in.is_whole(); ++i)
        read_node(in, model.nodes.emplace_back());
    in.value(parts);
    for (uint64_t i = 0; i < parts && in.is_whole(); ++i)
        read_part(in, model.parts.emplace_back());
    if (!in.is_whole() || in.left() != 0) return damaged;
    if (std::string fault = fault_of(model); !fault.empty()) return Error{"holds " + fault};
    return model;
}

}  // namespace

std::vector<unsigned char> encode_hpm(const ProgressiveModel& model) {
    std::vector<unsigned char> bytes(sizeof(Preamble));
    Writer out(bytes);
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
    Preamble preamble;
    preamble.size_bytes = bytes.size();
    preamble.checksum = hash_bytes(std::span(bytes).subspan(sizeof(Preamble)));
    std::memcpy(bytes.data(), &preamble, sizeof(Preamble));
    return bytes;
}

Result<ProgressiveModel> decode_hpm(std::span<const unsigned char> bytes) {
    Preamble preamble;
    if (bytes.size() < sizeof(Preamble))
        return Error{"is too short; expected a file made by 'harrier mesh build'"};
    std::memcpy(&preamble, bytes.data(), sizeof(Preamble));
    if (preamble.name != kName)
        return Error{"is no progressive mesh; expected a file made by 'harrier mesh build'"};
    if (preamble.version != kVersion) {
        return Error{"is a progressive mesh of version " + std::to_string(preamble.version) +
                     "; expected version " + std::to_string(kVersion) + ", build it anew"};
    }
    if (preamble.size_bytes != bytes.size()) {
        return Error{"has " + std::to_string(bytes.size()) + " bytes; expected " +
                     std::to_string(preamble.size_bytes) + ", build it anew"};
    }
    const std::span<const unsigned char> body = bytes.subspan(sizeof(Preamble));
    if (hash_bytes(body) != preamble.checksum)
        return Error{"is damaged; expected a whole .hpm file, build it anew"};
    return read_model(body);
}

}  // namespace lod
