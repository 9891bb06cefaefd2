#include "render/window_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>

namespace render {

namespace {

using Input = Renderer::Input;

struct Axis {
    double Input::*value;
    int plus_key, minus_key;
};
constexpr std::array kAxes{
    Axis{&Input::forward, GLFW_KEY_W, GLFW_KEY_S},          Axis{&Input::right, GLFW_KEY_D, GLFW_KEY_A},
    Axis{&Input::up, GLFW_KEY_PAGE_UP, GLFW_KEY_PAGE_DOWN}, Axis{&Input::yaw, GLFW_KEY_RIGHT, GLFW_KEY_LEFT},
    Axis{&Input::pitch, GLFW_KEY_UP, GLFW_KEY_DOWN},        Axis{&Input::roll, GLFW_KEY_E, GLFW_KEY_Q},
};

struct Switch {
    bool Input::*value;
    int key;
};
constexpr std::array kSwitches{
    Switch{&Input::close, GLFW_KEY_ESCAPE},          Switch{&Input::pause, GLFW_KEY_SPACE},
    Switch{&Input::faster, GLFW_KEY_EQUAL},  // the + key where it needs no shift to be found
    Switch{&Input::faster, GLFW_KEY_KP_ADD},         Switch{&Input::slower, GLFW_KEY_MINUS},
    Switch{&Input::slower, GLFW_KEY_KP_SUBTRACT},    Switch{&Input::schedule_faster, GLFW_KEY_PERIOD},
    Switch{&Input::schedule_slower, GLFW_KEY_COMMA}, Switch{&Input::schedule_reverse, GLFW_KEY_R},
    Switch{&Input::schedule_begin, GLFW_KEY_HOME},   Switch{&Input::schedule_end, GLFW_KEY_END},
};

/// What a held key says once.
constexpr std::array kOnce{&Input::pause,           &Input::schedule_faster,
                           &Input::schedule_slower, &Input::schedule_reverse,
                           &Input::schedule_begin,  &Input::schedule_end};

constexpr double kFullDeflection_px = 40.0;  ///< a drag this long in one poll is as much as a held key

}  // namespace

Input input_of_keys(const std::function<bool(int)>& is_down) {
    Input input;
    for (const Axis& axis : kAxes) {
        input.*axis.value = (is_down(axis.plus_key) ? 1.0 : 0.0) - (is_down(axis.minus_key) ? 1.0 : 0.0);
    }
    for (const Switch& entry : kSwitches) {
        input.*entry.value = input.*entry.value || is_down(entry.key);
    }
    return input;
}

void take_edges(Input& input, Input& before) {
    const Input held = input;
    for (bool Input::*once : kOnce)
        input.*once = input.*once && !(before.*once);
    before = held;
}

void add_drag(double x_px, double y_px, Input& input) {
    input.yaw = std::clamp(input.yaw + x_px / kFullDeflection_px, -1.0, 1.0);
    input.pitch = std::clamp(input.pitch - y_px / kFullDeflection_px, -1.0, 1.0);
}

}  // namespace render
