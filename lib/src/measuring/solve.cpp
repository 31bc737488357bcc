// Bisection with measurements that are as precise as each decision needs.
#include "phasetree/measuring/solve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>

#include "phasetree/nodes/phased/remove.hpp"
#include "phasetree_support/power_of_ten.hpp"

namespace phasetree {

namespace measuring {

namespace {

using Clock = std::chrono::steady_clock;

// The tolerance of the first measurement.
constexpr double first_tolerance = 0.1;
// The finest tolerance. 32-bit coordinates usually end a measurement earlier.
constexpr double finest_tolerance = 1e-9;
// From one measurement of a number to the next, the tolerance is multiplied by a factor between these two.
constexpr double min_factor = 1.0 / 64, max_factor = 1.0 / 2;
// Numbers are rounded to decimals that are at most this share of the bracket apart.
constexpr double share_of_digit = 1.0 / 64;

// Brackets of at most this many final widths are narrow: the measure is nearly linear in them.
constexpr double narrow = 64;

enum class Side { below, above, undecided };

// The nearest number with few digits, for a bracket of this width.
double rounded(double x, double width) {
    if (!(width > 1e-300 && width < 1e300)) return x;
    const int exponent = support::exponent_of_ten(width * share_of_digit);
    // Quotients of integers have the shortest texts; 10²² is the largest power that is exact.
    const double power = std::pow(10.0, std::abs(exponent));
    const double digits = exponent < 0 ? x * power : x / power;
    if (!(std::abs(exponent) <= 22) || !(std::abs(digits) < 0x1p52)) return x;
    return exponent < 0 ? std::round(digits) / power : std::round(digits) * power;
}

// How often something is halved until it is smaller by this factor.
double halvings(double factor) {
    return std::log(factor) / std::numbers::ln2;
}

// A number between the ends of the bracket, and the tolerance of its next measurement.
struct Candidate {
    double at = 0;
    double tolerance = 0;
    std::optional<SolvePoint> known{};
    bool is_exhausted = false;  // no better measurement is possible
};

class Solver {
  public:
    Solver(const ObjectOf& object, const SolveTarget& target, const SolveOptions& options)
        : object_(object), target_(target), options_(options), start_(Clock::now()) {
        for (const auto& [phase, weight] : target.weights)
            if (weight > 0) wanted_ = wanted_ | PhaseSet::of(phase);
    }

    SolveResult run(double low, double high) {
        result_.end = solve(low, high);
        return result_;
    }

  private:
    SolveEnd solve(double low, double high) {
        const double first_width = high - low;
        width_ = options_.width > 0 ? options_.width : 1e-3 * first_width;
        const std::optional<SolveEnd> ended = measure_ends(low, high);
        if (ended) return *ended;
        steps_ = std::max(1.0, halvings(first_width / width_)) + 1;
        SolveEnd end = SolveEnd::width;
        double tolerance = tolerance_of_ends_;
        while (result_.high->at - result_.low->at > width_) {
            const std::optional<SolveEnd> stopped = halve(tolerance);
            if (stopped) {
                end = *stopped;
                break;
            }
            done_ = halvings(first_width / (result_.high->at - result_.low->at));
            tell();
        }
        find_best(tolerance);
        return end;
    }

    bool is_cancelled() const { return options_.cancelled && options_.cancelled(); }
    double seconds_left() const {
        return options_.seconds - std::chrono::duration<double>(Clock::now() - start_).count();
    }
    std::optional<SolveEnd> stopped() const {
        if (is_cancelled()) return SolveEnd::cancelled;
        if (!(seconds_left() > 0)) return SolveEnd::seconds;
        return std::nullopt;
    }
    void tell() const {
        if (options_.progress) options_.progress({result_.low, result_.high, std::clamp(done_ / steps_, 0.0, 1.0)});
    }

    enum class Until { decided, tolerance };

    // The quantity, with the rounding errors of at most 64 products and sums.
    Measured quantity(const MeasureResult& measured) const {
        Measured sum{0, 0, 0};
        double magnitude = 0;
        for (const MeasuredPhase& p : measured.phases)
            for (const auto& [phase, weight] : target_.weights)
                if (phase == p.phase) {
                    sum.low += weight * p.body.volume.low;
                    sum.high += weight * p.body.volume.high;
                    sum.estimate += weight * p.body.volume.estimate;
                    magnitude += weight * p.body.volume.high;
                }
        sum.low -= 1e-14 * magnitude;
        sum.high += 1e-14 * magnitude;
        return sum;
    }
    // Measures a number, for the first time or more precisely: to its tolerance, or until it is decided on which side
    // of the target it is.
    void measure_once(Candidate& c, Until until = Until::decided) {
        ++result_.measurements;
        Phased object = object_(c.at);
        const PhaseSet others{phases(object).bits & ~wanted_.bits & ~PhaseSet::of(vacuum).bits};
        if (!others.empty()) object = Remove{.of = object, .gone = others};
        c.known = SolvePoint{c.at, Measured{0, 0, 0}};
        if (bounds(object).empty()) {
            c.is_exhausted = true;
            return;
        }
        MeasureOptions options;
        options.tolerance = c.tolerance;
        options.seconds = std::max(seconds_left(), 1e-3);
        options.max_boxes = options_.max_boxes;
        options.cancelled = options_.cancelled;
        options.progress = [&](float) { tell(); };
        if (until == Until::decided)
            options.is_enough = [&](const MeasureResult& known) { return side_of(quantity(known)) != Side::undecided; };
        const MeasureResult measured = phasetree::measure(object, options);
        c.known->measure = quantity(measured);
        c.is_exhausted = (measured.end != MeasureEnd::tolerance && measured.end != MeasureEnd::enough) ||
                         c.tolerance <= finest_tolerance;
    }
    Side side_of(const Measured& m) const {
        return m.high < target_.value ? Side::below : m.low > target_.value ? Side::above : Side::undecided;
    }
    // Lowers the tolerance so that the interval would no longer contain the target if the estimate were exact.
    void refine(Candidate& c) const {
        const Measured& m = c.known->measure;
        const double gap = target_.value - m.estimate, reach = gap > 0 ? m.high - m.estimate : m.estimate - m.low;
        const double needed = reach > 0 ? 0.8 * std::abs(gap) / reach : 0;
        // The interval may be much narrower than the tolerance required.
        if (m.estimate > 0) c.tolerance = std::min(c.tolerance, (m.high - m.low) / m.estimate);
        c.tolerance = std::max(c.tolerance * std::clamp(needed, min_factor, max_factor), finest_tolerance);
    }

    // The first measurements, of both ends of the bracket.
    std::optional<SolveEnd> measure_ends(double low, double high) {
        std::array<Side, 2> sides{};
        for (const bool is_high : {false, true}) {
            std::optional<SolvePoint>& end = is_high ? result_.high : result_.low;
            Candidate c{is_high ? high : low, first_tolerance};
            Side& side = sides[is_high ? 1 : 0];
            for (side = Side::undecided; side == Side::undecided;) {
                if (const auto why = stopped()) return why;
                measure_once(c);
                end = c.known;
                tell();
                side = side_of(end->measure);
                if (side != Side::undecided) break;
                if (const auto why = stopped()) return why;
                if (c.is_exhausted) {
                    result_.undecided = end;
                    return SolveEnd::undecided;
                }
                refine(c);
            }
            tolerance_of_ends_ = std::min(tolerance_of_ends_, c.tolerance);
        }
        if (sides[0] == sides[1]) return SolveEnd::same_side;
        rises_ = sides[0] == Side::below;
        return std::nullopt;
    }

    // The number at which the target is reached according to linear interpolation of the estimates; if these do not
    // determine one, the middle.
    double interpolated() const {
        const SolvePoint &low = *result_.low, &high = *result_.high;
        const double share = (target_.value - low.measure.estimate) / (high.measure.estimate - low.measure.estimate);
        return low.at + (share > 0 && share < 1 ? share : 0.5) * (high.at - low.at);
    }
    // The numbers to be tried: the middle, and others in case the measure there is close to the target. In a narrow
    // bracket, first a number near the estimated solution: close enough that, once decided, this end of the bracket is
    // final, but otherwise as far from the solution as possible, because that takes the least precision.
    std::vector<Candidate> candidates(double tolerance) const {
        struct Place {
            double share, penalty;
        };
        constexpr std::array<Place, 5> places{
            {{0.5, 1}, {0.375, 0.25}, {0.625, 0.25}, {0.25, 1.0 / 16}, {0.75, 1.0 / 16}}};
        const double low = result_.low->at, high = result_.high->at;
        std::vector<Candidate> found;
        if (high - low <= narrow * width_) {
            const double solution = interpolated(), side = solution - low > high - solution ? -0.45 : 0.45;
            const double beside = rounded(solution + side * width_, width_);
            if (beside > low && beside < high) found.push_back({beside, tolerance});
        }
        const bool has_beside = !found.empty();
        constexpr double rarely = 1.0 / 4096;
        for (const Place& p : places) {
            double at = rounded(low + p.share * (high - low), high - low);
            if (!(at > low && at < high)) at = low + p.share * (high - low);
            const auto is_here = [&](const Candidate& c) { return c.at == at; };
            if (at > low && at < high && std::ranges::none_of(found, is_here))
                found.push_back({at, p.penalty * (has_beside ? rarely : 1) * tolerance});
        }
        return found;
    }
    // `most_precise` was as precise as possible. Excludes the numbers that are so close to the solution that they would
    // need a much more precise measurement.
    void leave_out_hopeless(std::vector<Candidate>& all, const Measured& most_precise) const {
        const SolvePoint &low = *result_.low, &high = *result_.high;
        const double slope = (high.measure.estimate - low.measure.estimate) / (high.at - low.at);
        for (Candidate& c : all)
            if (!c.known && std::abs(slope * (c.at - interpolated())) < 0.4 * most_precise.width())
                c.is_exhausted = true;
    }
    // Replaces an end of the bracket by a number within it, always measuring next the number that needs the least
    // precision. `tolerance` is that of the first measurements; it becomes the one that was needed.
    std::optional<SolveEnd> halve(double& tolerance) {
        std::vector<Candidate> all = candidates(tolerance);
        const auto is_exhausted = [](const Candidate& c) { return c.is_exhausted; };
        while (!std::ranges::all_of(all, is_exhausted)) {
            if (const auto why = stopped()) return why;
            Candidate& c = *std::ranges::max_element(
                all, {}, [](const Candidate& one) { return one.is_exhausted ? 0 : one.tolerance; });
            const double tried = c.tolerance;
            measure_once(c);
            const Side side = side_of(c.known->measure);
            if (side != Side::undecided) {
                ((side == Side::below) == rises_ ? result_.low : result_.high) = c.known;
                tolerance = tried;
                return std::nullopt;
            }
            if (const auto why = stopped()) return why;
            if (c.is_exhausted)
                leave_out_hopeless(all, c.known->measure);
            else
                refine(c);
        }
        // No number lies between the ends, so the bracket is as narrow as possible.
        if (all.empty()) return SolveEnd::width;
        result_.undecided = std::ranges::find_if(all, [](const Candidate& c) { return c.known.has_value(); })->known;
        return SolveEnd::undecided;
    }

    // Interpolates between the ends, by their estimates; if there is no time to measure that number, takes the end that
    // is closer to the target.
    void find_best(double tolerance) {
        const SolvePoint &low = *result_.low, &high = *result_.high;
        const double at = std::clamp(rounded(interpolated(), high.at - low.at), low.at, high.at);
        Candidate c{at, tolerance};
        if (at == low.at)
            c.known = low;
        else if (at == high.at)
            c.known = high;
        else if (!stopped())
            measure_once(c, Until::tolerance);
        const auto off = [&](const SolvePoint& end) { return std::abs(end.measure.estimate - target_.value); };
        result_.best = c.known ? *c.known : off(low) < off(high) ? low : high;
    }

    const ObjectOf& object_;
    const SolveTarget& target_;
    const SolveOptions& options_;
    Clock::time_point start_;
    PhaseSet wanted_;
    double width_ = 0;
    double tolerance_of_ends_ = first_tolerance;
    bool rises_ = false;  // whether the measure is below the target at the lower end
    double steps_ = 1, done_ = 0;
    SolveResult result_;
};

void check(const SolveTarget& target, double low, double high, const SolveOptions& options) {
    if (!(low < high && std::isfinite(low) && std::isfinite(high)))
        throw ModelError(
            fmt::format("the bracket must be two finite numbers, the lower one first, but is {} and {}", low, high));
    if (!std::isfinite(target.value)) throw ModelError("the target must be a finite number");
    if (!(options.width >= 0 && std::isfinite(options.width)))
        throw ModelError(
            fmt::format("the width of the bracket must be a positive number, or 0, but is {}", options.width));
    if (!(options.seconds > 0))
        throw ModelError(fmt::format("the time must be a positive number of seconds, but is {}", options.seconds));
    bool has_weight = false;
    for (const auto& [phase, weight] : target.weights) {
        if (phase == vacuum || phase.index >= Phase::capacity) throw ModelError("the vacuum has no volume");
        if (!(weight >= 0 && std::isfinite(weight)))
            throw ModelError(fmt::format("a weight must not be negative or infinite, but is {}", weight));
        has_weight = has_weight || weight > 0;
    }
    if (!has_weight) throw ModelError("no phase has a positive weight");
}

}  // namespace

}  // namespace measuring

std::string_view name_of(SolveEnd end) {
    switch (end) {
        case SolveEnd::width:
            return "tolerance";
        case SolveEnd::undecided:
            return "undecided";
        case SolveEnd::same_side:
            return "same side";
        case SolveEnd::seconds:
            return "time";
        case SolveEnd::cancelled:
            return "interrupted";
    }
    return "";
}

SolveResult solve(const ObjectOf& object, const SolveTarget& target, double low, double high,
                  const SolveOptions& options) {
    measuring::check(target, low, high, options);
    return measuring::Solver(object, target, options).run(low, high);
}

}  // namespace phasetree
