#include "data/stroke_font.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

namespace data {

namespace {

constexpr double kGap = 0.3;  // between the centre lines of neighbours, in heights
constexpr int kQuarterSegments = 3;

struct Arc {
    double x, y, radius_x, radius_y;
    double from_deg, to_deg;  ///< counter-clockwise from +x when rising
};

/// Appends an arc to a line; steps of at most 20 degrees.
void append_arc(const Arc& arc, Polyline& out) {
    const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(arc.to_deg - arc.from_deg) / 20.0)));
    for (int i = 0; i <= steps; ++i) {
        const double angle =
            (arc.from_deg + (arc.to_deg - arc.from_deg) * i / steps) * std::numbers::pi / 180.0;
        out.push_back({arc.x + arc.radius_x * std::cos(angle), arc.y + arc.radius_y * std::sin(angle)});
    }
}

/// A stroke of points and arcs: points, then arcs, then points.
Polyline stroke(const Polyline& before, std::initializer_list<Arc> arcs, const Polyline& after = {}) {
    Polyline line = before;
    for (const Arc& arc : arcs)
        append_arc(arc, line);
    line.insert(line.end(), after.begin(), after.end());
    return line;
}

Glyph half_turned(Glyph glyph) {
    for (Polyline& line : glyph.strokes) {
        for (glm::dvec2& point : line)
            point = glm::dvec2(glyph.width, 1.0) - point;
    }
    return glyph;
}

Glyph digit(char character) {
    switch (character) {
        case '0':
            return {
                {stroke({}, {{.28, .72, .28, .28, 0, 180}, {.28, .28, .28, .28, 180, 360}}, {{.56, .72}})},
                .56};
        case '1':
            return {{{{.0, .8}, {.24, 1.}, {.24, .0}}}, .3};
        case '2':
            return {{stroke({}, {{.28, .72, .28, .28, 170, -38}}, {{.0, .0}, {.56, .0}})}, .56};
        case '3':
            return {
                {stroke({}, {{.28, .75, .25, .25, 155, -90}}), stroke({}, {{.28, .25, .28, .25, 90, -155}})},
                .56};
        case '4':
            return {{{{.42, .0}, {.42, 1.}, {.0, .3}, {.58, .3}}}, .58};
        case '5':
            return {{stroke({{.5, 1.}, {.08, 1.}}, {{.27, .31, .29, .31, 128, -150}})}, .56};
        case '6':
            return {
                {stroke({{.44, 1.}, {.3, .88}, {.17, .72}, {.06, .52}}, {{.28, .29, .28, .29, 160, 520}})},
                .56};
        case '7':
            return {{{{.0, 1.}, {.54, 1.}, {.18, .0}}}, .54};
        case '8':
            return {{stroke({}, {{.28, .76, .24, .24, 0, 360}}), stroke({}, {{.28, .27, .28, .27, 0, 360}})},
                    .56};
        case '9':
            return half_turned(digit('6'));
        default:
            return {};
    }
}

Glyph capital(char character) {
    switch (character) {
        case 'A':
            return {{{{.0, .0}, {.3, 1.}, {.6, .0}}, {{.1, .33}, {.5, .33}}}, .6};
        case 'D':
            return {{stroke({{.25, .0}, {.0, .0}, {.0, 1.}, {.25, 1.}}, {{.25, .5, .33, .5, 90, -90}})}, .58};
        case 'E':
            return {{{{.46, 1.}, {.0, 1.}, {.0, .0}, {.46, .0}}, {{.0, .52}, {.4, .52}}}, .46};
        case 'G':
            return {{stroke({}, {{.33, .5, .33, .5, 50, 330}}, {{.62, .45}, {.36, .45}})}, .64};
        case 'H':
            return {{{{.0, .0}, {.0, 1.}}, {{.56, .0}, {.56, 1.}}, {{.0, .5}, {.56, .5}}}, .56};
        case 'I':
            return {{{{.0, .0}, {.0, 1.}}}, .0};
        case 'L':
            return {{{{.0, 1.}, {.0, .0}, {.46, .0}}}, .46};
        case 'N':
            return {{{{.0, .0}, {.0, 1.}, {.58, .0}, {.58, 1.}}}, .58};
        case 'P':
            return {{stroke({{.0, .0}, {.0, 1.}, {.26, 1.}}, {{.26, .75, .28, .25, 90, -90}}, {{.0, .5}})},
                    .54};
        case 'R':
            return {{stroke({{.0, .0}, {.0, 1.}, {.26, 1.}}, {{.26, .75, .28, .25, 90, -90}}, {{.0, .5}}),
                     {{.28, .5}, {.56, .0}}},
                    .56};
        case 'S':
            return {{stroke({}, {{.27, .76, .26, .24, 30, 270}, {.27, .26, .27, .26, 90, -150}})}, .54};
        case 'T':
            return {{{{.0, 1.}, {.6, 1.}}, {{.3, 1.}, {.3, .0}}}, .6};
        case 'W':
            return {{{{.0, 1.}, {.2, .0}, {.4, .8}, {.6, .0}, {.8, 1.}}}, .8};
        default:
            return {};
    }
}

Glyph small_letter(char character) {
    switch (character) {
        case 'a':
            return {{stroke({}, {{.24, .28, .24, .28, 0, 360}}), {{.48, .58}, {.48, .0}}}, .48};
        case 'h':
            return {{{{.0, .0}, {.0, 1.}}, stroke({}, {{.22, .38, .22, .22, 180, 0}}, {{.44, .0}})}, .44};
        case 'k':
            return {{{{.0, .0}, {.0, 1.}}, {{.4, .6}, {.0, .25}}, {{.14, .37}, {.42, .0}}}, .42};
        case 'm':
            return {{{{.0, .0}, {.0, .6}},
                     stroke({}, {{.18, .4, .18, .2, 180, 0}}, {{.36, .0}}),
                     stroke({}, {{.54, .4, .18, .2, 180, 0}}, {{.72, .0}})},
                    .72};
        case 's':
            return {{stroke({}, {{.2, .45, .19, .15, 30, 270}, {.2, .15, .2, .15, 90, -150}})}, .4};
        case 'x':
            return {{{{.0, .05}, {.42, .55}}, {{.0, .55}, {.42, .05}}}, .42};
        default:
            return {};
    }
}

}  // namespace

Glyph glyph_of(char character) {
    if (character >= '0' && character <= '9') return digit(character);
    if (character >= 'A' && character <= 'Z') return capital(character);
    if (character >= 'a' && character <= 'z') return small_letter(character);
    if (character == '/') return {{{{.0, -.1}, {.36, 1.05}}}, .36};
    if (character == '.') return {{{{.0, .0}, {.01, .0}}}, .01};
    if (character == '-') return {{{{.0, .5}, {.4, .5}}}, .4};
    return {};
}

Shape text_shape(std::string_view text, const glm::dvec2& middle, double height_m, double weight) {
    double width = 0.0;
    for (char character : text)
        width += glyph_of(character).width + kGap;
    glm::dvec2 pen(-(width - kGap) / 2.0, -0.5);
    Shape shape;
    for (char character : text) {
        Glyph glyph = glyph_of(character);
        for (Polyline& line : glyph.strokes) {
            for (glm::dvec2& point : line)
                point = middle + height_m * (pen + point);
        }
        pen.x += glyph.width + kGap;
        if (glyph.strokes.empty()) continue;
        const Shape drawn = stroke_shape(glyph.strokes, weight * height_m, kQuarterSegments);
        shape.insert(shape.end(), drawn.begin(), drawn.end());
    }
    return shape;
}

}  // namespace data
