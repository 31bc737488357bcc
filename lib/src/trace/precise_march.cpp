#include "trace/precise_march.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "phasetree/math/portable.hpp"

namespace phasetree::trace {

namespace {

// Stretches are enclosed after this many samples without a crossing. The number doubles, up to the limit, when nothing
// was proven.
constexpr std::size_t first_wait = 48, longest_wait = 2048;
// The lengths of the first stretch to enclose and of the shortest, in steps.
constexpr double first_stretch = 1024, shortest_stretch = 32;
// Steps shorter than this number of resolutions are slow. After `most_slow_steps` of them, one after the other, the
// shortest step doubles with each further `steps_per_doubling`.
constexpr double slow_in_resolutions = 1024;
constexpr std::size_t most_slow_steps = 65'536, steps_per_doubling = 256;
// Let b be the first sample outside the ray's phase. Bisection starts from the last sample labelled with that phase if
// it is at most this many (current) shortest steps before b, and from the sample just before b otherwise.
constexpr double near_in_steps = 256;

// The range of distances along a ray in a box; empty if the second is less than the first.
std::array<double, 2> range_in(const Bounds& box, const glm::dvec3& origin, const glm::dvec3& direction) {
    double near = 0, far = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        const auto low = static_cast<double>(box.low[i]), high = static_cast<double>(box.high[i]);
        if (direction[i] == 0) {
            if (origin[i] < low || origin[i] > high) return {0, -1};
            continue;
        }
        const double a = (low - origin[i]) / direction[i], b = (high - origin[i]) / direction[i];
        near = std::max(near, std::min(a, b));
        far = std::min(far, std::max(a, b));
    }
    return {near, far};
}

}  // namespace

double farthest_coordinate_of(const Bounds& b) {
    double farthest = 0;
    for (int i = 0; i < 3; ++i)
        farthest = std::max({farthest, std::abs(double{b.low[i]}), std::abs(double{b.high[i]})});
    return farthest;
}

PreciseMarch::PreciseMarch(const PreciseTracer& tracer, const PreciseRay& ray)
    : tracer_(tracer),
      routine_(tracer.evaluator().program().routine()),
      resolution_(tracer.resolution()),
      value_error_(tracer.value_error()) {
    carried_ = ray.carried.value_or(vacuum);
    const double length = portable::hypot(ray.direction.x, ray.direction.y, ray.direction.z);
    if (!(length > 1e-150 && length < 1e150) || !std::isfinite(ray.origin.x) || !std::isfinite(ray.origin.y) ||
        !std::isfinite(ray.origin.z))
        return;
    length_ = length;
    direction_ = ray.direction / length;
    const auto [near, far] = range_in(tracer.bounds(), ray.origin, direction_);
    const double end = std::min(far, ray.t_max * length);
    if (!(near <= end) || std::isnan(ray.t_max)) return;
    start_ = ray.origin + near * direction_;
    skipped_ = near;
    end_ = end - near;
    // Two units in the last place of any coordinate and of any distance along the ray.
    finest_ = 0x1p-51 * std::max(farthest_coordinate_of(tracer.bounds()), end_);
    if (!ray.carried) carried_ = at(0).phase;
}

PreciseMarch::Sample PreciseMarch::at(double t) const {
    return {evaluation::sample_for(tracer_.evaluator().program(), point(t), carried_), t, carried_};
}

// The length within which the phase certainly does not change.
double PreciseMarch::step_from(const Sample& s) const {
    if (!s.has_carried_label()) return 0;
    return s.interface_distance * (1 - tracer_.evaluator().lipschitz_excess()) - value_error_;
}

std::optional<PreciseCrossing> PreciseMarch::next() {
    if (!(t_ <= end_)) return std::nullopt;
    Sample a = at(t_);
    if (!is_in(a)) return report_crossing(a, a);
    labelled_.reset();
    if (a.has_carried_label()) labelled_ = a;
    slope_ = -1;
    samples_ = slow_steps_ = 0;
    wait_ = first_wait;
    shortest_ = resolution_;
    while (a.t < end_) {
        if (++samples_ >= wait_ && pass_enclosed(a)) continue;
        const double step = step_from(a);
        count_slow_steps(step);
        const Sample b = step >= shortest_ ? step_surely(a, step) : at(std::min(a.t + shortest_, end_));
        if (!is_in(b)) {
            const bool is_near = labelled_ && b.t - labelled_->t <= near_in_steps * shortest_;
            return crossing_between(is_near ? *labelled_ : a, b);
        }
        if (b.has_carried_label()) labelled_ = b;
        if (!(b.t > a.t)) break;  // the end of the ray is within rounding
        // How fast the interface distance changes; limited, so that steps do not grow without bounds.
        slope_ = std::clamp((b.interface_distance - a.interface_distance) / (b.t - a.t), -1.0, 0.9);
        a = b;
    }
    t_ = std::numeric_limits<double>::infinity();
    return std::nullopt;
}

// Takes a step of a length that is known to be safe. First tries a longer one, guessed from how the interface distance
// changed in the last step: it is safe, too, if the safe lengths at its two ends together cover it.
PreciseMarch::Sample PreciseMarch::step_surely(const Sample& a, double step) const {
    const double covered = 1.9 * step / (1 - slope_);
    if (covered > 1.1 * step) {
        const Sample b = at(std::min(a.t + covered, end_));
        if (b.has_carried_label() && step + step_from(b) >= b.t - a.t) return b;
    }
    return at(std::min(a.t + step, end_));
}

// Lengthens the steps of a ray that makes no headway.
void PreciseMarch::count_slow_steps(double step) {
    if (step >= slow_in_resolutions * resolution_) {
        slow_steps_ = 0;
        shortest_ = resolution_;
    } else if (++slow_steps_ > most_slow_steps && slow_steps_ % steps_per_doubling == 0) {
        shortest_ *= 2;
    }
}

// Moves a sample to the end of stretches on which no other phase is deeper than rounding errors. Their length doubles
// while that is proven, and is reduced where it is not. Returns whether any was proven.
bool PreciseMarch::pass_enclosed(Sample& a) {
    samples_ = 0;
    const double error = tracer_.enclosure_error();
    if (!(error < std::numeric_limits<double>::infinity())) return false;
    if (!component_ || component_of_ != carried_) {
        component_.emplace(routine_, start_, direction_, static_cast<float>(carried_.index));
        component_of_ = carried_;
    }
    const double unit = std::max(resolution_, step_from(a));
    double end = a.t;
    for (double length = first_stretch * unit; end < end_ && length >= shortest_stretch * unit;) {
        const double next = std::min(end + length, end_);
        const bool is_in_phase = component_->upper_bound(end, next, 0.1 * value_error_) < value_error_ - error;
        if (is_in_phase) end = next;
        length *= is_in_phase ? 2 : 0.25;
    }
    if (!(end > a.t)) {
        wait_ = std::min(2 * wait_, longest_wait);
        return false;
    }
    wait_ = first_wait;
    const Sample b = at(end);
    if (!is_in(b)) return false;  // a contradiction by rounding: samples decide
    a = b;
    if (a.has_carried_label()) labelled_ = a;
    return true;
}

// The crossing between two samples. `low` is in the ray's phase, `high` is certainly not. Where other phases are less
// deep than rounding errors, as along edges and within shared faces, labels near the crossing mean little. So the
// bracket is placed where the label of `high` begins, not where the ray's label ends. If a sample just before that is
// certainly in a third phase, the start of that phase is bracketed instead.
PreciseCrossing PreciseMarch::crossing_between(const Sample& low, Sample high) {
    for (;;) {
        const auto [before, after] = begin_of_label(low, high);
        if (is_in(before)) return report_crossing(before, after);
        high = before;
    }
}

// Two adjacent samples between `low` and `high`, of which only the second has the label of `high`.
std::pair<PreciseMarch::Sample, PreciseMarch::Sample> PreciseMarch::begin_of_label(Sample low, Sample high) const {
    const Phase sought = high.phase;
    bool was_low = false;  // whether the last sample replaced `low`
    for (int n = 0; high.t - low.t > finest_; ++n) {
        const double middle = 0.5 * (low.t + high.t);
        double t = middle;
        if (n % 4 != 3 && high.component > low.component) {
            // Interpolation. The sample is moved a little towards the end that was not replaced last, so that both ends
            // approach the crossing.
            const double share = -low.component / (high.component - low.component);
            const double zero = low.t + std::clamp(share, 0.0, 1.0) * (high.t - low.t);
            const double beyond = std::max(finest_, 1e-3 * std::min(high.t - zero, zero - low.t));
            t = std::clamp(was_low ? zero + beyond : zero - beyond, low.t, high.t);
            if (!(t > low.t && t < high.t)) t = middle;
        }
        if (!(t > low.t && t < high.t)) break;
        const Sample s = at(t);
        was_low = s.phase != sought;
        (was_low ? low : high) = s;
    }
    return {low, high};
}

// Makes the crossing with this bracket, and continues the search from its far end, in the phase there.
PreciseCrossing PreciseMarch::report_crossing(const Sample& in, const Sample& out) {
    PreciseCrossing c;
    c.t_from = (skipped_ + in.t) / length_;
    c.t_to = (skipped_ + out.t) / length_;
    c.p_from = point(in.t);
    c.p_to = point(out.t);
    c.from = carried_;
    c.to = out.phase;
    c.normal = normal(in.t, out.t, c.to);
    carried_ = c.to;
    t_ = out.t;
    return c;
}

// The gradients of the components on both sides, at the bracket's ends and a resolution before and after it. The first
// gradient that points along the ray is used. If none does, because the ray runs along the interface or the slope is
// zero, the one with the smallest angle to the ray is used, or the ray's direction.
glm::dvec3 PreciseMarch::normal(double t_from, double t_to, Phase to) const {
    // The cosine of an angle that is certainly below 90°.
    constexpr double certain = 1e-6;
    const PreciseEvaluator& e = tracer_.evaluator();
    glm::dvec3 best = direction_;
    double best_cosine = 0;
    for (const double beyond : {0.0, resolution_})
        for (const bool is_near : {true, false}) {
            const double t = is_near ? t_from - beyond : t_to + beyond;
            const glm::dvec3 g = is_near ? e.gradient(point(t), carried_) : -e.gradient(point(t), to);
            const double steepness = glm::length(g), cosine = glm::dot(g, direction_) / steepness;
            if (!(steepness > 0.01)) continue;
            if (cosine > certain) return g / steepness;
            if (cosine > best_cosine) {
                best_cosine = cosine;
                best = g / steepness;
            }
        }
    return best;
}

}  // namespace phasetree::trace
