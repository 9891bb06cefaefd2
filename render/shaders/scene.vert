// Every vertex of the scene. The preamble (shaders.cpp) gives #version and the constants.

// lod::Vertex
layout(location = 0) in vec3 position_hi;
layout(location = 1) in vec3 position_lo;
layout(location = 2) in uvec2 surface;
layout(location = 3) in uvec4 colour_material;

// lod::Instance, one for all vertices of a command: an attribute that stands still is fetched once, not per vertex
layout(location = 4) in vec4 eye_from_model[3];  // rows
layout(location = 7) in vec4 origin_hi;
layout(location = 8) in vec4 origin_lo;
layout(location = 9) in vec4 instance_up_eye;  // w: ground error in px for kWallFoot

out gl_PerVertex { vec4 gl_Position; };
// Packed: the set-up of a triangle costs a software rasteriser by the vec4.
out vec4 v_colour;         // display values, premultiplied by alpha
out vec3 v_place_haze;     // place in the surface pattern, tiles; octaves of contrast lost per metre of sight, mean
flat out vec4 v_pattern;   // xy: zero of the place; z: layer; w: 0 where the ground texture multiplies, else 1

// Linear light on a white surface; a clear morning: warm sun, blue sky, a little light back from the ground.
const vec3 kSunLight = vec3(1.00, 0.90, 0.74) * 0.86;
const vec3 kSkyLight = vec3(0.74, 0.87, 1.10) * 0.40;
const vec3 kGroundLight = vec3(0.92, 0.84, 0.70) * 0.17;
const vec3 kReflectedZenith = vec3(0.42, 0.60, 0.82);
const vec3 kReflectedHorizon = vec3(0.86, 0.90, 0.93);

vec3 decode_normal(uvec2 code) {
    vec2 uv = vec2(bitfieldExtract(ivec2(code), 0, 16)) / 32767.0;
    vec3 n = vec3(uv, 1.0 - abs(uv.x) - abs(uv.y));
    if (n.z < 0.0) n.xy = (1.0 - abs(uv.yx)) * mix(vec2(1.0), vec2(-1.0), lessThan(uv, vec2(0.0)));
    return n;
}

// World axes, or the model's; metres from the eye.
vec3 position_near_eye() {
    precise vec3 near_eye = (position_hi - origin_hi.xyz) + (position_lo - origin_lo.xyz);
    return near_eye;
}

vec3 position_in_eye(vec3 near_eye) {
    precise vec3 eye = vec3(dot(eye_from_model[0].xyz, near_eye),
                            dot(eye_from_model[1].xyz, near_eye),
                            dot(eye_from_model[2].xyz, near_eye));
    return eye;
}

vec3 normal_in_eye() {
    vec3 n = decode_normal(surface);
    return normalize(vec3(dot(eye_from_model[0].xyz, n), dot(eye_from_model[1].xyz, n),
                          dot(eye_from_model[2].xyz, n)));
}

// Display colour of a matt surface with a soft sheen; `albedo` in display values, gamma taken as 2.
vec3 lit(vec3 albedo, vec3 normal, vec3 towards_eye, float sheen) {
    float lambert = max(dot(normal, sun_eye.xyz), 0.0);
    vec3 light = kSunLight * lambert + mix(kGroundLight, kSkyLight, 0.5 + 0.5 * dot(normal, up_eye.xyz));
    float half_way = max(dot(normal, normalize(towards_eye + sun_eye.xyz)), 0.0);
    float half_4 = half_way * half_way * half_way * half_way;
    float half_16 = half_4 * half_4 * half_4 * half_4;
    return sqrt(albedo * albedo * light + kSunLight * (sheen * half_16 * lambert));
}

// Light on what is upright and looks all round, seen from an eye: the mean of what is seen of a round tower, the lit side from
// the sun's, below a share of roof. The mean over the half circle that is seen, (sin a + (pi - a) cos a) / 4 for an azimuth
// a between eye and sun, is a parabola in the cosine within 0.005.
vec3 lit_all_round(vec3 albedo, float up_share, vec3 towards_eye) {
    float eye_up = dot(towards_eye, up_eye.xyz), sun_up = dot(sun_eye.xyz, up_eye.xyz);
    float eye_level = sqrt(max(1.0 - eye_up * eye_up, 1e-6)), sun_level = sqrt(max(1.0 - sun_up * sun_up, 1e-6));
    float c = clamp((dot(towards_eye, sun_eye.xyz) - eye_up * sun_up) / (eye_level * sun_level), -1.0, 1.0);
    float walls = (1.0 - up_share) * eye_level * 0.3183099, roofs = up_share * max(eye_up, 0.0);
    float roof_share = roofs / max(walls + roofs, 1e-6);
    vec3 on_walls = kSunLight * (sun_level * (0.25 + c * (0.3925 + 0.1425 * c))) + mix(kGroundLight, kSkyLight, 0.5);
    vec3 on_roofs = kSunLight * max(sun_up, 0.0) + kSkyLight;
    return albedo * sqrt(mix(on_walls, on_roofs, roof_share));
}

// A pane: hardly there when seen square on, a mirror of the sky when grazed.
vec4 glass(vec3 tint, vec3 normal, vec3 towards_eye) {
    float facing = abs(dot(normal, towards_eye));
    float graze = (1.0 - facing) * (1.0 - facing);
    vec3 mirrored = reflect(-towards_eye, normal);
    float height = clamp(dot(mirrored, up_eye.xyz), 0.0, 1.0);
    float alpha = 0.08 + 0.30 * graze * graze;
    return vec4(tint * mix(kReflectedHorizon, kReflectedZenith, height) * alpha, alpha);
}

vec4 surface_colour(uint material, vec3 normal, vec3 position_eye) {
    vec3 colour = vec3(colour_material.rgb) / 255.0;
    vec3 towards_eye = -normalize(position_eye);
    if (material == kGround) return vec4(1.0);
    if (material == kGlow) return vec4(colour, 1.0);
    if (material == kAllRound)
        return vec4(lit_all_round(colour, float(surface.x) / 65535.0, towards_eye), 1.0);
    if (material == kGlass) return glass(colour, normal, towards_eye);
    float dimming = material == kWallFoot ? 0.88 : material == kWall ? 0.97 : 1.0;
    return vec4(lit(colour * dimming, normal, towards_eye, material == kPaint ? 0.22 : 0.0), 1.0);
}

// Which pattern lies on the surface. All walls of a building have one colour, so they get the same facade; one in
// five has bands of glass.
uint pattern_of(uint material, float steepness) {
    if (material == kGround) return kGrain;
    if (material == kRoof) return kRoofing;
    bool is_wall = (material == kWall || material == kWallFoot) && steepness < 0.5;
    uvec3 colour = colour_material.rgb;
    return is_wall ? kFirstFacade + (colour.r * 7u + colour.g * 3u + colour.b) % 5u / 2u : kPlain;
}

// The roof's points along the two axes of the world that its normal is farthest from. Tiles are a power of two of
// metres, so whole ones fall out of the eye's coordinates without any rounding.
vec2 roof_place(vec3 near_eye) {
    vec3 tiles = near_eye * kRoofTilesPerMetre + fract(origin_hi.xyz * kRoofTilesPerMetre) +
                 origin_lo.xyz * kRoofTilesPerMetre;
    vec3 steep = abs(decode_normal(surface));
    if (steep.z >= max(steep.x, steep.y)) return tiles.xy;
    return steep.x >= steep.y ? tiles.yz : tiles.xz;
}

// lod::ground_sample; whole numbers below 2^24 are exact.
vec2 ground_sample() {
    return vec2(surface | (255u - colour_material.rg) << 16);
}

// Along the wall and up.
vec2 wall_place(vec3 normal, vec3 position_eye) {
    vec3 along = cross(up_eye.xyz, normal);
    along *= inversesqrt(max(dot(along, along), 1e-6));
    return vec2(dot(along, position_eye), dot(up_eye.xyz, position_eye)) * kFacadeTilesPerMetre;
}

// Mean extinction between the eye and a point: the exact integral through air that thins exponentially with
// height. A smooth function of the point's height alone, so vertices are close enough to interpolate.
float mean_haze(vec3 position_eye) {
    float thinning = clamp(dot(position_eye, up_eye.xyz) * haze.y, -1.0 - haze.z, 60.0);
    float density_there = exp2(-(haze.z + thinning));
    float mean = (haze.w - density_there) / (thinning * 0.693147);
    return haze.x * (abs(thinning) < 1e-3 ? haze.w : mean);
}

void main() {
    uint material = colour_material.a;
    if (material == kSky) {
        gl_Position = vec4(position_hi.xy * up_eye.w, 0.0, 1.0);
        v_colour = vec4(0.0, 0.0, 0.0, 1.0);
        v_place_haze = vec3(0.0, 0.0, 1e3);  // nothing but air
        v_pattern = vec4(0.0, 0.0, kPlain, 1.0);
        return;
    }
    vec3 near_eye = position_near_eye();
    vec3 eye = position_in_eye(near_eye);
    if (material == kWallFoot) eye += instance_up_eye.xyz * (instance_up_eye.w * eye.z * projection.w);
    gl_Position = vec4(eye.xy * projection.xy, projection.z, -eye.z);
    vec3 normal = normal_in_eye();
    v_colour = surface_colour(material, normal, eye);
    uint pattern = pattern_of(material, abs(dot(normal, up_eye.xyz)));
    vec2 wall = wall_place(normal, eye);
    vec2 place = (ground_sample() - ground_tiles.zw) * ground_tiles.xy + ground_phase.xy;
    if (pattern == kPlain) place = vec2(0.0);
    if (pattern == kRoofing) place = roof_place(near_eye);
    if (pattern >= kFirstFacade) place = wall;
    v_place_haze = vec3(place, mean_haze(eye));
    v_pattern = vec4(pattern >= kFirstFacade ? wall : vec2(0.0), pattern, material == kGround ? 0.0 : 1.0);
}
