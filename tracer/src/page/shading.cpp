// The part of a page's shader that uses the functions of the object. It traces one path per pixel, without branching.
// At a clear interface the path is refracted, or reflected if reflection is total; where it enters from the vacuum, the
// Fresnel share of the surroundings is added. At an opaque interface, light from the sky is added, and light from a
// lamp unless something opaque is in the way.
#include "page/text.hpp"

namespace phasetree::tracer::page {

const char* const shading = R"(
uniform vec3 eye, right, up, forward, lamp;
uniform vec2 image_size, jitter;
uniform vec4 cut;          // everything beyond dot(xyz, p) = w is cut away; xyz is 0 for no cut
uniform float floor_height, object_size;
uniform vec3 object_centre;
uniform vec4 looks[2 * PAGE_PHASES];
out vec4 result;

const float FAR = 1e9;

vec3 surroundings(vec3 d) {
    vec3 c = d.z > 0.0 ? mix(vec3(0.80, 0.83, 0.86), vec3(0.52, 0.60, 0.72), sqrt(d.z))
                       : mix(vec3(0.80, 0.83, 0.86), vec3(0.42, 0.40, 0.38), sqrt(-d.z));
    float towards = dot(d, lamp);
    return c + 2.5 * smoothstep(0.93, 0.97, towards);
}
vec3 ground(vec3 p, vec3 d) {
    float away = length(p.xy - object_centre.xy) / object_size;
    return mix(vec3(0.62, 0.61, 0.59), surroundings(normalize(vec3(d.xy, 0.0))), smoothstep(1.0, 6.0, away));
}
float fresnel(float cos_i, float eta, out float cos_t) {
    float sin2 = eta * eta * (1.0 - cos_i * cos_i);
    cos_t = sqrt(max(1.0 - sin2, 0.0));
    if (sin2 >= 1.0) return 1.0;
    float s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t), p = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    return 0.5 * (s * s + p * p);
}

vec3 radiance(vec3 o, vec3 d) {
    vec3 sum = vec3(0.0), weight = vec3(1.0), pending = vec3(0.0);  // pending: the lamp's contribution if it is visible
    bool to_lamp = false;
    int carried = -1;
    float small = 1e-4 * object_size;
    for (int k = 0; k < 20; ++k) {
        float t0 = 0.0, t1 = FAR;
        bool enters = false, is_cut = dot(cut.xyz, cut.xyz) > 0.0, is_out = false;
        if (is_cut) {
            float a = cut.w - dot(cut.xyz, o), b = dot(cut.xyz, d);
            if (a >= 0.0) t1 = b > 0.0 ? a / b : FAR;
            else if (b < 0.0) t0 = a / b, enters = true;
            else is_out = true;
        }
        float t_cut = t1;
        float t_floor = carried <= 0 && d.z < 0.0 && o.z > floor_height ? (floor_height - o.z) / d.z : FAR;
        PhasetreeCrossing c = PhasetreeCrossing(false, FAR, FAR, max(carried, 0), 0, -d);
        if (!is_out) c = phasetree_trace(o, d, t0, min(t1, t_floor), enters ? -1 : carried);
        if (enters && c.from != 0) c = PhasetreeCrossing(true, t0, t0 + small, 0, c.from, -cut.xyz);
        else if (!c.found && !enters && c.from > 0 && t_cut < FAR)
            c = PhasetreeCrossing(true, t_cut, t_cut + small, c.from, 0, cut.xyz);
        if (!c.found) {
            if (to_lamp) return sum + pending;
            if (t_floor >= FAR) return sum + weight * surroundings(d);
            vec3 p = o + t_floor * d;
            vec3 color = ground(p, d);
            float shade = 0.4 * (1.0 - smoothstep(2.0, 5.0, length(p.xy - object_centre.xy) / object_size));
            sum += weight * color * (1.0 - shade);
            pending = weight * color * shade;
            o = vec3(p.xy, floor_height + small);
            d = lamp;
            to_lamp = true;
            carried = -1;
            continue;
        }
        vec4 there = looks[2 * c.to], there2 = looks[2 * c.to + 1], here = looks[2 * c.from], here2 = looks[2 * c.from + 1];
        vec3 p = o + c.t_from * d, n = c.normal;  // along the ray
        if (dot(n, d) < 0.0) n = -n;
        if (to_lamp) {
            if (there.w > 0.5) return sum;
            pending *= 0.9;
            o = o + c.t_to * d;
            carried = c.to;
            continue;
        }
        if (c.from > 0) weight *= exp(-here.xyz * c.t_from);
        float cos_i = clamp(dot(n, d), 0.0, 1.0);
        if (there.w > 3.5) return sum + weight * there.xyz;  // glowing
        if (there.w > 0.5) {  // opaque
            vec3 reflected = reflect(d, n), color = there.xyz;
            float grazing = pow(1.0 - cos_i, 5.0);
            if (there.w > 1.5 && there.w < 2.5)
                return sum + weight * (color + (1.0 - color) * grazing) * surroundings(reflected);
            float gloss = there.w > 2.5 ? 0.04 + 0.96 * grazing : 0.0;
            sum += weight * (gloss * surroundings(reflected) + (1.0 - gloss) * color * (0.55 - 0.25 * n.z));
            pending = weight * (1.0 - gloss) * color * 0.65 * max(dot(-n, lamp), 0.0);
            if (pending == vec3(0.0)) return sum;
            o = p - small * n;
            d = lamp;
            to_lamp = true;
            carried = c.from;
            continue;
        }
        float eta = here2.w / there2.w, cos_t;
        float f = fresnel(cos_i, eta, cos_t);
        if (f >= 1.0) {
            d = reflect(d, n);
            o = p;
            carried = c.from;
            continue;
        }
        if (c.from == 0) sum += weight * f * surroundings(reflect(d, n));
        weight *= 1.0 - f;
        o = o + c.t_to * d;
        d = normalize(eta * d + (cos_t - eta * cos_i) * n);
        carried = c.to;
        if (max(weight.x, max(weight.y, weight.z)) < 0.01) return sum;
    }
    return sum + weight * surroundings(d);
}

void main() {
    vec2 at = (2.0 * (gl_FragCoord.xy + jitter) - image_size) / image_size.y;
    vec3 c = radiance(eye, normalize(forward + at.x * right + at.y * up));
    c = max(c, vec3(0.0));
    c = c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14);  // a filmic curve, after Narkowicz 2015
    result = vec4(pow(clamp(c, 0.0, 1.0), vec3(1.0 / 2.2)), 1.0);
}
)";

}  // namespace phasetree::tracer::page
