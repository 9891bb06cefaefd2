// Draw commands: from the items of a draw list to the array that glMultiDrawElementsIndirect reads. No GL here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "lod/draw_list.h"

namespace render {

/// The record OpenGL defines for indexed indirect draws.
/// Source: OpenGL 4.5 core specification, 10.5 (DrawElementsIndirectCommand).
struct DrawCommand {
    uint32_t index_count = 0;
    uint32_t instance_count = 0;
    uint32_t first_index = 0;
    int32_t base_vertex = 0;
    uint32_t base_instance = 0;  ///< the instance record; the vertex shader's attributes of an instance
};
static_assert(sizeof(DrawCommand) == 20 && offsetof(DrawCommand, base_instance) == 16);

/// Puts the items in drawing order: opaque as listed, then the sky behind them, then glass from the last to the first.
/// Lists that go from near to far shade little twice and blend their panes rightly.
///
/// @param items  empty ones (index_count 0) are left out
/// @param sky    none: no sky is drawn
/// @param out    at least items.size() + 1 long; written in order, never read
/// @returns      the number of commands written
/// Cost: two passes over the items, no allocation.
size_t build_commands(std::span<const lod::DrawItem> items, const std::optional<lod::DrawItem>& sky,
                      std::span<DrawCommand> out);

}  // namespace render
