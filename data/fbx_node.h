// FbxNode: the records that a binary FBX file is made of, and how they are written and read.
//
//     file    "Kaydara FBX Binary  \0" 1a 00, version, records, an empty record, a footer
//     record  end offset, number and bytes of its properties, name, properties, records inside it, an empty record
//
// Versions 7100 to 7400 have offsets of 32 bits, 7500 and later of 64; written is 7400. Big arrays are zipped.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lod/base/result.h"

namespace data {

/// int32_t and int64_t are different properties to other programs; integer_at reads both.
using FbxProperty = std::variant<int32_t, int64_t, double, std::string, std::vector<int32_t>,
                                 std::vector<int64_t>, std::vector<float>, std::vector<double>>;

struct FbxNode {
    std::string name;
    std::vector<FbxProperty> properties;
    std::vector<FbxNode> children;
};

/// The first child of a name, or null.
const FbxNode* find_child(const FbxNode& node, std::string_view name);

/// A property as what it can be read as; nothing where it is not there or another kind. Whole numbers count as numbers.
const std::string* text_at(const FbxNode& node, size_t index);
std::optional<int64_t> integer_at(const FbxNode& node, size_t index);
double number_at(const FbxNode& node, size_t index, double otherwise);

/// "name\0\1Class": an object's name without its class.
std::string plain_name(const std::string& name);

/// A file is begun, records are appended, and it is ended. A record that is open takes what is appended as its children.
void begin_fbx_file(std::string& out);
void append_fbx_node(const FbxNode& node, std::string& out);
size_t begin_fbx_node(std::string_view name, std::string& out);
void end_fbx_node(size_t begin, std::string& out);
void end_fbx_file(std::string& out);

/// The records of a binary FBX file. Fails naming the byte on what is no FBX, text FBX, and one cut short.
/// @param path  for the message
lod::Result<std::vector<FbxNode>> parse_fbx(std::string_view bytes, const std::string& path);

}  // namespace data
