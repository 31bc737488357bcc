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
    if (!ray.carried) carried_ = evaluation::sample_for(tracer_.evaluator().program(), start_, carried_).phase;
}

// The length within which the phase certainly does not change.
double PreciseMarch::step_from(const Sample& s) const {
    if (!s.has_carried_label()) return 0;
    return s.interface_distance * (1 - tracer_.evaluator().lipschitz_excess()) - value_error_;
}

std::optional<PreciseCrossing> PreciseMarch::next() {
    begin();
    while (const Request* r = request())
        take(evaluation::sample_for(tracer_.evaluator().program(), r->point, r->carried));
    return found_;
}

void PreciseMarch::begin() {
    found_.reset();
    if (t_ <= end_)
        ask(Stage::start, t_);
    else
        stage_ = Stage::ended;
}

void PreciseMarch::ask(Stage stage, double t) {
    stage_ = stage;
    requested_t_ = t;
    request_ = {point(t), carried_};
}

void PreciseMarch::take(const CarriedSample& values) {
    const Sample s{values, requested_t_, carried_};
    switch (stage_) {
        case Stage::start:
            start_from(s);
            break;
        case Stage::stretch:
            if (!is_in(s)) return take_step();  // a contradiction by rounding: samples decide
            at_ = s;
            if (s.has_carried_label()) labelled_ = s;
            go_on();
            break;
        case Stage::long_step:
            if (s.has_carried_label() && step_ + step_from(s) >= s.t - at_.t)
                arrive(s);
            else
                ask(Stage::step, std::min(at_.t + step_, end_));
            break;
        case Stage::step:
            arrive(s);
            break;
        case Stage::bisection:
            was_low_ = s.phase != sought_;
            (was_low_ ? low_ : high_) = s;
            ++bisections_;
            bisect();
            break;
        case Stage::ended:
            break;
    }
}

void PreciseMarch::start_from(const Sample& s) {
    if (!is_in(s)) return report_crossing(s, s);
    labelled_.reset();
    if (s.has_carried_label()) labelled_ = s;
    slope_ = -1;
    samples_ = slow_steps_ = 0;
    wait_ = first_wait;
    shortest_ = resolution_;
    at_ = s;
    go_on();
}

// Continues from the last sample, unless the ray ends there.
void PreciseMarch::go_on() {
    if (!(at_.t < end_)) return end_search();
    if (++samples_ < wait_ || !enclose_stretches()) take_step();
}

void PreciseMarch::end_search() {
    stage_ = Stage::ended;
    t_ = std::numeric_limits<double>::infinity();
}

// Takes a step of a length that is known to be safe. First tries a longer one, guessed from how the interface distance
// changed in the last step: it is safe, too, if the safe lengths at its two ends together cover it.
void PreciseMarch::take_step() {
    step_ = step_from(at_);
    count_slow_steps(step_);
    if (!(step_ >= shortest_)) return ask(Stage::step, std::min(at_.t + shortest_, end_));
    const double covered = 1.9 * step_ / (1 - slope_);
    if (covered > 1.1 * step_)
        ask(Stage::long_step, std::min(at_.t + covered, end_));
    else
        ask(Stage::step, std::min(at_.t + step_, end_));
}

// The next sample after a step.
void PreciseMarch::arrive(const Sample& s) {
    if (!is_in(s)) {
        const bool is_near = labelled_ && s.t - labelled_->t <= near_in_steps * shortest_;
        return bracket(is_near ? *labelled_ : at_, s);
    }
    if (s.has_carried_label()) labelled_ = s;
    if (!(s.t > at_.t)) return end_search();  // the end of the ray is within rounding
    // How fast the interface distance changes; limited, so that steps do not grow without bounds.
    slope_ = std::clamp((s.interface_distance - at_.interface_distance) / (s.t - at_.t), -1.0, 0.9);
    at_ = s;
    go_on();
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

// Requests the sample at the end of stretches on which it is proven that no other phase is deeper than rounding errors.
// Their length doubles after each proof, and is reduced after each failure. Returns whether any stretch was proven.
bool PreciseMarch::enclose_stretches() {
    samples_ = 0;
    const double error = tracer_.enclosure_error();
    if (!(error < std::numeric_limits<double>::infinity())) return false;
    if (!component_ || component_of_ != carried_) {
        component_.emplace(routine_, start_, direction_, static_cast<float>(carried_.index));
        component_of_ = carried_;
    }
    const double unit = std::max(resolution_, step_from(at_));
    double end = at_.t;
    for (double length = first_stretch * unit; end < end_ && length >= shortest_stretch * unit;) {
        const double next = std::min(end + length, end_);
        const bool is_in_phase = component_->upper_bound(end, next, 0.1 * value_error_) < value_error_ - error;
        if (is_in_phase) end = next;
        length *= is_in_phase ? 2 : 0.25;
    }
    if (!(end > at_.t)) {
        wait_ = std::min(2 * wait_, longest_wait);
        return false;
    }
    wait_ = first_wait;
    ask(Stage::stretch, end);
    return true;
}

// Finds the crossing between two samples. `low` is in the ray's phase, `high` is certainly not. Where other phases are
// less deep than rounding errors, as along edges and within shared faces, labels near the crossing mean little. So the
// bracket is placed where the label of `high` begins, not where the ray's label ends. If a sample just before that is
// certainly in a third phase, the start of that phase is bracketed instead.
void PreciseMarch::bracket(const Sample& low, const Sample& high) {
    low_ = lowest_ = low;
    high_ = high;
    sought_ = high.phase;
    bisections_ = 0;
    was_low_ = false;
    bisect();
}

// Continues until `low_` and `high_` are adjacent, and only the second has the label that is sought.
void PreciseMarch::bisect() {
    if (high_.t - low_.t > finest_) {
        const double middle = 0.5 * (low_.t + high_.t);
        double t = middle;
        if (bisections_ % 4 != 3 && high_.component > low_.component) {
            // Interpolation. The sample is moved a little towards the end that was not replaced last, so that both ends
            // approach the crossing.
            const double share = -low_.component / (high_.component - low_.component);
            const double zero = low_.t + std::clamp(share, 0.0, 1.0) * (high_.t - low_.t);
            const double beyond = std::max(finest_, 1e-3 * std::min(high_.t - zero, zero - low_.t));
            t = std::clamp(was_low_ ? zero + beyond : zero - beyond, low_.t, high_.t);
            if (!(t > low_.t && t < high_.t)) t = middle;
        }
        if (t > low_.t && t < high_.t) return ask(Stage::bisection, t);
    }
    if (is_in(low_))
        report_crossing(low_, high_);
    else
        bracket(Sample(lowest_), Sample(low_));
}

// Records the crossing with this bracket. The next search begins at its far end, in the phase there.
void PreciseMarch::report_crossing(const Sample& in, const Sample& out) {
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
    found_ = c;
    stage_ = Stage::ended;
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
