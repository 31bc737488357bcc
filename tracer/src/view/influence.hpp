// Which numbers of a scene's text move a point of a surface, and how: the derivatives for dragging surfaces.
//
// METHOD
//
// The surface between two phases is where f = (φ_inside − φ_outside) / 2 is zero. Let θ be a number of the text, and p
// a point of the surface. When θ changes, a point that stays on the surface moves so that ∇f · dp/dθ = −∂f/∂θ. This
// says how it moves along the normal, and leaves open how it slides along the surface. Riso et al. (Direct Manipulation
// of Procedural Implicit Surfaces, SIGGRAPH Asia 2024) settle this by a co-parameterization of the surface. Here, the
// program has one already: the point q(p; θ) at which the primitive that f comes from is evaluated, in the primitive's
// own space. A point sticks to the surface if q stays the same, so that
//
//     dp/dθ = −(∂q/∂p)⁻¹ ∂q/∂θ
//
// up to a motion along the normal that restores f = 0. A translated ball follows the pointer wherever it is grabbed,
// and a ball whose radius changes moves its points outwards.
//
// DERIVATIVES
//
// ∂f/∂p and the choice of the primitive come from reverse mode over the recorded program, ∂q/∂p from forward mode, both
// exact and in double precision (PreciseEvaluator::interface_sample). Derivatives by θ are central differences of f and
// q in double precision, between objects that are read again with θ ± h: nodes store their parameters as floats and
// derive data from them, such as matrices, bounds and slopes, without rules for differentiation. With h of 10⁻⁴ of the
// parameter's scale or more, the error is about 10⁻³ of the derivative, from the rounding of constants to floats. It
// does not matter for the result, because Newton's method (view/drag.hpp) ends only when the surface itself is where it
// should be.
//
// Most numbers do not move a given point. They are excluded in groups: all numbers of a group are changed at once by
// different amounts, and the group is divided only if f or q changes.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "studio/vocabulary.hpp"
#include "view/varied_object.hpp"

namespace phasetree::tracer::view {

/// A number in the text that may be changed by dragging.
struct DragParameter {
    std::string pointer;
    std::string unit;
    double value = 0;
    double low = 0, high = 0;  ///< inclusive
    /// A change that is as large for this number as a change by the object's size is for a length.
    double scale = 1;
};

/// The numbers of the nodes and transforms of a document, in the order of the outline. Counts, keyed values and colours
/// are not among them. `size` is that of the object.
std::vector<DragParameter> drag_parameters(const Document& document, const studio::Vocabulary& vocabulary, double size);

/// A point of the surface between two phases.
struct InterfacePoint {
    Phase inside, outside;
    glm::dvec3 position{0};
};

/// How a number moves a point of a surface.
struct Influence {
    DragParameter parameter;
    double slope = 0;      ///< ∂f/∂θ
    glm::dvec3 motion{0};  ///< dp/dθ
    /// How far the point moves for a change by the parameter's scale, in sizes of the object.
    double strength = 0;
};

/// The influences of numbers, after `numbers` have been replaced.
std::vector<Influence> influences_of(const VariedObject& object, const NumberEdits& numbers,
                                     const InterfacePoint& point, std::span<const DragParameter> parameters);

/// The numbers that move a point, from the strongest to the weakest.
std::vector<Influence> influences(const VariedObject& object, const InterfacePoint& point,
                                  std::span<const DragParameter> parameters);

}  // namespace phasetree::tracer::view
