#pragma once

#include <memory>
#include <optional>
#include <string>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/math/convex_polyhedron.hpp"
#include "phasetree/model/crossing.hpp"

namespace phasetree {

/// The bounds and the resolution with which an object is traced.
struct TraceableObject {
    Bounds bounds;         ///< of the object, with a margin of vacuum of a few resolutions
    float resolution = 0;  ///< in the scene's unit of length
    /// A message for the user, usually empty: float coordinates are coarse so far from the origin, or the resolution is
    /// not the one requested.
    std::string warning{};
};
/// Find the bounds of an object and the resolution with which it is traced. See InterfaceTracer for the parameter
/// `resolution` and the errors.
TraceableObject prepare_to_trace(const Phased& object, float resolution = 0);

/// Traces rays from phase to phase through one object, with the program of the whole object. (InterfaceCells finds the
/// same crossings faster.) Immutable; any thread may use it, each with its own Workspace.
class InterfaceTracer {
  public:
    /// Prepare an object for tracing.
    ///
    /// `resolution`, in the scene's unit of length, is the smallest thickness, along a ray, of phases that are
    /// guaranteed to be found. Thinner phases may be missed. In two cases a thicker phase may be missed as well:
    ///   - at most 2.75 r of the ray lies in the phase, and at most r of that is deeper inside than r/16, where r is
    ///     the resolution;
    ///   - the ray grazes the phase: it is nowhere deeper inside than r/16.
    ///
    /// 0 selects 2·10⁻⁶ of the object's diagonal, or 10⁻⁶ of its farthest coordinate if that is more. All values are
    /// clamped: to at most a hundredth of the diagonal, then to at least 2.5·10⁻⁷ of the diagonal or of the farthest
    /// coordinate, whichever is more. resolution() and warning() return what is in use.
    ///
    /// Throws ModelError if the object is unbounded or empty, or too far from the origin for its size.
    explicit InterfaceTracer(const Phased& object, float resolution = 0);
    /// The same with half-spaces that each contain everything but the vacuum, such as those of carve(). Parts of a ray
    /// outside them need no evaluation. Crossings are the same, up to the resolution.
    InterfaceTracer(const Phased& object, std::vector<HalfSpace> around, float resolution = 0);

    /// Find the first change of phase along a ray.
    ///
    /// direction     of unit length.
    /// t_min, t_max  the range of distances from the origin.
    /// carried       the phase that the ray is in, as known from the crossing at which it starts; by default, the phase
    ///               at the start (its label, see label() in model/handle.hpp). If that point is deeper in another
    ///               phase than rounding errors can explain, there is a crossing where the search starts (see
    ///               Crossing).
    ///
    /// Counters, if given, are incremented. Returns nullopt if there is no crossing.
    std::optional<Crossing> first_crossing(const glm::vec3& origin, const glm::vec3& direction, float t_min,
                                           float t_max, std::optional<Phase> carried, Evaluator::Workspace&,
                                           TraceCounters* = nullptr) const;

    /// The unit normal of a crossing, from `from` into `to`; see CrossingNormal.
    glm::vec3 normal(const Crossing&, const glm::vec3& direction) const;

    /// The phase at a point; the vacuum outside bounds().
    Phase label(const glm::vec3& p, Evaluator::Workspace&) const;

    const Evaluator& evaluator() const { return *evaluator_; }
    /// A box around the object, with a margin of vacuum of a few resolutions.
    const Bounds& bounds() const { return bounds_; }
    float resolution() const { return resolution_; }
    /// A message for the user, usually empty; see TraceableObject.
    const std::string& warning() const { return warning_; }

  private:
    std::shared_ptr<const Evaluator> evaluator_;
    Bounds bounds_;
    float resolution_ = 0;
    std::string warning_;
    std::vector<HalfSpace> around_;
};

}  // namespace phasetree
