#include "lod/progressive/edge_words.h"

#include <algorithm>

namespace lod {
namespace {

/// Cancels inverse pairs, also across the ends.
void reduce_loop(const CoarseMesh& mesh, Loop& loop) {
    size_t end = 0;
    for (CornerId letter : loop) {
        if (end > 0 && loop[end - 1] == mesh.mate(letter)) {
            --end;
        } else {
            loop[end++] = letter;
        }
    }
    size_t begin = 0;
    while (end - begin >= 2 && loop[begin] == mesh.mate(loop[end - 1])) {
        ++begin;
        --end;
    }
    loop.resize(end);
    loop.erase(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(begin));
}

/// The node round which a letter goes: on its left when counter-clockwise.
NodeId pivot(const CoarseMesh& mesh, CornerId letter, bool is_ccw) {
    return is_ccw ? mesh.head(letter) : mesh.node(letter);
}

}  // namespace

/// Sends the longest run round `node` the other way, when that is shorter. Leaves the run at the loop's front.
bool Filling::shorten_round(const CoarseMesh& mesh, NodeId node, CornerId corner, Loop& loop) {
    mesh.fan_at(corner, fan_);
    const size_t around = fan_.corners.size();
    if (!fan_.is_closed) return false;
    for (const bool is_ccw : {true, false}) {
        const auto turns = [&](CornerId letter) { return pivot(mesh, letter, is_ccw) == node; };
        const auto stop = std::find_if_not(loop.begin(), loop.end(), turns);
        std::rotate(loop.begin(), stop == loop.end() ? loop.begin() : stop, loop.end());
        for (size_t begin = 0, end = 0; begin < loop.size(); begin = std::max(end, begin + 1)) {
            end = begin;
            while (end < loop.size() && end - begin < around && turns(loop[end]))
                ++end;
            if (2 * (end - begin) <= around) continue;
            std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(begin), loop.end());
            const size_t run = end - begin;
            // From the triangle before the run to the one behind it, round the other side.
            const CornerId first = is_ccw ? next_corner(loop[0]) : loop[0];
            const auto at = std::find(fan_.corners.begin(), fan_.corners.end(), first);
            if (at == fan_.corners.end()) return false;
            const auto from = static_cast<size_t>(at - fan_.corners.begin());
            const size_t to = is_ccw ? (from + run) % around : (from + around - run) % around;
            other_.clear();
            if (run != around)
                walk_fan(fan_, from, to, !is_ccw, [&](CornerId letter) { other_.push_back(letter); });
            loop.erase(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(run));
            loop.insert(loop.begin(), other_.begin(), other_.end());
            return true;
        }
    }
    return false;
}

bool Filling::is_fillable(const CoarseMesh& mesh, Loop& loop, std::span<const NodeId> pierced,
                          std::span<const CornerId> corner_of_node) {
    reduce_loop(mesh, loop);
    while (!loop.empty()) {
        const bool is_shorter = std::any_of(pierced.begin(), pierced.end(), [&](NodeId node) {
            return shorten_round(mesh, node, corner_of_node[node], loop);
        });
        if (!is_shorter) return false;
        reduce_loop(mesh, loop);
    }
    return true;
}

}  // namespace lod
