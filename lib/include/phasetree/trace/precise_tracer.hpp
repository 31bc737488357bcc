// Tracing in double precision, for simulations of particles, light and sound.
//
// WHAT IS CERTIFIED
//
// The function that is traced is Φ, the components of the object, as PreciseEvaluator computes them: the equations of
// the tree with the same constants as everywhere, in double precision. The phase at a point is that of the smallest
// component, the lowest index among equal ones, as for floats. Nothing is approximated by cells or triangles.
//
// A *crossing* is a change of phase along a ray. It is reported as a bracket of two points on the ray, which are no
// more than a few units in the last place apart: p_from, which is in `from` up to rounding errors, and p_to, whose
// label is `to`. A ray that starts at p_to in `to` goes on, and one that starts at p_from in `from` is reflected,
// without any offset. Crossings chain: `to` of each is `from` of the next.
//
// HOW CROSSINGS ARE FOUND
//
// Let c be the phase that the ray is in (`carried`), and s the interface distance: within s, the phase cannot change
// (lib/README.md proves it from the invariants that every node keeps). Components are rounded. Let η be value_error(),
// an upper estimate of the error, and let a sample be *in c* if its label is c or if φ of c is at most η there.
//
// 1. *Lipschitz steps.* The ray steps by s (1 − lipschitz_excess) − η. A longer step is allowed if both of its ends are
//    labelled c and their safe distances together cover it.
// 2. *Steps in doubt.* Where such a step is shorter than the resolution r, the ray steps by r, and what lies between is
//    not examined.
// 3. *Enclosed stretches.* A ray that makes no headway runs along an interface. Interval arithmetic with derivatives
//    bounds φ of c over whole stretches of it. Stretches on which φ of c stays below η − δ are in c, and are passed; δ
//    is explained below.
// 4. *Bracketing.* Let h be the first sample that is not in c, and k its label. Bisection and interpolation bracket the
//    point where label k begins, between h and the last sample labelled c. Other phases found on the way are passed
//    over if they are shallower than η, as on a face shared by two solids. If one is deeper, it is bracketed instead of
//    k.
//
// WHAT IS GUARANTEED, AND WHAT IS NOT
//
// * Between two crossings, there is no stretch of length r or more on which φ of the phase between them exceeds η. So
//   no crossing is lost if the phases on both sides are deeper than η over a length of at least r, and none is found
//   twice. Thinner phases may be missed, but crossings still chain.
// * By default, r is 2⁻³⁰ (9·10⁻¹⁰) of the object's diagonal, and η is 2⁻⁴⁴ (6·10⁻¹⁴) of the farthest coordinate of its
//   bounds. A ray within η of a face crosses it anywhere along the face, or not at all.
// * For objects that search in floats (meshes, balls, volumes, labels; see PreciseEvaluator), η is 2⁻²² of the farthest
//   coordinate, and r is 2·10⁻⁶ of the diagonal by default. These objects are as exact as with floats.
// * The constants of some nodes, such as cones, are not exactly consistent with each other, because each is rounded to
//   a float. The values of others (sines, polygons, networks) are enclosed with float arithmetic. In both cases, an
//   enclosure may miss the value in double precision, usually by less than 10⁻⁷. The difference is measured at some
//   points of the object when a tracer is made. η is at least four times the largest difference found, and δ is twice
//   it; δ is 0 for all other objects. r is at least 2 η.
// * Where stretches cannot be enclosed (outlines, patterns and images have no known derivatives), a ray along an
//   interface takes steps of r. After 65,536 steps shorter than 1,024 r, the shortest step doubles with every 256
//   further ones, so that every ray ends. Phases thicker than r may be missed there, and only there.
// * Positions far from the object cost precision: a ray is first moved to where it enters the object's bounds, and the
//   rounding error of that point grows with the distance of the origin.
// * The whole program runs at each sample. Unlike InterfaceCells, this tracer does not prune it, so the cost grows with
//   the number of nodes.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "phasetree/evaluation/precise_evaluator.hpp"
#include "phasetree/math/bounds.hpp"

namespace phasetree {

/// A ray in double precision.
struct PreciseRay {
    glm::dvec3 origin{0};
    glm::dvec3 direction{0, 0, 1};  ///< of any length; distances along the ray are in units of it
    double t_max = std::numeric_limits<double>::infinity();  ///< crossings beyond are not reported
    /// The phase that the ray is in, as known from the crossing at which it starts; by default, the phase at the start.
    /// If the start of the search (the origin, or where the ray enters the object's bounds) is deeper in another phase
    /// than rounding errors can explain, a crossing of zero length is reported there.
    std::optional<Phase> carried{};
};

/// A change of phase along a ray in double precision; see the top of this file.
struct PreciseCrossing {
    double t_from = 0;     ///< p_from is origin + t_from · direction, up to rounding
    double t_to = 0;       ///< the same for p_to
    glm::dvec3 p_from{0};  ///< the bracket's end in `from`
    glm::dvec3 p_to{0};    ///< the bracket's end in `to`
    Phase from, to;        ///< the phases before and after the crossing
    /// Of unit length, from `from` into `to`, at most 90° from the ray's direction: the gradient of the component of
    /// `from`, or minus that of `to` if the first does not point along the ray.
    glm::dvec3 normal{0};
};

/// Every crossing along some rays. Those of ray i have the indices offsets[i] to offsets[i + 1] − 1.
struct PreciseCrossings {
    std::vector<Phase> start;                ///< per ray, the phase in which it starts
    std::vector<std::size_t> offsets;        ///< one more than there are rays
    std::vector<PreciseCrossing> crossings;  ///< in the order of the rays, then along each ray
};

/// Traces rays from phase to phase through one object in double precision. Immutable; any thread may use it. Results do
/// not depend on the number of threads.
class PreciseTracer {
  public:
    /// `resolution`, in the scene's unit of length, is r above; 0 selects the default. It is clamped to at most a
    /// hundredth of the object's diagonal, then to at least 2 η.
    ///
    /// Throws ModelError if the object is empty or unbounded, or too far from the origin for its size.
    explicit PreciseTracer(const Phased& object, double resolution = 0);

    /// Find the first crossing along a ray. Returns nullopt if there is none, or if the ray is not finite or has a zero
    /// direction.
    std::optional<PreciseCrossing> first_crossing(const PreciseRay&) const;
    /// The same for many rays. `found` must be as long as `rays`. Uses the threads of TBB's arena. `cancelled` is
    /// polled by any thread. Returns false if `cancelled` returned true; some results are then not written.
    bool first_crossings(std::span<const PreciseRay> rays, std::span<std::optional<PreciseCrossing>> found,
                         const std::function<bool()>& cancelled = {}) const;
    /// Find all crossings along many rays. Throws std::bad_alloc if they do not fit into memory. Threads and
    /// `cancelled` are as for first_crossings(), but the result is nullopt if `cancelled` returned true.
    std::optional<PreciseCrossings> crossings(std::span<const PreciseRay> rays,
                                              const std::function<bool()>& cancelled = {}) const;

    const PreciseEvaluator& evaluator() const { return evaluator_; }
    /// A box around the object, with a margin of vacuum.
    const Bounds& bounds() const { return bounds_; }
    /// r above, in the scene's unit of length.
    double resolution() const { return resolution_; }
    /// η above, in the scene's unit of length.
    double value_error() const { return value_error_; }
    /// δ above, in the scene's unit of length; infinite if stretches are not enclosed.
    double enclosure_error() const { return enclosure_error_; }

  private:
    PreciseEvaluator evaluator_;
    Bounds bounds_;
    double resolution_ = 0;
    double value_error_ = 0;
    double enclosure_error_ = 0;
};

}  // namespace phasetree
