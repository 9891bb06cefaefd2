#include "sim/relief_timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "lod/base/check.h"

namespace sim {
namespace {

lod::Result<data::HeightBlock> block_of(const EditSource& edit, const data::HeightGrid& ground) {
    if (edit.kind == EditSource::Kind::kRaster) {
        data::HeightGridOptions reading;
        reading.voids = data::VoidPolicy::kHole;
        const lod::Result<data::HeightGrid> other = data::read_height_grid({edit.source}, reading);
        if (!other) return other.error();
        return data::make_block(ground, *other);
    }
    const glm::dvec2 place = ground.frame.grid_from_site({edit.site.x, edit.site.y, 0.0});
    if (edit.kind == EditSource::Kind::kCrater) {
        return data::make_block(ground, data::Crater{place, edit.radius_m, edit.depth_m, edit.rim_m});
    }
    return data::make_block(ground, data::Excavation{place, edit.radius_m, edit.depth_m, edit.slope_rad});
}

/// The colours before and after an edit that is in force now.
class PatchMaker {
  public:
    explicit PatchMaker(const GroundPaint& paint) : paint_(paint) {
        data::Image& image = paint.colours;
        picture_.smaller = render::make_mip_levels(image.width, image.height, image.rgba);
        picture_.full = {image.width, image.height, image.rgba};
    }

    void make(const data::HeightGrid& ground, TimedEdit& edit) {
        const TexelRect rect =
            repaint_ground(ground, paint_.imagery, paint_.options, edit.block, paint_.colours);
        const render::TexelPatch place{0, rect.x, rect.y, rect.width, rect.height, {}};
        edit.colours_before = render::update_mip_levels(picture_, place);  // of what it was: nothing changes
        copy(rect);
        edit.colours = render::update_mip_levels(picture_, place);
    }

  private:
    /// Painted texels into the picture.
    void copy(const TexelRect& rect) {
        for (int y = rect.y; y < rect.y + rect.height; ++y) {
            const ptrdiff_t first = (static_cast<ptrdiff_t>(y) * paint_.colours.width + rect.x) * 4;
            std::copy_n(paint_.colours.rgba.begin() + first, 4 * rect.width,
                        picture_.full.rgba.begin() + first);
        }
    }

    const GroundPaint& paint_;
    render::MippedPicture picture_;
};

void take_all_back(ReliefTimeline& timeline, data::HeightGrid& ground, const GroundPaint* paint) {
    for (size_t i = timeline.edits.size(); i-- > 0;) {
        step_relief(timeline, ground, false);
        if (paint != nullptr) put_texels(timeline.edits[i].colours_before, paint->colours);
    }
}

}  // namespace

lod::Result<ReliefTimeline> plan_relief(const Scene& scene, data::HeightGrid& ground,
                                        const GroundPaint* paint, unsigned threads) {
    ReliefTimeline timeline;
    if (scene.edits.empty()) return timeline;
    timeline.min_m = ground.min_m;
    timeline.max_m = ground.max_m;
    timeline.extremes = data::make_height_extremes(ground, threads);
    std::vector<EditSource> sources = scene.edits;
    std::stable_sort(sources.begin(), sources.end(),
                     [](const EditSource& a, const EditSource& b) { return a.time_s < b.time_s; });
    std::optional<PatchMaker> patches;
    if (paint != nullptr) patches.emplace(*paint);
    for (const EditSource& source : sources) {
        lod::Result<data::HeightBlock> block = block_of(source, ground);
        if (!block) return block.error();
        if (block->range.is_empty()) {
            return lod::Error{
                fmt::format("{}:{}: [[edits]] changes nothing of the terrain, expected a place on it",
                            scene.file, source.line)};
        }
        const auto [lowest, highest] = std::minmax_element(block->height_m.begin(), block->height_m.end());
        const float low_m = *lowest, high_m = *highest;
        timeline.edits.push_back({source.time_s, std::move(*block), low_m, high_m, {}, {}});
        step_relief(timeline, ground, true);
        if (patches) patches->make(ground, timeline.edits.back());
    }
    take_all_back(timeline, ground, paint);
    return timeline;
}

void put_texels(std::span<const render::TexelPatch> patches, data::Image& colours) {
    if (patches.empty()) return;
    const render::TexelPatch& patch = patches.front();
    for (int row = 0; row < patch.height; ++row) {
        const ptrdiff_t to = (static_cast<ptrdiff_t>(patch.y + row) * colours.width + patch.x) * 4;
        std::copy_n(patch.rgba.begin() + static_cast<ptrdiff_t>(row) * 4 * patch.width, 4 * patch.width,
                    colours.rgba.begin() + to);
    }
}

size_t edits_at(const ReliefTimeline& timeline, double time_s) {
    const auto first_later =
        std::upper_bound(timeline.edits.begin(), timeline.edits.end(), time_s,
                         [](double time, const TimedEdit& edit) { return time < edit.time_s; });
    return static_cast<size_t>(first_later - timeline.edits.begin());
}

const TimedEdit& step_relief(ReliefTimeline& timeline, data::HeightGrid& ground, bool forward) {
    CHECK(forward ? timeline.in_force < timeline.edits.size() : timeline.in_force > 0);
    TimedEdit& edit = timeline.edits[forward ? timeline.in_force++ : --timeline.in_force];
    data::exchange(ground, edit.block);
    data::update(timeline.extremes, ground, edit.block.range);
    ground.min_m = timeline.min_m;
    ground.max_m = timeline.max_m;
    for (size_t i = 0; i < timeline.in_force; ++i) {
        ground.min_m = std::min(ground.min_m, timeline.edits[i].low_m);
        ground.max_m = std::max(ground.max_m, timeline.edits[i].high_m);
    }
    return edit;
}

}  // namespace sim
