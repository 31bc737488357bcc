#include "bounding/interface_bounds.hpp"

#include <cmath>

#include "bounding/cut.hpp"
#include "bounding/nearly_linear.hpp"
#include "bounding/plane_cut.hpp"

namespace phasetree::bounding {

using program::ProgramOutput;

namespace {

bool is_clear(const ProgramOutput& o, const EnclosedProgram& enclosed) {
    return !enclosed.context->opaque.contains(o.phase);
}

// The bounds of the curvature of s, the distance within which the label is constant. There are two definitions of s
// (Routine::uses_own_component). One is minus the label's own component, whose curvature is at most minus the lower
// bound on that component's curvature. The other is the minimum of the other components, which curves upwards no more
// than the most curved of them. The definition with the smaller sum of bounds is chosen.
Curvature curvature_of_distance(const EnclosedProgram& enclosed) {
    const std::span<const ProgramOutput> outputs = enclosed.program.outputs;
    // Index 0 is for rays in the phase of the first output, 1 for rays in any other. `by_others` bounds the curvature
    // of the components that may be among the others: all but the first, or any. `by_own` bounds that of minus the own
    // component, and `of_first` that of the first component. Each is the largest of the bounds, and at least 0.
    double by_others[] = {0, 0}, by_own[] = {0, 0}, of_first = 0;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const Interval& c = enclosed[outputs[i].value].curvature;
        const Interval curvature = outputs[i].negate ? -c : c;
        if (i == 0) of_first = std::max(of_first, curvature.high);
        if (i > 0) by_others[0] = std::max(by_others[0], curvature.high);
        by_others[1] = std::max(by_others[1], curvature.high);
        by_own[i == 0 ? 0 : 1] = std::max(by_own[i == 0 ? 0 : 1], -curvature.low);
    }
    const auto rounded_up = [](double bound) {
        return bound < 1e30 ? static_cast<float>(bound) * (1 + 1e-3f) : Curvature::unknown;
    };
    const bool is_shared = outputs.size() == 2 && outputs[0].value == outputs[1].value;
    Curvature result;
    result.uses_own_component = by_own[0] + by_own[1] < by_others[0] + by_others[1];
    for (std::size_t i = 0; i < 2; ++i)
        result.bound[i] = rounded_up(result.uses_own_component ? by_own[i] : by_others[i]);
    result.first_component_decides = is_shared || std::ranges::none_of(outputs.subspan(1), [&](const ProgramOutput& o) {
                                         return is_clear(o, enclosed);
                                     });
    if (!is_shared) result.bound[0] = rounded_up(by_own[0]);  // In the first phase, s is minus the first component.
    // Where the first component alone determines where rays may be, it is s in the other phases.
    if (result.first_component_decides) result.bound[1] = rounded_up(of_first);
    return result;
}

// The linear bound of the field f in floats, relative to the origin of coordinates.
LinearBound linear_bound(const NearlyLinear& linear, const Enclosure& f, const EnclosedProgram& enclosed) {
    const Bounds& box = enclosed.box;
    LinearBound bound;
    if (!(linear.slack < 1e30)) return bound;
    const glm::vec3 farthest = glm::max(glm::abs(box.low), glm::abs(box.high));
    const float largest_coordinate = std::max({farthest.x, farthest.y, farthest.z});
    for (int i = 0; i < 3; ++i) bound.normal[i] = static_cast<float>(linear.normal[static_cast<std::size_t>(i)]);
    bound.offset = static_cast<float>(linear.at_centre - glm::dot(glm::dvec3(bound.normal), glm::dvec3(box.centre())));
    // The last term covers the rounding error of normal·p + offset.
    bound.slack =
        static_cast<float>(linear.slack) * (1 + 1e-6f) + 3 * enclosed.context->value_error + 1e-6f * largest_coordinate;
    // Ray directions have unit length to within 10⁻⁵.
    bound.spread = static_cast<float>(linear.spread(f, enclosed.half)) * (1 + 1e-3f) + 1e-5f;
    return bound;
}

// A box around the zeros of the first component, from its own linear bound. This leaves a slab, which is enough if half
// the slab's thickness is less than 15 % of the box's extent along the normal. Otherwise, the zeros are also bounded by
// those of the values from which the component is computed.
Bounds box_around_interface(const NearlyLinear& linear, const LinearBound& bound, const EnclosedProgram& enclosed,
                            Arena& scratch) {
    const Bounds& whole = enclosed.box;
    const PlaneCut plane(linear, whole.centre(), cut_margin(whole, enclosed.context->value_error));
    const Bounds box = plane.at(0, LaneBox(whole)).bounds();
    if (bound.slack < 0.15f * glm::dot(glm::abs(bound.normal), whole.extent())) return box;
    return cut_to_zero(enclosed.program.outputs[0].value, box, enclosed, scratch);
}

}  // namespace

InterfaceBounds interface_bounds(const EnclosedProgram& enclosed, Arena& scratch) {
    const std::span<const ProgramOutput> outputs = enclosed.program.outputs;
    const Enclosure f = enclosed.of_output(outputs[0]);  // the first component, except for its sign
    const NearlyLinear linear(f, enclosed.half);
    InterfaceBounds result;
    result.curvature = curvature_of_distance(enclosed);
    result.bound = linear_bound(linear, f, enclosed);
    result.box = enclosed.box;
    // If all other phases are opaque, rays can only meet zeros of the first component.
    if (result.curvature.first_component_decides)
        result.box = box_around_interface(linear, result.bound, enclosed, scratch);
    if (result.box.empty()) return result;

    const bool is_shared = outputs.size() == 2 && outputs[0].value == outputs[1].value;
    const auto is_needed_in = [&](std::size_t side) {
        return !(result.curvature.bound[side] < Curvature::unknown) && is_clear(outputs[side], enclosed);
    };
    if (is_needed_in(0) || (is_shared && is_needed_in(1))) result.certificate = certify_sign(enclosed, scratch);
    return result;
}

}  // namespace phasetree::bounding
