// Every fragment of the scene: surface, then the air in front of it. The sky is nothing but air, so whatever the
// haze swallows turns into exactly the sky behind it. No branches: a software rasteriser pays for every one.

layout(location = 0) out vec4 out_colour;  // display values, premultiplied

in vec4 v_colour;
in vec2 v_ground_uv;
flat in float v_ground_share;

layout(binding = 0) uniform sampler2D ground;

const vec3 kZenith = vec3(0.20, 0.40, 0.68);
const vec3 kMidSky = vec3(0.47, 0.67, 0.87);
const vec3 kHorizon = vec3(0.82, 0.87, 0.90);
const vec3 kBelow = vec3(0.58, 0.66, 0.73);
const vec3 kSunGlow = vec3(1.00, 0.86, 0.64);
const float kSharper = -0.6;  // mip bias: the ground is mostly seen at a slant

// Colour of endless air in a direction. @param height  sine of the elevation  @param towards_sun  cosine
vec3 air(float height, float towards_sun) {
    float low = 1.0 - clamp(height, 0.0, 1.0);
    float low_2 = low * low, low_4 = low_2 * low_2, low_16 = low_4 * low_4 * low_4 * low_4;
    vec3 colour = mix(mix(kZenith, kMidSky, low_4), kHorizon, low_16);
    colour = mix(colour, kBelow, clamp(-4.0 * height, 0.0, 1.0));
    float sun = max(towards_sun, 0.0);
    float sun_4 = sun * sun * sun * sun, sun_8 = sun_4 * sun_4, sun_64 = sun_8 * sun_8 * sun_8 * sun_8 * sun_8;
    sun_64 *= sun_8 * sun_8 * sun_8;
    return mix(colour, kSunGlow, 0.30 * sun_8 * low_4 + 0.35 * sun_64);
}

// Share of the air's colour over `distance` metres that rise by `rise` metres; the exact integral through air
// that thins exponentially with height.
float haze_share(float distance, float rise) {
    float thinning = clamp(rise * haze.y, -1.0 - haze.z, 60.0);
    float density_there = exp2(-(haze.z + thinning));
    float mean = (haze.w - density_there) / (thinning * 0.693147);
    mean = abs(thinning) < 1e-3 ? haze.w : mean;
    return 1.0 - exp2(-haze.x * distance * mean);
}

void main() {
    vec3 view_ray = vec3(gl_FragCoord.xy * ray.xy + ray.zw, -1.0);
    float to_unit = inversesqrt(dot(view_ray, view_ray));
    float height = dot(view_ray, up_eye.xyz) * to_unit;
    float towards_sun = dot(view_ray, sun_eye.xyz) * to_unit;
    float distance = projection.z / (max(gl_FragCoord.z, 1e-12) * to_unit);
    float is_sky = gl_FragCoord.z > 0.0 ? 0.0 : 1.0;

    float share = max(haze_share(distance, distance * height), is_sky);
    float disc = is_sky * clamp((towards_sun - sun_eye.w) * 6e4 + 0.5, 0.0, 1.0);
    vec3 behind = mix(air(height, towards_sun), vec3(1.0, 0.98, 0.92), disc);

    vec3 texel = texture(ground, v_ground_uv, kSharper).rgb;
    vec3 colour = v_colour.rgb * mix(vec3(1.0), texel, v_ground_share);
    colour = mix(colour, behind * v_colour.a, share);
    // Half a display step of noise where the air rules, so that its gradient shows no bands.
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    out_colour = vec4(colour + (noise - 0.5) * share / 255.0, v_colour.a);
}
