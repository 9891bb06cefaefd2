// StrokeFont: digits and a few letters as centre lines, for lettering in real geometry.
#pragma once

#include <string_view>

#include "data/outline.h"

namespace data {

/// Centre lines of a glyph on a baseline: capitals and digits reach from y = 0 to 1.
struct Glyph {
    std::vector<Polyline> strokes;
    double width = 0.0;  ///< of the centre lines
};

/// Digits 0-9, the letters of instrument labels, and '/', '.', '-'; empty for any other character.
Glyph glyph_of(char character);

/// A line of text centred at `middle`, upright.
/// @param height_m  of the centre lines of a capital
/// @param weight    stroke width as a share of the height
Shape text_shape(std::string_view text, const glm::dvec2& middle, double height_m, double weight);

}  // namespace data
