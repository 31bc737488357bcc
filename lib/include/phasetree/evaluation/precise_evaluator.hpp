// Evaluation of an object in double precision.
#pragma once

#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "phasetree/model/handle.hpp"

namespace phasetree {

namespace evaluation {
struct PreciseProgram;
}

/// What is known of an object at a point.
struct PreciseSample {
    /// The phase with the smallest component of Φ (its signed distance), the vacuum included; the lowest index if
    /// several are equal.
    Phase phase;
    /// The smallest component, at most 0 up to rounding errors.
    double own = 0;
    /// The second smallest component, s(p): within about this distance, the phase does not change.
    double interface_distance = 0;
};

/// An object near the interface of two of its phases. The interface is where f = (φ_inside − φ_outside) / 2 is zero.
struct InterfaceSample {
    double value = 0;        ///< f
    glm::dvec3 gradient{0};  ///< of f, by reverse-mode differentiation of the program

    // The primitive whose distance f depends on most.
    double weight = 0;               ///< the derivative of f with respect to that distance; 0 if f depends on none
    glm::dvec3 inner{0};             ///< the point in the primitive's own space
    glm::dmat3 inner_by_point{1.0};  ///< the Jacobian of `inner` with respect to the point of evaluation
};

/// Evaluates the components Φ of an object in double precision.
///
/// *What is evaluated.* The same recorded program as for floats: the equations of the nodes are templates over the
/// number type, and this is one more number type. The constants of the program (radii, matrices, weights, voxels) are
/// the same floats, exactly converted. So both precisions evaluate one function; they differ by the rounding errors of
/// floats. Sines, exponentials and angles are those of the standard library instead of polynomials for floats, and are
/// accurate to about the last bit of a double.
///
/// *Limits.* Meshes, balls, volumes and labels round a point to floats to search for the data near it, but evaluate
/// what they find in double precision. Their values may jump by a rounding error of floats where the search finds other
/// data. value_error() depends on whether an object has such nodes.
///
/// Immutable; any thread may use it. Results do not depend on the number of threads.
class PreciseEvaluator {
  public:
    /// Throws ModelError if the object's program is too long (see record()).
    explicit PreciseEvaluator(const Phased& object);

    /// Points with a coordinate that is not finite, or is beyond ±10¹⁰⁰, are in the vacuum; all distances are NaN
    /// there.
    PreciseSample sample(const glm::dvec3& p) const;
    Phase label(const glm::dvec3& p) const { return sample(p).phase; }
    /// A radius around a point within which the phase does not change: s(p), less allowances for lipschitz_excess() and
    /// for the error of values, which is the larger of value_error() and `error`. At least 0, and infinite if there is
    /// only one phase. Pass PreciseTracer::value_error() as `error` if the object is bounded: it is larger for objects
    /// with cones and a few other nodes, whose rounded constants are not exactly consistent with each other.
    double safe_distance(const glm::dvec3& p, double error = 0) const;
    /// The component of a phase; infinite if the object does not have the phase.
    double component(const glm::dvec3& p, Phase) const;
    /// Its gradient, by forward-mode differentiation; zero if the object does not have the phase.
    glm::dvec3 gradient(const glm::dvec3& p, Phase) const;
    /// The interface of two phases near a point. All members are NaN unless the object has both phases and the point is
    /// usable.
    InterfaceSample interface_sample(const glm::dvec3& p, Phase inside, Phase outside) const;

    /// The phases at many points. `phases` must be as long as `points`. Uses the threads of TBB's arena. `cancelled` is
    /// polled by any thread. Returns false if `cancelled` returned true; some phases are then not written.
    bool locate(std::span<const glm::dvec3> points, std::span<Phase> phases,
                const std::function<bool()>& cancelled = {}) const;
    /// The same for safe distances.
    bool safe_distances(std::span<const glm::dvec3> points, std::span<double> distances, double error = 0,
                        const std::function<bool()>& cancelled = {}) const;

    /// How far rounding may move a component, in the scene's unit, for points no farther from the origin than
    /// `farthest`: 2⁻⁴⁴ of that distance, or 2⁻²² of it for an object that searches in floats. An estimate with a large
    /// margin for programs of usual length, not a proof.
    double value_error(double farthest) const;
    /// By how much the slopes of components may exceed 1, because the constants of nodes (unit vectors, matrices,
    /// factors) are rounded to floats.
    double lipschitz_excess() const;

    const evaluation::PreciseProgram& program() const { return *program_; }

  private:
    std::shared_ptr<const evaluation::PreciseProgram> program_;
};

}  // namespace phasetree
