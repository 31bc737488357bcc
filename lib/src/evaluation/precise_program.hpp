#pragma once

#include <span>

#include "evaluation/assemble.hpp"
#include "phasetree/evaluation/precise_evaluator.hpp"

namespace phasetree::evaluation {

/// A program that is ready to run in double precision.
struct PreciseProgram {
    Program program;
    Assembly assembly;
    bool searches_in_floats = false;
    bool runs_in_batches = false;  ///< whether batches of points can be run together (kernel/precise_kernel.hpp)
    double lipschitz_excess = 0;

    Routine routine() const { return assembly.routine(program.constants.data()); }
};

/// What is known of an object at a point, for a ray in the phase `carried`.
struct CarriedSample : PreciseSample {
    double component = 0;  ///< of the carried phase; infinite if it is absent
};
CarriedSample sample_for(const PreciseProgram&, const glm::dvec3& p, Phase carried);

/// The same for at most eight points, with the same results, bit for bit.
struct SampleQuery {
    glm::dvec3 point;
    Phase carried;
    CarriedSample result;
};
void answer(const PreciseProgram&, std::span<SampleQuery>);

/// The numbers that the steps of a program compute at a point: in the order of the steps, the coordinates of a point as
/// three numbers.
std::vector<double> values_at(const PreciseProgram&, const glm::dvec3& p);

}  // namespace phasetree::evaluation
