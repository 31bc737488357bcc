#pragma once

#include <utility>

#include "evaluation/precise_program.hpp"
#include "phasetree/trace/precise_tracer.hpp"
#include "trace/component_along_ray.hpp"

namespace phasetree::trace {

using evaluation::CarriedSample;

double farthest_coordinate_of(const Bounds&);

/// The search for crossings along one ray, in double precision: see the top of phasetree/trace/precise_tracer.hpp. The
/// tracer must outlive it.
class PreciseMarch {
  public:
    PreciseMarch(const PreciseTracer&, const PreciseRay&);

    /// The phase that the ray is in after the last crossing; at first, the one in which it starts.
    Phase phase() const { return carried_; }
    /// The next crossing; nullopt after the last one.
    std::optional<PreciseCrossing> next();

  private:
    // A sample at a distance t from the start of the search.
    struct Sample : CarriedSample {
        double t = 0;
        Phase carried;

        bool has_carried_label() const { return phase == carried; }
    };

    glm::dvec3 point(double t) const { return start_ + t * direction_; }
    Sample at(double t) const;
    bool is_in(const Sample& s) const { return s.has_carried_label() || s.component <= value_error_; }
    double step_from(const Sample&) const;
    Sample step_surely(const Sample&, double step) const;
    void count_slow_steps(double step);
    bool pass_enclosed(Sample&);
    PreciseCrossing crossing_between(const Sample& low, Sample high);
    std::pair<Sample, Sample> begin_of_label(Sample low, Sample high) const;
    PreciseCrossing report_crossing(const Sample& in, const Sample& out);
    glm::dvec3 normal(double t_from, double t_to, Phase to) const;

    const PreciseTracer& tracer_;
    const kernel::Routine routine_;
    const double resolution_, value_error_;
    double finest_ = 0;  // bracketing stops at this length
    // The ray, restarted where the search begins, a distance `skipped_` past its origin. The direction is of unit
    // length.
    glm::dvec3 start_{0}, direction_{0};
    double skipped_ = 0;
    double length_ = 1;  // of the caller's direction, which is the unit of reported distances
    Phase carried_;
    double t_ = 0, end_ = -1;
    std::optional<Sample> labelled_;  // the last sample that is labelled with the carried phase
    double slope_ = -1;               // of the interface distance along the last step, clamped to [−1, 0.9]
    std::optional<ComponentAlongRay> component_;  // of the phase `component_of_`
    Phase component_of_;
    std::size_t samples_ = 0, wait_ = 0, slow_steps_ = 0;
    double shortest_ = 0;  // the length of a step in doubt
};

}  // namespace phasetree::trace
