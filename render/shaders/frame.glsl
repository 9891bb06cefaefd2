// render::FrameBlock
layout(std140, binding = 0) uniform Frame {
    vec4 projection;
    vec4 ray;
    vec4 sun_eye;
    vec4 up_eye;
    vec4 haze;
    vec4 ground_tiles;
    vec4 ground_phase;
    vec4 ground_grid;
};
