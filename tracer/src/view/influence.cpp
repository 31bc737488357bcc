#include "view/influence.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <set>

#include "phasetree/io/keys.hpp"
#include "studio/outline.hpp"
#include "studio/pointer.hpp"

namespace phasetree::tracer::view {

namespace {

// Influences below this strength are not reported.
constexpr double least_strength = 1e-4;
// The step of a central difference, and that of a test of a group, as a fraction of the change that matters.
constexpr double small_step = 1e-3, group_step = 1e-2;
// Where the primitive that f comes from changes within a step, q jumps.
constexpr double longest_motion = 100;

// Degrees per radian: turning by this moves a point as far as its distance from the axis.
constexpr double radian = 57.29577951308232;

double scale_of(const std::string& unit, double value, double size) {
    if (unit == "m") return size;
    if (unit == "degrees") return radian;
    if (unit == "degrees/m") return radian / size;
    if (unit == "1/m") return 1 / size;
    return std::max(std::abs(value), 0.1);
}

class Collector {
  public:
    explicit Collector(double size) : size_(size) {}

    void add(const studio::OutlineEntry& entry) {
        if (const bool is_geometry = entry.type == "field" || entry.type == "object" || entry.type == "placed_object" ||
                                     entry.type == "instance" || entry.type == "transform" || entry.type == "group";
            is_geometry)
            for (const studio::OutlineParameter& p : entry.parameters)
                if (p.of && p.value && !p.is_keyed && has_lengths(*p.of)) numbers(*p.of, *p.value, p.pointer);
        for (const studio::OutlineEntry& child : entry.children) add(child);
    }
    std::vector<DragParameter> found;

  private:
    static bool has_lengths(const studio::KindParameter& p) {
        return p.control != "integer" && p.control != "color" && p.control != "spectrum" && p.control != "file" &&
               p.control != "text" && p.control != "choice" && p.control != "boolean" && p.control != "phase" &&
               p.control != "phases";
    }
    void numbers(const studio::KindParameter& p, Value value, const std::string& pointer) {
        if (value.is_number()) {
            constexpr double unlimited = std::numeric_limits<double>::max();
            const double scale = scale_of(p.unit, value.number(), size_), inside = 1e-3 * scale;
            double low = p.low.value_or(-unlimited), high = p.high.value_or(unlimited);
            if (p.low && p.low_is_open) low += std::min(inside, 0.5 * (value.number() - low));
            if (p.high && p.high_is_open) high -= std::min(inside, 0.5 * (high - value.number()));
            found.push_back({pointer, p.unit, value.number(), low, high, scale});
            return;
        }
        if (!value.is_array()) return;
        std::size_t i = 0;
        for (const Value item : value) numbers(p, item, pointer + "/" + std::to_string(i++));
    }

    double size_;
};

// The step of a difference, so small that the number keeps its leading digits, but large for a float.
double step_of(const DragParameter& p, double at) {
    return small_step * std::min(p.scale, std::max(std::abs(at), 0.1 * p.scale));
}

double number_at(const NumberEdits& numbers, const DragParameter& p) {
    const auto edit = numbers.find(p.pointer);
    return edit == numbers.end() ? p.value : edit->second;
}

// A float, because nodes store floats.
double rounded(double v) {
    return static_cast<double>(static_cast<float>(v));
}

NumberEdits changed(NumberEdits numbers, const DragParameter& p, double to) {
    numbers[p.pointer] = to;
    return numbers;
}

bool is_usable(const InterfaceSample& s) {
    return std::isfinite(s.value);
}

InterfaceSample sample_of(const VariedObject& object, const NumberEdits& numbers, const InterfacePoint& point) {
    const auto evaluator = object.with(numbers);
    if (!evaluator) return {.value = std::numeric_limits<double>::quiet_NaN()};
    return evaluator->interface_sample(point.position, point.inside, point.outside);
}

// Finds the numbers that f or q depends on.
class Search {
  public:
    Search(const VariedObject& object, const InterfacePoint& point, std::span<const DragParameter> parameters)
        : object_(object), point_(point), parameters_(parameters), base_(sample_of(object, {}, point)) {
        const double farthest = glm::length(point.position) + object.size();
        const auto evaluator = object.with({});
        noise_ = std::max(2e-9 * object.size(), evaluator ? 4 * evaluator->value_error(farthest) : 0.0);
    }

    std::vector<std::size_t> found() {
        divide(0, parameters_.size());
        return std::move(found_);
    }

  private:
    void divide(std::size_t begin, std::size_t end) {
        if (begin == end || !may_depend_on(begin, end)) return;
        if (end - begin == 1) {
            found_.push_back(begin);
            return;
        }
        const std::size_t middle = begin + (end - begin) / 2;
        divide(begin, middle);
        divide(middle, end);
    }
    // Different amounts, so that changes do not cancel. A number at a limit is moved away from it.
    bool may_depend_on(std::size_t begin, std::size_t end) const {
        NumberEdits numbers;
        for (std::size_t i = begin; i < end; ++i) {
            const DragParameter& p = parameters_[i];
            const double amount = 0.5 + std::fmod(0.6180339887 * static_cast<double>(i + 1), 1.0);
            const double step = amount * group_step / small_step * step_of(p, p.value);
            numbers[p.pointer] = p.value + (p.value + step <= p.high ? step : -step);
        }
        const InterfaceSample s = sample_of(object_, numbers, point_);
        if (!is_usable(s)) return true;
        return std::abs(s.value - base_.value) > noise_ || glm::distance(s.inner, base_.inner) > noise_;
    }

    const VariedObject& object_;
    const InterfacePoint& point_;
    std::span<const DragParameter> parameters_;
    InterfaceSample base_;
    double noise_ = 0;
    std::vector<std::size_t> found_;
};

// dp/dθ of a point that sticks to the surface.
glm::dvec3 motion_of(const InterfaceSample& at, double slope, const glm::dvec3& inner_slope) {
    glm::dvec3 motion(0);
    if (at.weight != 0 && std::abs(glm::determinant(at.inner_by_point)) > 1e-9)
        motion = -(glm::inverse(at.inner_by_point) * inner_slope);
    const double squared = glm::dot(at.gradient, at.gradient);
    if (squared > 0) motion -= at.gradient * ((slope + glm::dot(at.gradient, motion)) / squared);
    return motion;
}

// `at` is the interface with the numbers.
Influence influence_of(const VariedObject& object, const NumberEdits& numbers, const InterfacePoint& point,
                       const InterfaceSample& at, const DragParameter& p) {
    const double value = number_at(numbers, p), step = step_of(p, value);
    const auto sample = [&](double to) { return sample_of(object, changed(numbers, p, to), point); };
    double less = rounded(std::max(value - step, p.low)), more = rounded(std::min(value + step, p.high));
    InterfaceSample at_less = sample(less), at_more = sample(more);
    // A number at the edge of what its node accepts has a derivative on one side.
    if (!is_usable(at_less)) {
        less = rounded(value);
        at_less = at;
    }
    if (!is_usable(at_more)) {
        more = rounded(value);
        at_more = at;
    }
    if (!is_usable(at) || !(more > less)) return {p};
    const double difference = more - less;
    const double slope = (at_more.value - at_less.value) / difference;
    glm::dvec3 inner_slope = (at_more.inner - at_less.inner) / difference;
    if (glm::length(inner_slope) * p.scale > longest_motion * object.size()) inner_slope = glm::dvec3(0);
    const glm::dvec3 motion = motion_of(at, slope, inner_slope);
    return {p, slope, motion, glm::length(motion) * p.scale / object.size()};
}

}  // namespace

std::vector<DragParameter> drag_parameters(const Document& document, const studio::Vocabulary& vocabulary,
                                           double size) {
    Collector collector(size);
    for (const studio::OutlineEntry& entry : studio::outline_of(document, vocabulary).entries) collector.add(entry);
    return std::move(collector.found);
}

std::vector<Influence> influences_of(const VariedObject& object, const NumberEdits& numbers,
                                     const InterfacePoint& point, std::span<const DragParameter> parameters) {
    const InterfaceSample at = sample_of(object, numbers, point);
    std::vector<Influence> result;
    for (const DragParameter& p : parameters) result.push_back(influence_of(object, numbers, point, at, p));
    return result;
}

std::vector<Influence> influences(const VariedObject& object, const InterfacePoint& point,
                                  std::span<const DragParameter> parameters) {
    std::vector<DragParameter> found;
    for (const std::size_t i : Search(object, point, parameters).found()) found.push_back(parameters[i]);
    std::vector<Influence> result = influences_of(object, {}, point, found);
    std::erase_if(result, [](const Influence& one) { return !(one.strength > least_strength); });
    std::ranges::stable_sort(result, [](const Influence& a, const Influence& b) { return a.strength > b.strength; });
    return result;
}

}  // namespace phasetree::tracer::view
