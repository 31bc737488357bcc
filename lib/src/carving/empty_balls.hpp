// Proves regions empty from a field's values alone: around a point where a 1-Lipschitz field is r > 0, a ball of radius
// r contains nothing of the solid {f ≤ 0}.
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "evaluation/batch_of_points.hpp"
#include "phasetree/carving/carve.hpp"
#include "phasetree/evaluation/evaluator.hpp"

namespace phasetree::carving {

/// A ball that is proven empty. The coordinates of its centre are exact in floats. If the radius is not positive,
/// nothing is known about the centre, except that it belongs to the solid if `is_solid` is set.
struct Ball {
    glm::dvec3 centre{0};
    double radius = 0;
    bool is_solid = false;
};
using BallBatch = std::array<Ball, batch_size>;

/// Evaluates a field at eight points at a time, and counts the evaluations.
class EmptyBalls {
  public:
    EmptyBalls(const Field& field, const Bounds& box, const CarveOptions& options)
        : evaluator_(record(field)), options_(options) {
        for (int i = 0; i < 3; ++i)
            farthest_ = std::max(
                {farthest_, std::abs(static_cast<double>(box.low[i])), std::abs(static_cast<double>(box.high[i]))});
    }

    /// The balls around one to eight points. The last point also fills the remaining entries.
    BallBatch at(std::span<const glm::dvec3> points) {
        if (options_.cancelled && evaluations_ % 64 == 0 && options_.cancelled()) throw CarvingCancelled();
        std::array<glm::vec3, batch_size> rounded;
        for (std::size_t i = 0; i < points.size(); ++i) rounded[i] = glm::vec3(points[i]);
        const auto [x, y, z] = evaluation::BatchOfPoints::of(std::span(rounded).first(points.size()));
        std::array<BatchOfFloats, 2> phi;
        evaluator_.evaluate(x, y, z, phi, workspace_);
        ++evaluations_;
        BallBatch balls;
        for (std::size_t i = 0; i < batch_size; ++i) {
            const glm::dvec3 p(x[i], y[i], z[i]);
            const double f = phi[1][i];
            balls[i] = {p, f - rounding_error_at(p), f <= 0};
            if (!std::isfinite(f)) balls[i] = {p, 0, false};
        }
        return balls;
    }
    /// The direction in which the field grows; not normalised.
    glm::dvec3 gradient(const glm::dvec3& p) const { return glm::dvec3(evaluator_.gradient(glm::vec3(p), Phase{1})); }

    std::size_t evaluations() const { return evaluations_; }

  private:
    /// An upper bound on the error of a value at p. As for traced values (src/trace/prepare.cpp), it is 10⁻⁶ of the
    /// farthest coordinate on which the value may depend.
    double rounding_error_at(const glm::dvec3& p) const {
        return 1e-6 * std::max({farthest_, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }

    Evaluator evaluator_;
    const CarveOptions& options_;
    Evaluator::Workspace workspace_;
    double farthest_ = 0;
    std::size_t evaluations_ = 0;
};

}  // namespace phasetree::carving
