// Surface patterns: small tiled pictures of what is too fine for any source: grass, roofing, windows.
//
// A pattern multiplies the colour of the surface it lies on. Its mip chain ends in its
// own mean, so what is smaller than a pixel is drawn as its mean colour and cannot sparkle. Nothing here is measured.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace render {

/// Layers of the pattern texture; render/shaders know them by the same names.
enum class Pattern : uint8_t {
    kPlain = 0,   ///< neutral everywhere
    kGround = 1,  ///< tufts and clods, lit by the sun
    kRoof = 2,    ///< weathered roofing
    kHouse = 3,   ///< facade of 8 x 8 bays: windows with shutters …
    kFlats = 4,   ///< … wider windows, storeys marked
    kOffice = 5,  ///< … and bands of glass
};
inline constexpr int kPatternCount = 6;

inline constexpr int kPatternSide_px = 512;
inline constexpr uint8_t kNeutral = 128;       ///< of 255: the factor 1
inline constexpr double kGroundTile_m = 57.0;  ///< sides of one tile
inline constexpr double kRoofTile_m = 16.0;    ///< a power of two: exact in scene.vert wherever the eye is
inline constexpr double kFacadeTile_m = 24.0;  ///< 8 storeys and 8 bays of 3 m

/// Paints one layer: the factors of red, green and blue of kPatternSide_px² texels; rows of ground and roofs from the
/// north, of facades from below. The mean of ground and roof is neutral.
/// @param sun_enu  towards the sun in east, north, up: the ground's relief is lit by it
/// Cost: about 0.2 us per texel.
std::vector<glm::vec3> paint_pattern(Pattern pattern, const glm::vec3& sun_enu);

/// The next level of the mip chain, a quarter of the texels; the mean stays as it is.
std::vector<glm::vec3> halved(const std::vector<glm::vec3>& factors, int side_px);

/// Red, green, blue, 255 per texel; factors beyond 2 are cut.
std::vector<uint8_t> encode_factors(const std::vector<glm::vec3>& factors);

}  // namespace render
