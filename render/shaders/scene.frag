// Every fragment of the scene: surface, then the air in front of it. The sky is nothing but air, so whatever the
// haze swallows turns into exactly the sky behind it. Branches only on constants (kHasTextures, kHasAir): a software
// rasteriser pays for both sides of every other.

layout(location = 0) out vec4 out_colour;  // display values, premultiplied

in vec4 v_colour;
in vec3 v_place_haze;
flat in vec4 v_pattern;

layout(binding = 0) uniform sampler2D ground;           // alpha: how much of the detail shows
layout(binding = 1) uniform sampler2DArray patterns;

const vec3 kZenith = vec3(0.23, 0.43, 0.69);
const vec3 kMidSky = vec3(0.52, 0.70, 0.87);
const vec3 kHorizon = vec3(0.86, 0.885, 0.885);
const vec3 kBelow = vec3(0.60, 0.67, 0.73);
const vec3 kSunGlow = vec3(1.00, 0.94, 0.82);
const vec3 kSunDisc = vec3(1.00, 0.99, 0.95);

// Colour of endless air in a direction. @param height  sine of the elevation  @param towards_sun  cosine
vec3 air(float height, float towards_sun) {
    float low = 1.0 - abs(height);
    float low_2 = low * low, low_4 = low_2 * low_2, low_8 = low_4 * low_4;
    vec3 colour = height < 0.0 ? kBelow : mix(kZenith, kMidSky, low_4);
    colour = mix(colour, kHorizon, low_8 * low_8);
    float sun = max(towards_sun, 0.0);
    float sun_2 = sun * sun, sun_4 = sun_2 * sun_2, sun_8 = sun_4 * sun_4;
    float sun_16 = sun_8 * sun_8, sun_64 = sun_16 * sun_16 * sun_16 * sun_16;
    float sun_256 = sun_64 * sun_64 * sun_64 * sun_64;
    return mix(colour, kSunGlow, 0.22 * sun_8 * low_4 + 0.20 * sun_64 + 0.42 * sun_256 * sun_256 * sun_256);
}

// What textures multiply a surface's colour by.
vec3 structure() {
    vec2 place = v_place_haze.xy;
    vec4 base = max(texture(ground, place * ground_grid.xy + ground_grid.zw), vec4(v_pattern.w));
    vec3 detail = texture(patterns, vec3(place - v_pattern.xy, v_pattern.z)).rgb * kPerNeutral - 1.0;
    return base.rgb * (1.0 + base.a * detail);
}

// A premultiplied colour as seen through the air in front of it.
vec4 through_air(vec4 colour) {
    vec2 slope = gl_FragCoord.xy * ray.xy + ray.zw;
    float length_2 = dot(slope, slope) + 1.0;
    float to_unit = inversesqrt(length_2);
    float height = (dot(slope, up_eye.xy) - up_eye.z) * to_unit;
    float towards_sun = (dot(slope, sun_eye.xy) - sun_eye.z) * to_unit;
    float distance = length_2 * to_unit / gl_FragCoord.w;

    float share = 1.0 - exp2(-v_place_haze.z * distance);
    float disc = clamp((towards_sun - sun_eye.w) * 6e4, 0.0, 1.0);
    vec3 behind = mix(air(height, towards_sun), kSunDisc, share < 1.0 ? 0.0 : disc);
    // Half a display step of noise where the air rules, so that its gradient shows no bands.
    float noise = fract(dot(gl_FragCoord.xy, vec2(0.7548777, 0.5698403)));
    return vec4(mix(colour.rgb, behind * colour.a, share) + (noise - 0.5) * (share / 255.0), colour.a);
}

void main() {
    out_colour = v_colour;
    if (kHasTextures) out_colour.rgb *= structure();
    if (kHasAir) out_colour = through_air(out_colour);
}
