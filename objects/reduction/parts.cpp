#include "objects/reduction/parts.h"

#include <algorithm>
#include <numeric>

namespace objects {

std::vector<std::vector<uint32_t>> parts_of(const FaceSoup& soup, const std::vector<uint32_t>& point_of,
                                            size_t point_count) {
    constexpr uint32_t kNoPart = 0xffffffffu;
    std::vector<uint32_t> parent(point_count);
    std::iota(parent.begin(), parent.end(), 0u);
    const auto find = [&](uint32_t i) {
        while (parent[i] != i)
            i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const auto& face : soup.faces) {
        for (const uint32_t corner : face)
            parent[find(point_of[corner])] = find(point_of[face[0]]);
    }
    std::vector<std::vector<uint32_t>> parts;
    std::vector<uint32_t> number(point_count, kNoPart);
    for (uint32_t face = 0; face < soup.faces.size(); ++face) {
        uint32_t& part = number[find(point_of[soup.faces[face][0]])];
        if (part == kNoPart) {
            part = static_cast<uint32_t>(parts.size());
            parts.emplace_back();
        }
        parts[part].push_back(face);
    }
    return parts;
}

FaceSoup part_of(const FaceSoup& soup, const std::vector<uint32_t>& faces) {
    std::vector<uint32_t> corners;
    for (const uint32_t face : faces)
        corners.insert(corners.end(), soup.faces[face].begin(), soup.faces[face].end());
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    FaceSoup part;
    for (const uint32_t corner : corners)
        part.points.push_back(soup.points[corner]);
    for (const uint32_t face : faces) {
        std::array<uint32_t, 3> moved;
        for (size_t k = 0; k < 3; ++k)
            moved[k] = static_cast<uint32_t>(
                std::lower_bound(corners.begin(), corners.end(), soup.faces[face][k]) - corners.begin());
        part.faces.push_back(moved);
        part.colours.push_back(soup.colours[face]);
    }
    return part;
}

bool is_closed(const FaceSoup& soup, std::span<const uint32_t> faces, const std::vector<uint32_t>& point_of) {
    std::vector<std::array<uint32_t, 2>> there, back;
    for (const uint32_t face : faces) {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = point_of[soup.faces[face][k]], b = point_of[soup.faces[face][(k + 1) % 3]];
            if (a == b) continue;
            there.push_back({a, b});
            back.push_back({b, a});
        }
    }
    std::sort(there.begin(), there.end());
    std::sort(back.begin(), back.end());
    return there == back && std::adjacent_find(there.begin(), there.end()) == there.end();
}

}  // namespace objects
