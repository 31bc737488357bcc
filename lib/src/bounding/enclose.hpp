#pragma once

#include <array>

#include "bounding/sign_certificate.hpp"
#include "bounding/value_ranges.hpp"
#include "kernel/linear_bound.hpp"
#include "rewriting/specialise.hpp"

namespace phasetree::bounding {

using enclosure::Interval;
using kernel::Curvature, kernel::LinearBound;
using program::ProgramOutput;
using rewriting::RequiredOfLocal, rewriting::Specialisation;

struct AffinePoint;
struct NearlyLinear;

/// What is known about the interfaces in a box, apart from the ranges of values.
struct InterfaceBounds {
    LinearBound bound;
    Curvature curvature;
    Bounds box;                                    ///< encloses the interfaces; empty if no ray can meet one
    std::span<const CertificateStep> certificate;  ///< for rays in phases in which the curvature is unbounded
    std::span<const Specialisation> specialisations;
};

/// Programs with more instructions are not enclosed, because that would take longer than it saves. Programs with local
/// primitives, for which it saves more, are enclosed up to four times this length.
inline constexpr std::size_t longest_enclosed = 64;

/// Encloses the values of programs in a box (bounding/enclosed_program.hpp) by interval arithmetic with gradients and
/// curvatures. The bounds are tighter than those from Lipschitz bounds in a ball around the box. If a program results
/// from pruning the previous one, the enclosures of its primitives are reused.
class Encloser {
  public:
    /// Memory allocated in `scratch` must live as long as any result is used. `around` contains the specialisations
    /// that local primitives had in the surrounding box. `required` contains the upper limits up to which their values
    /// are required in this box; primitives that it does not list are required everywhere.
    Encloser(const ProgramContext&, const Bounds& box, std::span<const Specialisation> around,
             std::span<const RequiredOfLocal> required, Arena& scratch);

    /// The ranges of a program's values. Nothing if the program is too long or folds space.
    std::optional<ValueRanges> value_ranges(const WorkingProgram&);
    /// The bounds of the interfaces of the program last passed to value_ranges().
    InterfaceBounds interface_bounds() const;

  private:
    void enclose_values(const WorkingProgram&);
    void enclose_instructions(const WorkingProgram&, std::span<const std::uint32_t> previous,
                              std::span<Specialisation> found);
    std::span<const std::uint32_t> previous_numbers(const WorkingProgram&) const;
    std::span<Specialisation> previous_specialisations(const WorkingProgram&,
                                                       std::span<const std::uint32_t> previous) const;
    void keep_specialisations(std::span<Specialisation> found);
    std::span<const float> data_around(std::uint32_t source) const;
    double farthest_required(std::uint32_t source) const;
    Enclosure enclosure_of_output(const ProgramOutput&) const;
    Curvature curvature() const;
    LinearBound linear_bound(const NearlyLinear&, const Enclosure& f) const;
    Bounds box_around_interface(const NearlyLinear&, const LinearBound&) const;
    bool is_clear(const ProgramOutput& o) const { return !context_.opaque.contains(o.phase); }

    const ProgramContext& context_;
    Bounds box_;
    std::array<double, 3> half_;  ///< the half extents of the box, rounded up
    Arena& scratch_;
    glm::dvec3 centre_;
    const AffinePoint* point_of_box_;
    std::span<const Specialisation> around_;
    std::span<const RequiredOfLocal> required_;
    // Of the last program:
    EnclosedProgram last_;
    Enclosure* registers_ = nullptr;
    std::span<const Specialisation> specialisations_;
};

}  // namespace phasetree::bounding
