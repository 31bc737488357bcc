/// A ray's visit to a cell: where it is inside, what the field's linear bound leaves of that, and the search there.
/// Included by kernel.inl: what comes before a search takes as long as the search.

namespace phasetree::HWY_NAMESPACE {
namespace {

constexpr double endless = 1.7976931348623157e308;

struct Interval {
    double low, high;
};

HWY_INLINE double at_least(double x, double y) {
    return x > y ? x : y;
}
HWY_INLINE double at_most(double x, double y) {
    return x < y ? x : y;
}
HWY_INLINE float magnitude(float x) {
    return x < 0 ? -x : x;
}

/// Where a ray is between two planes across an axis. In double, so that an origin far from the object costs no
/// accuracy.
HWY_INLINE void clip(Interval& span, float low, float high, float origin, float direction, double inverse) {
    const double from = static_cast<double>(low) - static_cast<double>(origin);
    const double to = static_cast<double>(high) - static_cast<double>(origin);
    if (HWY_UNLIKELY(direction == 0)) {
        if (from > 0 || to < 0) span.high = -endless;
        return;
    }
    const double a = from * inverse, b = to * inverse;
    span.low = at_least(at_most(a, b), span.low);
    span.high = at_most(at_least(a, b), span.high);
}

/// Of a ray that leaves an interface; below, rounding has more to say.
constexpr float least_rise = 0.02f;

bool visit(const Visit& v, RayCrossing& result) {
    result.batches = result.phantoms = 0;
    result.is_unfinished = false;
    const TracedRay& ray = *v.ray;
    if (!ray.is_traceable) return false;
    const auto &origin = ray.origin, &direction = ray.direction;
    Interval span{static_cast<double>(v.t_min), static_cast<double>(v.t_max)};
    clip(span, v.box->low.x, v.box->high.x, origin.x, direction.x, ray.inverse.x);
    clip(span, v.box->low.y, v.box->high.y, origin.y, direction.y, ray.inverse.y);
    clip(span, v.box->low.z, v.box->high.z, origin.z, direction.z, ray.inverse.z);
    if (!(span.low <= span.high) || !(span.high < endless)) return false;

    const Routine& routine = *v.routine;
    float x, y, z;
    const auto start_at = [&](double t) {
        x = static_cast<float>(static_cast<double>(origin.x) + t * static_cast<double>(direction.x));
        y = static_cast<float>(static_cast<double>(origin.y) + t * static_cast<double>(direction.y));
        z = static_cast<float>(static_cast<double>(origin.z) + t * static_cast<double>(direction.z));
    };
    start_at(span.low);
    float carried = v.carried;
    const bool is_departure = v.rise != Visit::no_leaving_hint, has_two = routine.output_count == 2;
    const bool is_in_first = routine.outputs[0].phase == carried;
    // What starts here and carries a phase has mostly just crossed or left an interface.
    bool on_interface = carried >= 0 && span.low == static_cast<double>(v.t_min);
    if (is_departure && on_interface && v.rise > least_rise && routine.is_by_first) {
        // From an interface s = rise·t − K/2·t² at least, where K is how much s curves downward: as much as upward in
        // the other phase. A tenth is left for what the rise is off. That is positive up to here:
        const double safe =
            1.8 * static_cast<double>(v.rise) / at_least(static_cast<double>(v.curvature[is_in_first ? 1 : 0]), 1e-30);
        if (safe >= span.high - span.low) return false;
        if (safe > 8 * static_cast<double>(v.resolution)) {
            span.low += safe;
            start_at(span.low);
            on_interface = false;
        }
    }
    float slope = 1;
    bool is_monotone = false;
    const LinearBound& bound = *v.bound;
    if (bound.slack < 3.402823466e38f && (has_two || is_in_first)) {
        // The field along the ray is value + rise·t within the slack: where that is not zero, there is no interface.
        const float value = bound.normal.x * x + bound.normal.y * y + bound.normal.z * z + bound.offset;
        const float rise = bound.normal.x * direction.x + bound.normal.y * direction.y + bound.normal.z * direction.z;
        const float steep = magnitude(rise), length = static_cast<float>(span.high - span.low);
        slope = smaller(1.f, steep + bound.spread);
        is_monotone = steep > bound.spread;
        // A ray that has left the interface for the phase that the field grows into stays there.
        if (is_departure && on_interface && is_monotone && routine.outputs[is_in_first ? 0 : 1].sign * rise < 0)
            return false;
        const float per_rise = 1 / larger(steep, 1e-20f), depth = rise < 0 ? value : -value;
        const float enter = (depth - bound.slack) * per_rise, leave = (depth + bound.slack) * per_rise;
        if (enter > 0 || leave < 0) {
            // It starts where the label is known.
            const bool is_below = value < 0;
            const float here = routine.outputs[(routine.outputs[0].sign > 0) == is_below ? 0 : 1].phase;
            if (carried < 0 || here == carried) {
                if (leave < 0 || enter > length) return false;
                span.low += static_cast<double>(enter);
                start_at(span.low);
                carried = here;
                on_interface = false;
                span.high = at_most(span.high, span.low + static_cast<double>(leave - enter));
            }
        } else {
            span.high = at_most(span.high, span.low + static_cast<double>(leave));
        }
    }
    const RaySegment segment{{x, y, z},
                             {direction.x, direction.y, direction.z},
                             static_cast<float>(span.high - span.low),
                             v.from,
                             static_cast<float>(span.low) - v.t_min,
                             v.resolution,
                             slope,
                             {v.curvature[0], v.curvature[1]},
                             carried,
                             is_monotone,
                             on_interface && v.from == 0};
    alignas(64) float registers[few_slots * batch_size];
    const bool is_hit = March(routine, segment, v.registers ? v.registers : registers).search(result);
    if (!is_hit && !result.is_unfinished) return false;
    result.start = span.low;
    result.origin[0] = x;
    result.origin[1] = y;
    result.origin[2] = z;
    return is_hit;
}

}  // namespace
}  // namespace phasetree::HWY_NAMESPACE
