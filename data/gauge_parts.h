// Gauge parts: what round cockpit instruments are made of, in full geometry.
//
//      ___________        Gauge frame: origin in the middle of the dial's face, +x right, +y up, +z towards the
//     /  glass    \       pilot, metres. Dial radius 40 mm, case 94 mm square (a 3 1/8 inch instrument). The root
//   _|  \_dial_/   |_     node turns this frame to the mesh frame of polygon_mesh.h. Angles on a dial run clockwise
//  |__plate_________|     from twelve o'clock, radians.
//     |__ can ___|
#pragma once

#include <string>
#include <string_view>

#include "data/outline.h"
#include "data/polygon_mesh.h"

namespace data {

constexpr double kDialRadiusM = 0.040;

/// Indices into PolygonMesh::materials.
struct GaugeMaterials {
    uint32_t bezel = 0, dial = 0, mark = 0, needle = 0, steel = 0, knob = 0, drum = 0, accent = 0, glass = 0;
};

struct Gauge {
    PolygonMesh mesh;
    GaugeMaterials material;
    uint32_t case_node = 0, dial_node = 0;
};

/// A gauge with its materials, an empty root of this name and the nodes `case` and `dial`.
Gauge begin_gauge(const std::string& name);

/// Mounting plate with four slotted screws, bezel ring, can behind the panel, and the well down to the dial.
/// @param has_knob_tab  the plate reaches out at the lower left to carry a knob
void append_case(bool has_knob_tab, Gauge& gauge);

/// A slightly domed pane, node `glass`.
void append_glass(Gauge& gauge);

/// The knurled knob on the tab, node `knob`.
void append_knob(Gauge& gauge);

/// A matt disc with its face at z = 0 and openings cut through it.
void append_dial(const Shape& openings, Gauge& gauge);

/// Marks around a dial.
struct TickScale {
    int count = 50;                             ///< marks in a full turn
    int major_every = 5;                        ///< every n-th is major
    double outer_m = 0.0392;                    ///< radius where all marks end
    double minor_m = 0.0022, major_m = 0.0042;  ///< lengths
    double minor_width_m = 0.00055, major_width_m = 0.0012;
};
void append_ticks(const TickScale& scale, uint32_t node, Gauge& gauge);

/// Lettering raised from the face of the dial.
struct Lettering {
    glm::dvec2 middle{0.0};
    double height_m = 0.004;
    double weight = 0.16;   ///< stroke width over height
    double turn_rad = 0.0;  ///< of the whole text about the dial's middle, clockwise
    double face_z_m = 0.0;
};
void append_text(std::string_view text, const Lettering& lettering, uint32_t node, Gauge& gauge);

/// A raised line with round ends.
void append_line(const Polyline& line, double width_m, uint32_t node, Gauge& gauge);

/// A hand with a ridge and a hub, in a node of its own that turns about z.
struct Hand {
    std::string name;
    std::vector<glm::dvec2> stations;  ///< (y, half width), metres, ascending y
    double z_m = 0.0;                  ///< underside above the dial
    double hub_radius_m = 0.003;
    double dark_below_y_m = -1.0;  ///< stations below this are the colour of the dial
};
void append_hand(const Hand& hand, Gauge& gauge);

/// The polished cap over the shaft of the hands.
void append_hub_cap(double z_m, Gauge& gauge);

/// A row of ten-sided digit wheels behind an opening, node `name`; they read `digits`.
/// @param middle  of the row, on the dial
void append_drum(const std::string& name, std::string_view digits, const glm::dvec2& middle, Gauge& gauge);

/// The finished mesh: equal vertices united.
PolygonMesh finish_gauge(Gauge gauge);

}  // namespace data
