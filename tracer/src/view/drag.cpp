#include "view/drag.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <vector>

namespace phasetree::tracer::view {

namespace {

// In pixels: the error at which iterations end, and the digits that are kept.
constexpr double close_enough = 0.05, digits = 0.02;
constexpr int most_iterations = 12, most_halvings = 5;
// Motions across the ray count as parallel if the shorter axis of what they reach is below this share of the longer.
constexpr double least_share = 0.03;
// How far a point may move along the gradient back onto the surface, relative to the step before.
constexpr double farthest_back = 2;

class Drag {
  public:
    Drag(const VariedObject& object, const InterfacePoint& grabbed, std::span<const DragParameter> parameters,
         const DragTarget& target)
        : object_(object), point_(grabbed), parameters_(parameters), target_(target) {
        for (const DragParameter& p : parameters_) values_.push_back(p.value);
        direction_ = glm::normalize(target.direction);
        const glm::dvec3 other = std::abs(direction_.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        across_[0] = glm::normalize(glm::cross(direction_, other));
        across_[1] = glm::cross(direction_, across_[0]);
        const double along = glm::dot(direction_, target.facing);
        const double distance = glm::dot(grabbed.position - target.origin, target.facing) / along;
        aim_ = target.origin + direction_ * (std::isfinite(distance) ? std::max(distance, 0.0) : 0.0);
    }

    Dragged result() {
        const double begin = static_cast<double>(object_.readings());
        const std::vector<double> first = values_;
        const InterfacePoint grabbed = point_;
        bool sticks = stick();
        if (!sticks) {
            values_ = first;
            point_ = grabbed;
            if (approach(aim_) || in_parts(grabbed.position)) point_.position = aim_;
        }
        round();
        Dragged result{.values = numbers(values_), .position = point_.position, .sticks = sticks};
        result.miss = sticks ? glm::length(miss(point_.position)) / target_.pixel : gap(aim_) / target_.pixel;
        result.readings = object_.readings() - static_cast<std::size_t>(begin);
        return result;
    }

  private:
    NumberEdits numbers(const std::vector<double>& values) const {
        NumberEdits result;
        for (std::size_t i = 0; i < values.size(); ++i) result[parameters_[i].pointer] = values[i];
        return result;
    }
    InterfaceSample sample(const std::vector<double>& values, const glm::dvec3& p) const {
        const auto evaluator = object_.with(numbers(values));
        if (!evaluator) return {.value = std::numeric_limits<double>::quiet_NaN()};
        return evaluator->interface_sample(p, point_.inside, point_.outside);
    }
    // From a point to the ray, in the plane across it.
    glm::dvec2 miss(const glm::dvec3& p) const {
        const glm::dvec3 d = target_.origin - p;
        return {glm::dot(d, across_[0]), glm::dot(d, across_[1])};
    }
    // The distance of the surface from a point; infinite if unknown.
    double gap(const glm::dvec3& p) const {
        const InterfaceSample s = sample(values_, p);
        const double slope = glm::length(s.gradient);
        return std::isfinite(s.value) && slope > 0 ? std::abs(s.value) / slope
                                                   : std::numeric_limits<double>::infinity();
    }
    double close() const { return close_enough * target_.pixel; }

    std::vector<Influence> influences_at(const InterfacePoint& p) const {
        std::vector<Influence> result;
        for (const DragParameter& parameter : parameters_)
            result.push_back(influence_of(object_, numbers(values_), p, parameter));
        return result;
    }
    bool is_free(std::size_t i, double change) const {
        const DragParameter& p = parameters_[i];
        return change > 0 ? values_[i] < p.high : values_[i] > p.low;
    }
    // The values after a step, within the limits.
    std::vector<double> after(const std::vector<double>& step, double share) const {
        std::vector<double> result = values_;
        for (std::size_t i = 0; i < result.size(); ++i)
            result[i] = std::clamp(result[i] + share * step[i], parameters_[i].low, parameters_[i].high);
        return result;
    }

    // The least change by which the point moves by `by` across the ray; nullopt if the motions do not span the plane.
    // Numbers at a limit are left out.
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
            const double mean = 0.5 * (xx + yy), half = std::hypot(0.5 * (xx - yy), xy);
            if (!(mean - half > least_share * least_share * (mean + half))) return std::nullopt;
            const double determinant = xx * yy - xy * xy;
            const glm::dvec2 y((yy * by.x - xy * by.y) / determinant, (xx * by.y - xy * by.x) / determinant);
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
            const InterfaceSample s = evaluator->interface_sample(p, point_.inside, point_.outside);
            const double squared = glm::dot(s.gradient, s.gradient);
            if (!std::isfinite(s.value) || !(squared > 0)) return std::nullopt;
            const glm::dvec3 back = s.gradient * (s.value / squared);
            p -= back;
            if (glm::distance(p, from) > most) return std::nullopt;
            if (glm::length(back) < 0.1 * close()) return p;
        }
        return std::nullopt;
    }

    // Newton's method for a point that sticks to the surface.
    bool stick() {
        if (parameters_.size() < 2) return false;
        for (int i = 0; i < most_iterations; ++i) {
            const glm::dvec2 by = miss(point_.position);
            const double before = glm::length(by);
            if (before <= close()) return true;
            const std::vector<Influence> all = influences_at(point_);
            const auto step = least_change(all, by);
            if (!step || !follow(all, *step, before)) return false;
        }
        return glm::length(miss(point_.position)) <= 0.5 * target_.pixel;
    }
    bool follow(const std::vector<Influence>& all, const std::vector<double>& step, double before) {
        double share = 1;
        for (int i = 0; i <= most_halvings; ++i, share *= 0.5) {
            const std::vector<double> next = after(step, share);
            glm::dvec3 p = point_.position;
            for (std::size_t k = 0; k < next.size(); ++k) p += all[k].motion * (next[k] - values_[k]);
            const double moved = glm::distance(p, point_.position);
            const auto found = onto_surface(next, p, farthest_back * moved + target_.pixel);
            if (!found || !(glm::length(miss(*found)) < before)) continue;
            values_ = next;
            point_.position = *found;
            return true;
        }
        return false;
    }

    // Newton's method for the surface to pass through a point.
    bool approach(const glm::dvec3& q) {
        for (int i = 0; i < most_iterations; ++i) {
            const InterfaceSample s = sample(values_, q);
            const double slope = glm::length(s.gradient);
            if (!std::isfinite(s.value) || !(slope > 0)) return false;
            if (std::abs(s.value) <= close() * slope) return true;
            const std::vector<Influence> all = influences_at({point_.inside, point_.outside, q});
            double squared = 0;
            for (std::size_t k = 0; k < all.size(); ++k)
                if (is_free(k, -s.value * all[k].slope)) squared += std::pow(all[k].slope * parameters_[k].scale, 2);
            if (!(squared > 0)) return false;
            std::vector<double> step(all.size(), 0.0);
            for (std::size_t k = 0; k < all.size(); ++k)
                if (is_free(k, -s.value * all[k].slope))
                    step[k] = -s.value * all[k].slope * std::pow(parameters_[k].scale, 2) / squared;
            if (!come_closer(step, q, std::abs(s.value))) return false;
        }
        return gap(q) <= 0.5 * target_.pixel;
    }
    bool come_closer(const std::vector<double>& step, const glm::dvec3& q, double before) {
        double share = 1;
        for (int i = 0; i <= most_halvings; ++i, share *= 0.5) {
            const std::vector<double> next = after(step, share);
            const InterfaceSample s = sample(next, q);
            if (!std::isfinite(s.value) || !(std::abs(s.value) < before)) continue;
            values_ = next;
            return true;
        }
        return false;
    }
    // In a straight line from where the point was grabbed, because Newton's method may fail over long distances.
    bool in_parts(const glm::dvec3& from) {
        constexpr int parts = 8;
        for (std::size_t i = 0; i < values_.size(); ++i) values_[i] = parameters_[i].value;
        for (int i = 1; i <= parts; ++i)
            if (!approach(from + (aim_ - from) * (static_cast<double>(i) / parts))) return false;
        return true;
    }

    // Keeps the digits that matter at the size of a pixel.
    void round() {
        const std::vector<Influence> all = influences_at(point_);
        for (std::size_t i = 0; i < values_.size(); ++i) {
            if (values_[i] == parameters_[i].value) continue;
            const double motion = glm::length(all[i].motion);
            const double finest = 1e-5 * parameters_[i].scale;
            const double step =
                motion > 0 ? std::min(digits * target_.pixel / motion, 0.01 * parameters_[i].scale) : finest;
            const double unit = std::pow(10.0, std::floor(std::log10(step)));
            // Dividing by a whole power of ten gives a number that is written with few digits.
            const double inverse = std::round(1 / unit);
            const double value =
                unit < 1 ? std::round(values_[i] * inverse) / inverse : std::round(values_[i] / unit) * unit;
            values_[i] = std::clamp(value, parameters_[i].low, parameters_[i].high);
        }
    }

    const VariedObject& object_;
    InterfacePoint point_;
    std::span<const DragParameter> parameters_;
    DragTarget target_;
    std::vector<double> values_;
    glm::dvec3 direction_{0}, aim_{0}, across_[2];
};

}  // namespace

Dragged drag(const VariedObject& object, const InterfacePoint& grabbed, std::span<const DragParameter> parameters,
             const DragTarget& target) {
    return Drag(object, grabbed, parameters, target).result();
}

}  // namespace phasetree::tracer::view
