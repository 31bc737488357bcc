#include "glsl/runtime.hpp"

namespace phasetree::glsl {

const char* const gradient_arithmetic = R"(
// Numbers with gradients: xyz is the gradient, w the value.
vec4 pt_d_add(vec4 a, vec4 b) { return a + b; }
vec4 pt_d_add(vec4 a, float b) { return vec4(a.xyz, a.w + b); }
vec4 pt_d_add(float a, vec4 b) { return vec4(b.xyz, a + b.w); }
vec4 pt_d_sub(vec4 a, vec4 b) { return a - b; }
vec4 pt_d_sub(vec4 a, float b) { return vec4(a.xyz, a.w - b); }
vec4 pt_d_sub(float a, vec4 b) { return vec4(-b.xyz, a - b.w); }
vec4 pt_d_mul(vec4 a, vec4 b) { return vec4(a.xyz * b.w + a.w * b.xyz, a.w * b.w); }
vec4 pt_d_mul(vec4 a, float b) { return a * b; }
vec4 pt_d_mul(float a, vec4 b) { return a * b; }
vec4 pt_d_div(vec4 a, vec4 b) { float v = a.w / b.w; return vec4((a.xyz - v * b.xyz) / b.w, v); }
vec4 pt_d_min(vec4 a, vec4 b) { return a.w <= b.w ? a : b; }
vec4 pt_d_max(vec4 a, vec4 b) { return a.w > b.w ? a : b; }
vec4 pt_d_abs(vec4 a) { return a.w < 0.0 ? -a : a; }
vec4 pt_d_sqrt(vec4 a) { float v = sqrt(a.w); return vec4(a.xyz * (v > 0.0 ? 0.5 / v : 0.0), v); }
)";

const char* const calls_sampler = R"(
// The phase at a point, and a distance from there within which the label cannot change (0 or more).
int phasetree_sample(vec3 p, out float interface_distance) {
    float phi[PHASETREE_COMPONENTS];
    phasetree_distances(p, phi);
    float least = phi[0], second = 3.4e38;
    int component = 0;
    for (int i = 1; i < PHASETREE_COMPONENTS; ++i) {
        second = min(second, max(least, phi[i]));
        if (phi[i] < least) {
            least = phi[i];
            component = i;
        }
    }
    interface_distance = max(second, 0.0);
    return phasetree_phase(component);
}

int pt_sample_along(vec3 p, vec3 direction, out float interface_distance) {
    return phasetree_sample(p, interface_distance);
}

bool pt_has_gradients(vec3 p) { return true; }

// The direction out of a phase at p: that in which its component grows.
vec3 phasetree_normal(vec3 p, int phase) {
    vec4 phi[PHASETREE_COMPONENTS];
    phasetree_gradients(p, phi);
    vec3 gradient = vec3(0.0);
    for (int i = 0; i < PHASETREE_COMPONENTS; ++i)
        if (phasetree_phase(i) == phase) gradient = phi[i].xyz;
    float size = length(gradient);
    return size > 0.0 ? gradient / size : vec3(0.0, 0.0, 1.0);
}
)";

const char* const table_evaluation = R"(
void phasetree_distances(vec3 p, out float phi[PHASETREE_COMPONENTS]) {
    vec4 head = pt_four(PT_WHOLE);
    int steps = int(head.x), outputs = int(head.y);
    pt_run(PT_WHOLE + 1, steps, p);
    for (int i = 0; i < outputs; ++i) {
        vec4 o = pt_four(PT_WHOLE + 1 + steps + i);
        phi[int(o.w)] = o.z * pt_slots[int(o.y)];
    }
}

void phasetree_gradients(vec3 p, out vec4 phi[PHASETREE_COMPONENTS]) {
    vec4 head = pt_four(PT_WHOLE);
    int steps = int(head.x), outputs = int(head.y);
    pt_d_run(PT_WHOLE + 1, steps, p);
    for (int i = 0; i < outputs; ++i) {
        vec4 o = pt_four(PT_WHOLE + 1 + steps + i);
        phi[int(o.w)] = o.z * pt_d_slots[int(o.y)];
    }
}
)";

const char* const table_sampler = R"(
// The phase according to a program of the table, and a distance within which the label cannot change.
int pt_sample_by(int program, vec3 p, out float interface_distance) {
    vec4 head = pt_four(program);
    int steps = int(head.x), outputs = int(head.y);
    pt_run(program + 1, steps, p);
    float least = 3.4e38, second = 3.4e38, phase = 0.0;
    for (int i = 0; i < outputs; ++i) {
        vec4 o = pt_four(program + 1 + steps + i);
        float value = o.z * pt_slots[int(o.y)];
        second = min(second, max(least, value));
        if (value < least) {
            least = value;
            phase = o.x;
        }
    }
    interface_distance = max(second, 0.0);
    return int(phase);
}

bool pt_has_gradients(vec3 p) { return pt_program(p) >= 0; }

// The direction out of a phase at p: that in which its component grows.
vec3 phasetree_normal(vec3 p, int phase) {
    int program = pt_program(p);
    if (program < 0) return vec3(0.0, 0.0, 1.0);
    vec4 head = pt_four(program);
    int steps = int(head.x), outputs = int(head.y);
    pt_d_run(program + 1, steps, p);
    vec3 gradient = vec3(0.0);
    for (int i = 0; i < outputs; ++i) {
        vec4 o = pt_four(program + 1 + steps + i);
        if (int(o.x) == phase) gradient = o.z * pt_d_slots[int(o.y)].xyz;
    }
    float size = length(gradient);
    return size > 0.0 ? gradient / size : vec3(0.0, 0.0, 1.0);
}
)";

const char* const one_program = R"(
int pt_program(vec3 p) { return PT_WHOLE; }
)";

const char* const one_program_sampler = R"(
int phasetree_sample(vec3 p, out float interface_distance) { return pt_sample_by(PT_WHOLE, p, interface_distance); }

int pt_sample_along(vec3 p, vec3 direction, out float interface_distance) {
    return pt_sample_by(PT_WHOLE, p, interface_distance);
}
)";

const char* const grid_of_programs = R"(
vec3 pt_box_size() { return (PHASETREE_HIGH - PHASETREE_LOW) / vec3(PT_BOXES); }
ivec3 pt_box(vec3 p) {
    return clamp(ivec3(floor((p - PHASETREE_LOW) / pt_box_size())), ivec3(0), PT_BOXES - 1);
}
// The start of the program for the box that contains a point, or -1 - phase if the box contains a single phase.
int pt_program(vec3 p) {
    ivec3 box = pt_box(p);
    return int(pt_number(PT_GRID + (box.z * PT_BOXES.y + box.y) * PT_BOXES.x + box.x));
}
)";

const char* const grid_sampler = R"(
// The phase at a point, and a distance along a direction within which it cannot change. It reaches at most a resolution
// beyond the box around the point, whose program is used.
int pt_sample_along(vec3 p, vec3 direction, out float interface_distance) {
    vec3 low = PHASETREE_LOW + vec3(pt_box(p)) * pt_box_size();
    vec3 to_sides = (low + mix(vec3(0.0), pt_box_size(), greaterThan(direction, vec3(0.0))) - p) / direction;
    to_sides = mix(to_sides, vec3(3.4e38), equal(direction, vec3(0.0)));
    float leaving = max(min(to_sides.x, min(to_sides.y, to_sides.z)), 0.0) + PHASETREE_RESOLUTION;
    int program = pt_program(p);
    interface_distance = leaving;
    if (program < 0) return -1 - program;
    int phase = pt_sample_by(program, p, interface_distance);
    interface_distance = min(interface_distance, leaving);
    return phase;
}

int phasetree_sample(vec3 p, out float interface_distance) { return pt_sample_by(PT_WHOLE, p, interface_distance); }
)";

const char* const phase_tracer = R"(
int phasetree_label(vec3 p) {
    float s;
    return phasetree_sample(p, s);
}

struct PhasetreeCrossing {
    bool found;
    float t_from, t_to;  // the ends of the bracket: still in `from`, and already in `to`
    int from, to;       // phases
    vec3 normal;        // out of `from`
};

// To show some phases as others, or to hide them (as 0), define this macro before this text.
#ifndef PHASETREE_SHOWN
#define PHASETREE_SHOWN(phase) (phase)
#endif

// The first change of phase along origin + t * direction (of length 1) between t_min and t_max, for a ray that is in
// the phase `carried` at t_min. If `carried` is -1, the phase at t_min is determined first; it is `from` in the result.
// Start a reflected ray at t_from in the phase `from`, and a refracted ray at t_to in the phase `to`. The loop
// evaluates the object in a single place, because compilers inline every call.
PhasetreeCrossing phasetree_trace(vec3 origin, vec3 direction, float t_min, float t_max, int carried) {
    PhasetreeCrossing crossing = PhasetreeCrossing(false, t_max, t_max, carried, carried, -direction);
    // Outside the bounds, everything is vacuum.
    vec3 low = (PHASETREE_LOW - origin) / direction, high = (PHASETREE_HIGH - origin) / direction;
    vec3 enter = min(low, high), leave = max(low, high);
    float t = t_min, end = min(t_max, min(leave.x, min(leave.y, leave.z)));
    if (carried <= 0) t = max(t, max(enter.x, max(enter.y, enter.z)));
    if (t > t_min) carried = 0;
    crossing.from = max(carried, 0);
    float before = t, after = -1.0;  // before the first change, and behind it where that is known
    int inside = carried, behind = carried, shown_behind = carried;
    for (int i = 0; i < PHASETREE_STEPS && t <= end; ++i) {
        float s;
        int label = pt_sample_along(origin + t * direction, direction, s);
        int shown = PHASETREE_SHOWN(label);
        if (carried < 0) {
            carried = shown;
            crossing.from = shown;
        }
        if (shown == carried) {
            before = t;
            inside = label;
        } else {
            after = t;
            behind = label;
            shown_behind = shown;
        }
        if (after < 0.0) {
            t = before + max(s, PHASETREE_RESOLUTION);
        } else {
            // Bisect until the bracket is as short as the resolution, or as 32-bit floats allow.
            t = 0.5 * (before + after);
            if (after - before <= PHASETREE_RESOLUTION || t <= before || t >= after) break;
        }
    }
    if (after < 0.0) return crossing;
    // The component of either phase gives the normal. One of them may have no sample, or no program in its box.
    vec3 near = origin + before * direction, far = origin + after * direction;
    bool is_near = inside >= 0 && inside != behind && pt_has_gradients(near);
    vec3 normal = phasetree_normal(is_near ? near : far, is_near ? inside : behind);
    return PhasetreeCrossing(true, before, after, carried, shown_behind, is_near ? normal : -normal);
}
)";

}  // namespace phasetree::glsl
