#include "objects/reduction/face_soup.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "lod/base/check.h"

namespace objects {

namespace {

struct Cell {
    int64_t x, y, z;
    uint32_t point;

    auto key() const { return std::tie(x, y, z); }
};

/// Faces in order of their corner sets; equal sets lie together, first of the input first.
std::vector<uint32_t> faces_by_corners(const FaceSoup& soup) {
    std::vector<std::array<uint32_t, 3>> corners = soup.faces;
    for (auto& face : corners)
        std::sort(face.begin(), face.end());
    std::vector<uint32_t> order(corners.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        return corners[a] != corners[b] ? corners[a] < corners[b] : a < b;
    });
    return order;
}

bool have_same_corners(std::array<uint32_t, 3> a, std::array<uint32_t, 3> b) {
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    return a == b;
}

bool is_collapsed(const std::array<uint32_t, 3>& face) {
    return face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
}

void drop_collapsed_and_repeated(FaceSoup& soup) {
    const std::vector<uint32_t> order = faces_by_corners(soup);
    std::vector<uint8_t> is_kept(soup.faces.size(), 0);
    for (size_t i = 0; i < order.size(); ++i) {
        const bool is_repeated = i > 0 && have_same_corners(soup.faces[order[i]], soup.faces[order[i - 1]]);
        is_kept[order[i]] = !is_repeated && !is_collapsed(soup.faces[order[i]]);
    }
    size_t kept = 0;
    for (size_t i = 0; i < is_kept.size(); ++i) {
        if (!is_kept[i]) continue;
        soup.faces[kept] = soup.faces[i];
        soup.colours[kept++] = soup.colours[i];
    }
    soup.faces.resize(kept);
    soup.colours.resize(kept);
}

}  // namespace

void append_soup(const FaceSoup& soup, const glm::dmat3& rotation, const glm::dvec3& offset, FaceSoup& out) {
    const uint32_t base = static_cast<uint32_t>(out.points.size());
    for (const glm::dvec3& point : soup.points)
        out.points.push_back(rotation * point + offset);
    for (const auto& [a, b, c] : soup.faces)
        out.faces.push_back({a + base, b + base, c + base});
    out.colours.insert(out.colours.end(), soup.colours.begin(), soup.colours.end());
}

WeldedSoup weld(const FaceSoup& soup, double cell_m) {
    CHECK(cell_m > 0.0);
    WeldedSoup welded;
    const uint32_t count = static_cast<uint32_t>(soup.points.size());
    glm::dvec3 low(0.0);
    for (uint32_t i = 0; i < count; ++i)
        low = i == 0 ? soup.points[0] : glm::min(low, soup.points[i]);
    std::vector<Cell> cells(count);
    for (uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 at = (soup.points[i] - low) / cell_m;
        cells[i] = {int64_t(at.x), int64_t(at.y), int64_t(at.z), i};
    }
    std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) {
        return a.key() != b.key() ? a.key() < b.key() : a.point < b.point;
    });
    // The cell's first point of the input stands for all of it.
    std::vector<uint32_t> first_of(count);
    for (size_t i = 0; i < cells.size(); ++i)
        first_of[cells[i].point] =
            i > 0 && cells[i].key() == cells[i - 1].key() ? first_of[cells[i - 1].point] : cells[i].point;
    welded.point_of.resize(count);
    for (uint32_t i = 0; i < count; ++i) {
        if (first_of[i] == i) {
            welded.point_of[i] = static_cast<uint32_t>(welded.soup.points.size());
            welded.soup.points.push_back(soup.points[i]);
        } else {
            welded.point_of[i] = welded.point_of[first_of[i]];
        }
    }
    welded.soup.faces.reserve(soup.faces.size());
    for (const auto& [a, b, c] : soup.faces)
        welded.soup.faces.push_back({welded.point_of[a], welded.point_of[b], welded.point_of[c]});
    welded.soup.colours = soup.colours;
    drop_collapsed_and_repeated(welded.soup);
    return welded;
}

void drop_unused_points(FaceSoup& soup) {
    constexpr uint32_t kUnused = 0xffffffffu;
    std::vector<uint32_t> place(soup.points.size(), kUnused);
    for (const auto& face : soup.faces) {
        for (uint32_t corner : face)
            place[corner] = 0;
    }
    uint32_t kept = 0;
    for (size_t i = 0; i < place.size(); ++i) {
        if (place[i] == kUnused) continue;
        place[i] = kept;
        soup.points[kept++] = soup.points[i];
    }
    soup.points.resize(kept);
    for (auto& face : soup.faces) {
        for (uint32_t& corner : face)
            corner = place[corner];
    }
}

}  // namespace objects
