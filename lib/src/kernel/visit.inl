// A ray's visit to a cell: clips the ray to the cell's box, then to the part where the linear bound allows a zero, and
// searches the rest. All of it belongs to the kernel, because the steps before a search take as long as the search.
// Included by kernel.inl.

namespace phasetree::kernel::HWY_NAMESPACE {
namespace {

constexpr double endless = 1.7976931348623157e308;

struct Interval {
    double low, high;
};

// Like the functions of the same names in sample_positions.inl, but for double.
HWY_INLINE double larger(double x, double y) {
    return x > y ? x : y;
}
HWY_INLINE double smaller(double x, double y) {
    return x < y ? x : y;
}
HWY_INLINE float magnitude(float x) {
    return x < 0 ? -x : x;
}

// Clips a span of a ray to the slab between two planes perpendicular to an axis; the span becomes empty if nothing is
// left. It is computed in double, so that an origin far from the object costs no accuracy.
HWY_INLINE void clip(Interval& span, float low, float high, float origin, float direction, double inverse) {
    const double to_low = static_cast<double>(low) - static_cast<double>(origin);
    const double to_high = static_cast<double>(high) - static_cast<double>(origin);
    if (HWY_UNLIKELY(direction == 0)) {
        if (to_low > 0 || to_high < 0) span.high = -endless;
        return;
    }
    const double a = to_low * inverse, b = to_high * inverse;
    span.low = larger(smaller(a, b), span.low);
    span.high = smaller(larger(a, b), span.high);
}

// A LeavingHint with a smaller rise is ignored: its relative rounding error would be too large.
constexpr float least_rise = 0.02f;

// The part of a ray that must be searched in a cell, reduced step by step. Each step returns whether anything is left
// to search.
class Approach {
  public:
    explicit Approach(const Visit& visit)
        : visit_(visit),
          ray_(*visit.ray),
          routine_(*visit.routine),
          span_{static_cast<double>(visit.t_min), static_cast<double>(visit.t_max)},
          carried_(visit.carried),
          is_leaving_(visit.rise != Visit::no_leaving_hint),
          is_in_first_(visit.routine->outputs[0].phase == visit.carried) {}

    // Clips the ray to the cell's box.
    HWY_INLINE bool enter_box() {
        const auto &origin = ray_.origin, &direction = ray_.direction;
        const Bounds& box = *visit_.box;
        clip(span_, box.low.x, box.high.x, origin.x, direction.x, ray_.inverse.x);
        clip(span_, box.low.y, box.high.y, origin.y, direction.y, ray_.inverse.y);
        clip(span_, box.low.z, box.high.z, origin.z, direction.z, ray_.inverse.z);
        if (!(span_.low <= span_.high) || !(span_.high < endless)) return false;
        start_at(span_.low);
        // A ray that starts here and carries a phase has usually just crossed or left an interface.
        on_interface_ = carried_ >= 0 && span_.low == static_cast<double>(visit_.t_min);
        return true;
    }

    // Moves the start of a ray that leaves an interface to the earliest point where the ray can return to it.
    HWY_INLINE bool leave_interface() {
        if (!(is_leaving_ && on_interface_ && visit_.rise > least_rise && routine_.first_component_decides))
            return true;
        // From an interface on, s ≥ rise·t − K/2·t². K bounds how much s curves downwards, which is as much as it
        // curves upwards in the other phase. The right side is positive up to 2·rise/K; a tenth of that is reserved for
        // the error of the rise.
        const double safe = 1.8 * static_cast<double>(visit_.rise) /
                            larger(static_cast<double>(visit_.curvature[is_in_first_ ? 1 : 0]), 1e-30);
        if (safe >= span_.high - span_.low) return false;
        if (safe > 8 * static_cast<double>(visit_.resolution)) {
            span_.low += safe;
            start_at(span_.low);
            on_interface_ = false;
        }
        return true;
    }

    // Clips the ray to the slab outside of which the linear bound rules out a zero of the field.
    HWY_INLINE bool enter_slab() {
        const LinearBound& bound = *visit_.bound;
        if (!(bound.slack < 3.402823466e38f && (routine_.output_count == 2 || is_in_first_))) return true;
        // At a distance t from the start, the field differs from value + slope_of_plane·t by at most the slack. Where
        // that excludes zero, there is no interface.
        const auto& direction = ray_.direction;
        const float value = bound.normal.x * x_ + bound.normal.y * y_ + bound.normal.z * z_ + bound.offset;
        const float slope_of_plane =
            bound.normal.x * direction.x + bound.normal.y * direction.y + bound.normal.z * direction.z;
        const float steep = magnitude(slope_of_plane), length = static_cast<float>(span_.high - span_.low);
        slope_ = smaller(1.f, steep + bound.spread);
        is_monotone_ = steep > bound.spread;
        // A ray that starts on the interface, and along which the component of its phase only decreases, goes deeper
        // into that phase and stays there.
        if (is_leaving_ && on_interface_ && is_monotone_ &&
            routine_.outputs[is_in_first_ ? 0 : 1].sign * slope_of_plane < 0)
            return false;
        // The ray enters the slab at the distance `enter` from the start, and leaves it at `leave`; negative distances
        // lie before the start. The linear function vanishes midway, after a change of `towards_zero`.
        const float inverse_steepness = 1 / larger(steep, 1e-20f), towards_zero = slope_of_plane < 0 ? value : -value;
        const float enter = (towards_zero - bound.slack) * inverse_steepness;
        const float leave = (towards_zero + bound.slack) * inverse_steepness;
        if (enter > 0 || leave < 0) {
            // The ray starts outside the slab, where the label is known. If that is not the carried phase, nothing is
            // clipped, because the search must look for the carried phase near the start.
            const bool is_below = value < 0;
            const float here = routine_.outputs[(routine_.outputs[0].sign > 0) == is_below ? 0 : 1].phase;
            if (carried_ < 0 || here == carried_) {
                if (leave < 0 || enter > length) return false;
                span_.low += static_cast<double>(enter);
                start_at(span_.low);
                carried_ = here;
                on_interface_ = false;
                span_.high = smaller(span_.high, span_.low + static_cast<double>(leave - enter));
            }
        } else {
            span_.high = smaller(span_.high, span_.low + static_cast<double>(leave));
        }
        return true;
    }

    // The segment that is left.
    HWY_INLINE RaySegment segment() const {
        return {.origin = {x_, y_, z_},
                .direction = {ray_.direction.x, ray_.direction.y, ray_.direction.z},
                .length = static_cast<float>(span_.high - span_.low),
                .t_begin = visit_.t_begin,
                .before = static_cast<float>(span_.low) - visit_.t_min,
                .resolution = visit_.resolution,
                .slope = slope_,
                .curvature = {visit_.curvature[0], visit_.curvature[1]},
                .carried = carried_,
                .is_monotone = is_monotone_,
                .on_interface = on_interface_ && visit_.t_begin == 0};
    }
    // The distance along the ray at which that segment starts.
    HWY_INLINE double start() const { return span_.low; }

  private:
    HWY_INLINE void start_at(double t) {
        x_ = static_cast<float>(static_cast<double>(ray_.origin.x) + t * static_cast<double>(ray_.direction.x));
        y_ = static_cast<float>(static_cast<double>(ray_.origin.y) + t * static_cast<double>(ray_.direction.y));
        z_ = static_cast<float>(static_cast<double>(ray_.origin.z) + t * static_cast<double>(ray_.direction.z));
    }

    const Visit& visit_;
    const TracedRay& ray_;
    const Routine& routine_;
    Interval span_;
    float carried_;     // the ray's phase; negative if unknown
    bool is_leaving_;   // whether there is a LeavingHint
    bool is_in_first_;  // whether the ray is in the phase of the first output
    bool on_interface_ = false;
    bool is_monotone_ = false;
    float slope_ = 1;
    float x_ = 0, y_ = 0, z_ = 0;  // the start
};

bool visit(const Visit& v, RayCrossing& result) {
    result.batches = result.phantoms = 0;
    result.is_unfinished = false;
    if (!v.ray->is_traceable) return false;
    Approach approach(v);
    if (!approach.enter_box() || !approach.leave_interface() || !approach.enter_slab()) return false;
    const RaySegment segment = approach.segment();
    alignas(64) float registers[few_slots * batch_size];
    const bool is_hit = March(*v.routine, segment, v.registers ? v.registers : registers).search(result);
    if (!is_hit && !result.is_unfinished) return false;
    result.start = approach.start();
    result.origin[0] = segment.origin[0];
    result.origin[1] = segment.origin[1];
    result.origin[2] = segment.origin[2];
    return is_hit;
}

}  // namespace
}  // namespace phasetree::kernel::HWY_NAMESPACE
