// GLB parts: what all writers of binary glTF share: buffer views, accessors, JSON text, the container.
//
// Source: Khronos glTF 2.0 specification, sections 3.6 and 4.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace data {

/// The two halves of a GLB while it grows.
struct Glb {
    std::vector<char> binary;
    std::string views, accessors;  ///< JSON array elements
    int view_count = 0, accessor_count = 0;
};

constexpr int kGlbUint16 = 5123, kGlbUint32 = 5125, kGlbFloat = 5126;  ///< component types
constexpr int kGlbVertices = 34962, kGlbIndices = 34963;               ///< targets of views

/// A number in JSON, short enough for float32.
std::string json_number(double value);

/// Text in JSON, control characters as blanks.
std::string json_string(const std::string& text);

/// Appends an element to the inside of a JSON array.
void append_element(std::string& array, const std::string& element);

/// glTF colours are linear.
double linear_from_srgb(float srgb);

/// Appends bytes, padded to four. @returns the view's index
int append_view(const void* bytes, size_t size, int target, Glb& glb);

struct GlbAccessor {
    int view = 0;
    int component = kGlbFloat;
    size_t count = 0;
    std::string rest;  ///< further members, each with its comma ahead
};
/// @returns the accessor's index
int append_accessor(const GlbAccessor& accessor, Glb& glb);

/// float32 triples; not empty where bounds are asked for. @returns the accessor's index
int append_vectors(const std::vector<glm::vec3>& vectors, bool with_bounds, Glb& glb);

/// Indices, of 16 bits where the vertices allow it. @returns the accessor's index
int append_indices(const std::vector<uint32_t>& indices, size_t vertex_count, Glb& glb);

/// The container around a document and its buffer.
std::vector<char> pack_glb(std::string json, const Glb& glb);

}  // namespace data
