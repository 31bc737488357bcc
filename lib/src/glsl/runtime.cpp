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

const char* const phase_tracer = R"(
// The phase at a point, and how far from there at least the label cannot change (0 or more).
int phasetree_sample_of(float phi[PHASETREE_COMPONENTS], out float interface_distance) {
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
int phasetree_sample(vec3 p, out float interface_distance) {
    float phi[PHASETREE_COMPONENTS];
    phasetree_distances(p, phi);
    return phasetree_sample_of(phi, interface_distance);
}

int phasetree_label(vec3 p) {
    float s;
    return phasetree_sample(p, s);
}

// The direction out of a phase at p: that in which its component grows.
vec3 phasetree_normal(vec3 p, int phase) {
    vec4 phi[PHASETREE_COMPONENTS];
    phasetree_gradients(p, phi);
    for (int i = 0; i < PHASETREE_COMPONENTS; ++i)
        if (phasetree_phase(i) == phase) {
            float size = length(phi[i].xyz);
            return size > 0.0 ? phi[i].xyz / size : vec3(0.0, 0.0, 1.0);
        }
    return vec3(0.0, 0.0, 1.0);
}

struct PhasetreeCrossing {
    bool found;
    float t_in, t_out;  // the ends of the bracket: still in `from`, and already in `to`
    int from, to;       // phases
    vec3 normal;        // out of `from`
};

// The first change of phase along origin + t * direction (of length 1) between t_min and t_max, for a ray that is in the
// phase `carried` at t_min. A reflected ray goes on from t_in in the phase `from`, a refracted one from t_out in `to`.
PhasetreeCrossing phasetree_trace(vec3 origin, vec3 direction, float t_min, float t_max, int carried) {
    PhasetreeCrossing crossing = PhasetreeCrossing(false, t_max, t_max, carried, carried, -direction);
    // Outside of the bounds all is vacuum.
    vec3 low = (PHASETREE_LOW - origin) / direction, high = (PHASETREE_HIGH - origin) / direction;
    vec3 enter = min(low, high), leave = max(low, high);
    float t = t_min, end = min(t_max, min(leave.x, min(leave.y, leave.z)) + PHASETREE_RESOLUTION);
    if (carried == 0) t = max(t, max(enter.x, max(enter.y, enter.z)) - PHASETREE_RESOLUTION);
    float before = t, s;
    for (int i = 0; i < PHASETREE_STEPS && t <= end; ++i) {
        int label = phasetree_sample(origin + t * direction, s);
        if (label == carried) {
            before = t;
            t += max(s, PHASETREE_RESOLUTION);
            continue;
        }
        // The label has changed since `before`: halve until the bracket is as short as the resolution.
        for (int k = 0; k < 32 && t - before > PHASETREE_RESOLUTION; ++k) {
            float middle = 0.5 * (before + t);
            int there = phasetree_sample(origin + middle * direction, s);
            if (there == carried) {
                before = middle;
            } else {
                t = middle;
                label = there;
            }
        }
        vec3 normal = phasetree_normal(origin + before * direction, carried);
        return PhasetreeCrossing(true, before, t, carried, label, normal);
    }
    return crossing;
}
)";

}  // namespace phasetree::glsl
