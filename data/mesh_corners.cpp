#include "data/mesh_corners.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lod/base/hash.h"

namespace data {

namespace {

constexpr uint32_t kNone = UINT32_MAX;
constexpr float kCosCrease = 0.76604444f;  // of 40 degrees
constexpr size_t kMaxCreaseFan = 2048;     // beyond, comparing all pairs would take too long

uint32_t word_of(float value) {
    return std::bit_cast<uint32_t>(value == 0.0f ? 0.0f : value);
}

void append_words(std::vector<uint32_t>& words, const float* values, size_t count) {
    for (size_t i = 0; i < count; ++i)
        words.push_back(word_of(values[i]));
}

std::vector<uint32_t> number_positions(const std::vector<glm::vec3>& positions) {
    std::vector<uint32_t> words;
    words.reserve(positions.size() * 3);
    for (const glm::vec3& position : positions)
        append_words(words, &position.x, 3);
    return number_equal(words, 3);
}

/// Corner lists by place: corners of place p are order[begin[p]] .. order[begin[p + 1]].
struct CornersByPlace {
    std::vector<uint32_t> begin, order;
};

CornersByPlace sort_by_place(const std::vector<uint32_t>& place) {
    const uint32_t places = place.empty() ? 0 : *std::max_element(place.begin(), place.end()) + 1;
    CornersByPlace lists;
    lists.begin.assign(places + 1, 0);
    for (const uint32_t p : place)
        ++lists.begin[p + 1];
    for (uint32_t p = 0; p < places; ++p)
        lists.begin[p + 1] += lists.begin[p];
    std::vector<uint32_t> next(lists.begin.begin(), lists.begin.end() - 1);
    lists.order.resize(place.size());
    for (uint32_t corner = 0; corner < place.size(); ++corner)
        lists.order[next[place[corner]]++] = corner;
    return lists;
}

/// Unit normal of the facet a corner belongs to (zero without area) and the angle it spans there.
struct FacetCorner {
    glm::vec3 normal{0.0f};
    float angle = 0.0f;
};

std::vector<FacetCorner> facet_corners(const std::vector<glm::vec3>& positions) {
    std::vector<FacetCorner> facets(positions.size());
    for (size_t t = 0; t + 2 < positions.size(); t += 3) {
        const glm::dvec3 p[3] = {glm::dvec3(positions[t]), glm::dvec3(positions[t + 1]),
                                 glm::dvec3(positions[t + 2])};
        const glm::dvec3 across = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double length = glm::length(across);
        if (!(length > 0.0)) continue;
        for (size_t corner = 0; corner < 3; ++corner) {
            const glm::dvec3 a = p[(corner + 1) % 3] - p[corner], b = p[(corner + 2) % 3] - p[corner];
            facets[t + corner] = {glm::vec3(across / length),
                                  static_cast<float>(std::atan2(length, glm::dot(a, b)))};
        }
    }
    return facets;
}

glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& otherwise) {
    const float length = glm::length(v);
    return length > 1e-6f ? v / length : otherwise;
}

/// The mean normal of the facets in `around` that lean less than the crease from `own`; of all when own is zero.
glm::vec3 mean_normal(std::span<const uint32_t> around, const std::vector<FacetCorner>& facets,
                      const glm::vec3& own) {
    const bool takes_all = own == glm::vec3(0.0f) || around.size() > kMaxCreaseFan;
    glm::vec3 sum(0.0f);
    for (const uint32_t corner : around) {
        const FacetCorner& facet = facets[corner];
        if (takes_all || glm::dot(own, facet.normal) >= kCosCrease) sum += facet.angle * facet.normal;
    }
    return unit_or(sum, unit_or(own, {0.0f, 0.0f, 1.0f}));
}

}  // namespace

std::vector<uint32_t> number_equal(std::span<const uint32_t> words, size_t words_per_item) {
    const size_t count = words.size() / words_per_item;
    const auto item = [&](size_t i) { return words.subspan(i * words_per_item, words_per_item); };
    std::vector<uint32_t> number(count), first;                        // first: item each number stands for
    std::vector<uint32_t> slots(std::bit_ceil(2 * count + 2), kNone);  // open addressing: numbers
    for (size_t i = 0; i < count; ++i) {
        uint64_t hash = 0;
        for (const uint32_t word : item(i))
            hash = (std::rotl(hash, 23) ^ word) * 0x9e3779b97f4a7c15u;
        size_t slot = lod::mix64(hash) & (slots.size() - 1);
        while (slots[slot] != kNone && !std::ranges::equal(item(first[slots[slot]]), item(i)))
            slot = (slot + 1) & (slots.size() - 1);
        if (slots[slot] == kNone) {
            slots[slot] = static_cast<uint32_t>(first.size());
            first.push_back(static_cast<uint32_t>(i));
        }
        number[i] = slots[slot];
    }
    return number;
}

void make_smooth_normals(MeshCorners& corners) {
    if (std::ranges::none_of(corners.normals, [](const glm::vec3& n) { return n == glm::vec3(0.0f); }))
        return;
    const std::vector<uint32_t> place = number_positions(corners.positions);
    const CornersByPlace lists = sort_by_place(place);
    const std::vector<FacetCorner> facets = facet_corners(corners.positions);
    const std::span<const uint32_t> order(lists.order);
    for (size_t corner = 0; corner < place.size(); ++corner) {
        if (corners.normals[corner] != glm::vec3(0.0f)) continue;
        const uint32_t begin = lists.begin[place[corner]], end = lists.begin[place[corner] + 1];
        corners.normals[corner] =
            mean_normal(order.subspan(begin, end - begin), facets, facets[corner].normal);
    }
}

WeldedCorners weld(const MeshCorners& corners) {
    constexpr size_t kWords = 13;
    std::vector<uint32_t> words;
    words.reserve(corners.positions.size() * kWords);
    for (size_t i = 0; i < corners.positions.size(); ++i) {
        append_words(words, &corners.positions[i].x, 3);
        append_words(words, &corners.normals[i].x, 3);
        append_words(words, &corners.uvs[i].x, 2);
        append_words(words, &corners.tints[i].x, 4);
        words.push_back(corners.materials[i]);
    }
    const std::vector<uint32_t> number = number_equal(words, kWords);
    WeldedCorners welded;
    MeshCorners& vertices = welded.vertices;
    for (size_t i = 0; i < number.size(); ++i) {
        if (number[i] < vertices.positions.size()) continue;
        vertices.positions.push_back(corners.positions[i]);
        vertices.normals.push_back(corners.normals[i]);
        vertices.uvs.push_back(corners.uvs[i]);
        vertices.tints.push_back(corners.tints[i]);
        vertices.materials.push_back(corners.materials[i]);
    }
    for (size_t i = 0; i + 2 < number.size(); i += 3)
        welded.triangles.push_back({number[i], number[i + 1], number[i + 2]});
    return welded;
}

}  // namespace data
