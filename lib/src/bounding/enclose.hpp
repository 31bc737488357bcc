#pragma once

#include <array>

#include "bounding/value_ranges.hpp"
#include "rewriting/specialise.hpp"

namespace phasetree::bounding {

using enclosure::Interval;
using program::ProgramOutput;
using rewriting::RequiredOfLocal, rewriting::Specialisation;

struct AffinePoint;

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

    /// The ranges of a program's values. Returns nullopt if the program is too long or folds
    /// space.
    std::optional<ValueRanges> value_ranges(const WorkingProgram&);
    /// The program last passed to value_ranges(), for interface_bounds(), and the specialisations of its local
    /// primitives.
    const EnclosedProgram& enclosed() const { return last_; }
    std::span<const Specialisation> specialisations() const { return specialisations_; }

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

    const ProgramContext& context_;
    Bounds box_;
    std::array<double, 3> half_;  ///< the half extents of the box, rounded up
    Arena& scratch_;
    glm::dvec3 centre_;
    const AffinePoint* point_of_box_;
    std::span<const Specialisation> around_;
    std::span<const RequiredOfLocal> required_;
    // The last program that was enclosed:
    EnclosedProgram last_;
    Enclosure* registers_ = nullptr;
    std::span<const Specialisation> specialisations_;
};

}  // namespace phasetree::bounding
