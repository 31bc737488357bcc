#pragma once

#include <array>

#include "bounding/sign_certificate.hpp"
#include "bounding/value_ranges.hpp"
#include "kernel/linear_bound.hpp"
#include "phasetree/math/bounds.hpp"
#include "rewriting/program_context.hpp"

namespace phasetree::enclosure {
struct Enclosure;
}

namespace phasetree::bounding {

using kernel::Curvature, kernel::LinearBound;
using program::ProgramOutput;
using rewriting::LocalValue, rewriting::ProgramContext;

struct AffinePoint;

/// What is known of a program in a box, besides its values' ranges.
struct BoxKnowledge {
    LinearBound bound;
    Curvature curvature;
    Bounds box;                                    ///< around the interface in the box; empty if no ray can meet one
    std::span<const CertificateStep> certificate;  ///< where a ray may be in a phase whose curvature is unknown
    std::span<const LocalValue> local;
};

/// Longer programs are not worth the time that it takes to enclose them; of those with local values a few times as long
/// ones are.
inline constexpr std::size_t longest_enclosed = 64;

/// Encloses programs' values in a box: interval arithmetic with gradients, which sees what a Lipschitz bound and a ball
/// cannot. A program that pruning has left of the last one keeps what was found of its primitives.
class Encloser {
  public:
    /// What is taken of `scratch` stays until the last enclosing. `around` is what local primitives are in a box around
    /// this one, in a program of which pruning has left those to come.
    Encloser(const ProgramContext&, const Bounds& box, std::span<const LocalValue> around, Arena& scratch);

    /// Ranges of its values; nothing for a program that is too long, or that folds space.
    std::optional<ValueRanges> ranges(const WorkingProgram&);
    /// The rest, of a program whose ranges were asked last and of which an interface is left.
    BoxKnowledge rest(const WorkingProgram&) const;

  private:
    void compute(const WorkingProgram&);
    std::span<const std::uint32_t> known_of(const WorkingProgram&) const;
    Enclosure component(const ProgramOutput&) const;

    const ProgramContext& context_;
    Bounds box_;
    std::array<double, 3> half_;
    Arena& scratch_;
    glm::dvec3 middle_;
    const AffinePoint* input_;  ///< any point of the box
    // Of the last program.
    std::span<const Instruction> code_;
    std::span<const std::uint32_t> slot_;
    Enclosure* registers_ = nullptr;
    std::span<const LocalValue> around_, local_;
};

}  // namespace phasetree::bounding
