#include "view/drag.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "phasetree/math/portable.hpp"

namespace phasetree::tracer::view {

namespace {

// In pixels: the error at which iterations end, and the digits that are kept.
constexpr double close_enough = 0.05, digits = 0.02;
constexpr int most_iterations = 12, most_halvings = 5;
// Motions across the ray count as parallel if the shorter axis of what they reach is below this share of the longer.
constexpr double least_share = 0.03;
// How far a point may move along the gradient back onto the surface, relative to the step before.
constexpr double farthest_back = 2;
// How far a point may move with the numbers, in the way that the pointer has moved. A point that no value can bring to
// the pointer must not lead to huge values.
constexpr double longest_detour = 6;
constexpr double most_miss = 0.5;

// The greatest power of ten that is at most x, but at least 10⁻³⁰.
double power_of_ten_below(double x) {
    double power = 1;
    while (power > x && power > 1e-30) power /= 10;
    while (power * 10 <= x) power *= 10;
    return power;
}
constexpr double well_enough = 0.2;  // the share of an error that a step leaves

class Drag {
  public:
    Drag(const VariedObject& object, const InterfacePoint& grabbed, std::span<const DragParameter> parameters,
         const DragTarget& target)
        : object_(object), parameters_(parameters), target_(target), now_{{}, grabbed} {
        for (const DragParameter& p : parameters_) now_.values.push_back(p.value);
        direction_ = glm::normalize(target.direction);
        const glm::dvec3 other = std::abs(direction_.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        across_[0] = glm::normalize(glm::cross(direction_, other));
        across_[1] = glm::cross(direction_, across_[0]);
        const double along = glm::dot(direction_, target.facing);
        const double distance = glm::dot(grabbed.position - target.origin, target.facing) / along;
        aim_ = target.origin + direction_ * (std::isfinite(distance) ? std::max(distance, 0.0) : 0.0);
    }

    Dragged result() {
        const std::size_t begin = object_.readings();
        const State grabbed = now_;
        stick();
        round();
        bool sticks = true, follows = is_at_pointer();
        if (!follows) {
            const State near = std::exchange(now_, grabbed);
            if (approach(aim_) || in_parts(grabbed)) {
                now_.point.position = aim_;
                round();
                follows = is_at_pointer();
            }
            sticks = !follows;
            if (sticks) now_ = near;  // as near as it comes
        }
        return {.values = numbers(now_.values),
                .position = now_.point.position,
                .miss = glm::length(miss(now_.point.position)) / target_.pixel,
                .follows = follows,
                .sticks = sticks,
                .readings = object_.readings() - begin};
    }

  private:
    struct State {
        std::vector<double> values;
        InterfacePoint point;
    };

    NumberEdits numbers(const std::vector<double>& values) const {
        NumberEdits result;
        for (std::size_t i = 0; i < values.size(); ++i) result[parameters_[i].pointer] = values[i];
        return result;
    }
    InterfaceSample sample(const std::vector<double>& values, const glm::dvec3& p) const {
        const auto evaluator = object_.with(numbers(values));
        if (!evaluator) return {.value = std::numeric_limits<double>::quiet_NaN()};
        return evaluator->interface_sample(p, now_.point.inside, now_.point.outside);
    }
    // From a point to the ray, in the plane across it.
    glm::dvec2 miss(const glm::dvec3& p) const {
        const glm::dvec3 d = target_.origin - p;
        return {glm::dot(d, across_[0]), glm::dot(d, across_[1])};
    }
    // The distance of the surface from a point; infinite if unknown.
    double gap(const glm::dvec3& p) const {
        const InterfaceSample s = sample(now_.values, p);
        const double slope = glm::length(s.gradient);
        return std::isfinite(s.value) && slope > 0 ? std::abs(s.value) / slope
                                                   : std::numeric_limits<double>::infinity();
    }
    // Whether the phases change at the point, and the point is at the pointer.
    bool is_at_pointer() const {
        const glm::dvec3& p = now_.point.position;
        const auto evaluator = object_.with(numbers(now_.values));
        if (!evaluator || !(glm::length(miss(p)) <= most_miss * target_.pixel)) return false;
        return is_interface(*evaluator, p);
    }
    bool is_interface(const PreciseEvaluator& object, const glm::dvec3& p) const {
        const InterfaceSample s = object.interface_sample(p, now_.point.inside, now_.point.outside);
        const double slope = glm::length(s.gradient);
        if (!std::isfinite(s.value) || !(slope > 0)) return false;
        for (const double reach : {0.25, 0.5}) {
            const glm::dvec3 by = s.gradient * (reach * target_.pixel / slope);
            if (object.label(p - by) == now_.point.inside && object.label(p + by) == now_.point.outside) return true;
        }
        return false;
    }
    // Whether the change since the point was grabbed is not out of proportion to the pointer's motion.
    bool is_moderate(const std::vector<double>& values) const {
        double squared = 0;
        for (std::size_t i = 0; i < values.size(); ++i)
            squared += std::pow((values[i] - parameters_[i].value) / parameters_[i].scale, 2);
        return std::sqrt(squared) <= longest_change_;
    }
    double close() const { return close_enough * target_.pixel; }

    std::vector<Influence> influences_at(const InterfacePoint& p) const {
        return influences_of(object_, numbers(now_.values), p, parameters_);
    }
    bool is_free(std::size_t i, double change) const {
        const DragParameter& p = parameters_[i];
        return change > 0 ? now_.values[i] < p.high : now_.values[i] > p.low;
    }
    // The values after a step, within the limits.
    std::vector<double> after(const std::vector<double>& step, double share) const {
        std::vector<double> result = now_.values;
        for (std::size_t i = 0; i < result.size(); ++i)
            result[i] = std::clamp(result[i] + share * step[i], parameters_[i].low, parameters_[i].high);
        return result;
    }

    // The least change by which the point moves by `by` across the ray. If all motions are parallel there, it moves by
    // the part of `by` in their direction. Numbers at a limit are left out; nullopt if none is left.
    std::optional<std::vector<double>> least_change(const std::vector<Influence>& all, const glm::dvec2& by) const {
        std::vector<bool> is_used(all.size(), true);
        while (true) {
            double xx = 0, xy = 0, yy = 0;
            std::vector<glm::dvec2> columns(all.size(), glm::dvec2(0));
            for (std::size_t i = 0; i < all.size(); ++i) {
                if (!is_used[i]) continue;
                columns[i] = glm::dvec2(glm::dot(all[i].motion, across_[0]), glm::dot(all[i].motion, across_[1])) *
                             parameters_[i].scale;
                xx += columns[i].x * columns[i].x;
                xy += columns[i].x * columns[i].y;
                yy += columns[i].y * columns[i].y;
            }
            const double mean = 0.5 * (xx + yy), half = portable::hypot(0.5 * (xx - yy), xy);
            const double longest = mean + half, determinant = xx * yy - xy * xy;
            if (!(longest > 1e-12 * object_.size() * object_.size())) return std::nullopt;
            glm::dvec2 y((yy * by.x - xy * by.y) / determinant, (xx * by.y - xy * by.x) / determinant);
            if (!(mean - half > least_share * least_share * longest)) {
                // The eigenvector of the longest axis.
                const glm::dvec2 axis = xx > yy ? glm::dvec2(longest - yy, xy) : glm::dvec2(xy, longest - xx);
                y = axis * (glm::dot(axis, by) / glm::dot(axis, axis) / longest);
            }
            std::vector<double> step(all.size(), 0.0);
            bool is_within = true;
            for (std::size_t i = 0; i < all.size(); ++i) {
                if (!is_used[i]) continue;
                step[i] = glm::dot(columns[i], y) * parameters_[i].scale;
                if (is_free(i, step[i])) continue;
                is_used[i] = is_within = false;
            }
            if (is_within) return step;
        }
    }

    // Moves a point back onto the surface; nullopt if that leads farther than `most`.
    std::optional<glm::dvec3> onto_surface(const std::vector<double>& values, glm::dvec3 p, double most) const {
        const auto evaluator = object_.with(numbers(values));
        if (!evaluator) return std::nullopt;
        const glm::dvec3 from = p;
        for (int i = 0; i < most_iterations; ++i) {
            const InterfaceSample s = evaluator->interface_sample(p, now_.point.inside, now_.point.outside);
            const double squared = glm::dot(s.gradient, s.gradient);
            if (!std::isfinite(s.value) || !(squared > 0)) return std::nullopt;
            const glm::dvec3 back = s.gradient * (s.value / squared);
            p -= back;
            if (glm::distance(p, from) > most) return std::nullopt;
            if (glm::length(back) < 0.1 * close()) return is_interface(*evaluator, p) ? std::optional(p) : std::nullopt;
        }
        return std::nullopt;
    }

    // Newton's method for a point that sticks to the surface.
    void stick() {
        std::vector<Influence> all;
        double last = 0;
        for (int i = 0; i < most_iterations; ++i) {
            const glm::dvec2 by = miss(now_.point.position);
            const double before = glm::length(by);
            if (before <= close()) return;
            // Derivatives are expensive, so they are kept while they serve well.
            if (!(before < well_enough * last)) all = influences_at(now_.point);
            last = before;
            if (i == 0) limit_change(all, before);
            const auto step = least_change(all, by);
            if (!step || !follow(all, *step, before)) return;
        }
    }
    void limit_change(const std::vector<Influence>& all, double way) {
        double strongest = 0;
        for (std::size_t i = 0; i < all.size(); ++i)
            strongest = std::max(strongest, glm::length(all[i].motion) * parameters_[i].scale);
        if (strongest > 0) longest_change_ = longest_detour * way / strongest;
    }
    bool follow(const std::vector<Influence>& all, const std::vector<double>& step, double before) {
        double share = 1;
        for (int i = 0; i <= most_halvings; ++i, share *= 0.5) {
            const std::vector<double> next = after(step, share);
            if (!is_moderate(next)) continue;
            glm::dvec3 p = now_.point.position;
            for (std::size_t k = 0; k < next.size(); ++k) p += all[k].motion * (next[k] - now_.values[k]);
            const double moved = glm::distance(p, now_.point.position);
            const auto found = onto_surface(next, p, farthest_back * moved + target_.pixel);
            if (!found || !(glm::length(miss(*found)) < before)) continue;
            now_.values = next;
            now_.point.position = *found;
            return true;
        }
        return false;
    }

    // Newton's method for the surface to pass through a point.
    bool approach(const glm::dvec3& q) {
        std::vector<Influence> all;
        double last = 0;
        for (int i = 0; i < most_iterations; ++i) {
            const InterfaceSample s = sample(now_.values, q);
            const double slope = glm::length(s.gradient);
            if (!std::isfinite(s.value) || !(slope > 0)) return false;
            if (std::abs(s.value) <= close() * slope) return true;
            if (!(std::abs(s.value) < well_enough * last))
                all = influences_at({now_.point.inside, now_.point.outside, q});
            last = std::abs(s.value);
            double squared = 0;
            for (std::size_t k = 0; k < all.size(); ++k)
                if (is_free(k, -s.value * all[k].slope)) squared += std::pow(all[k].slope * parameters_[k].scale, 2);
            if (!(squared > 0)) break;
            std::vector<double> step(all.size(), 0.0);
            for (std::size_t k = 0; k < all.size(); ++k)
                if (is_free(k, -s.value * all[k].slope))
                    step[k] = -s.value * all[k].slope * std::pow(parameters_[k].scale, 2) / squared;
            if (!come_closer(step, q, std::abs(s.value))) break;
        }
        return gap(q) <= most_miss * target_.pixel;
    }
    bool come_closer(const std::vector<double>& step, const glm::dvec3& q, double before) {
        double share = 1;
        for (int i = 0; i <= most_halvings; ++i, share *= 0.5) {
            const std::vector<double> next = after(step, share);
            if (!is_moderate(next)) continue;
            const InterfaceSample s = sample(next, q);
            if (!std::isfinite(s.value) || !(std::abs(s.value) < before)) continue;
            now_.values = next;
            return true;
        }
        return false;
    }
    // In a straight line from where the point was grabbed, because Newton's method may fail over long distances.
    bool in_parts(const State& grabbed) {
        constexpr int parts = 8;
        now_ = grabbed;
        const glm::dvec3 from = grabbed.point.position;
        for (int i = 1; i <= parts; ++i)
            if (!approach(from + (aim_ - from) * (static_cast<double>(i) / parts))) return false;
        return true;
    }

    // Keeps the digits that matter at the size of a pixel.
    void round() {
        const std::vector<Influence> all = influences_at(now_.point);
        const std::vector<double> exact = now_.values;
        for (std::size_t i = 0; i < now_.values.size(); ++i) {
            if (now_.values[i] == parameters_[i].value) continue;
            const double motion = glm::length(all[i].motion);
            const double finest = 1e-5 * parameters_[i].scale;
            const double step =
                motion > 0 ? std::min(digits * target_.pixel / motion, 0.01 * parameters_[i].scale) : finest;
            const double unit = power_of_ten_below(step);
            // Dividing by a whole power of ten gives a number that is written with few digits.
            const double inverse = std::round(1 / unit);
            const double value =
                unit < 1 ? std::round(now_.values[i] * inverse) / inverse : std::round(now_.values[i] / unit) * unit;
            now_.values[i] = std::clamp(value, parameters_[i].low, parameters_[i].high);
        }
        if (!object_.with(numbers(now_.values))) now_.values = exact;
    }

    const VariedObject& object_;
    std::span<const DragParameter> parameters_;
    DragTarget target_;
    State now_;
    double longest_change_ = std::numeric_limits<double>::infinity();  // in scales
    glm::dvec3 direction_{0}, aim_{0}, across_[2];
};

}  // namespace

Dragged drag(const VariedObject& object, const InterfacePoint& grabbed, std::span<const DragParameter> parameters,
             const DragTarget& target) {
    return Drag(object, grabbed, parameters, target).result();
}

}  // namespace phasetree::tracer::view
