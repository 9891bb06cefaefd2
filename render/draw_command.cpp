#include "render/draw_command.h"

#include <ranges>

#include "lod/base/check.h"

namespace render {

namespace {

DrawCommand command_of(const lod::DrawItem& item) {
    return {.index_count = item.index_count,
            .instance_count = 1,
            .first_index = item.first_index,
            .base_vertex = item.base_vertex,
            .base_instance = item.instance};
}

}  // namespace

size_t build_commands(std::span<const lod::DrawItem> items, const std::optional<lod::DrawItem>& sky,
                      std::span<DrawCommand> out) {
    CHECK(out.size() > items.size());
    size_t count = 0;
    for (const lod::DrawItem& item : items) {
        if (!item.is_glass && item.index_count > 0) out[count++] = command_of(item);
    }
    if (sky) out[count++] = command_of(*sky);
    for (const lod::DrawItem& item : std::views::reverse(items)) {
        if (item.is_glass && item.index_count > 0) out[count++] = command_of(item);
    }
    return count;
}

}  // namespace render
