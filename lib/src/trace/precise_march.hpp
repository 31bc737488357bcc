#pragma once

#include <optional>

#include "evaluation/precise_program.hpp"
#include "phasetree/trace/precise_tracer.hpp"
#include "trace/component_along_ray.hpp"

namespace phasetree::trace {

using evaluation::CarriedSample;

double farthest_coordinate_of(const Bounds&);

/// The search for crossings along one ray, in double precision: see the top of phasetree/trace/precise_tracer.hpp. The
/// tracer must outlive it.
///
/// The search is a state machine that requests one sample at a time, so that the samples of several rays can be
/// computed together:
///
///     march.begin();
///     while (const PreciseMarch::Request* request = march.request()) march.take(sample of *request);
///     march.found();
class PreciseMarch {
  public:
    /// A point of the ray, and the phase that the ray is in.
    struct Request {
        glm::dvec3 point;
        Phase carried;
    };

    PreciseMarch(const PreciseTracer&, const PreciseRay&);

    /// The phase that the ray is in after the last crossing; at first, the one in which it starts.
    Phase phase() const { return carried_; }
    /// Begins the search for the next crossing.
    void begin();
    /// The sample that the search needs next; null if it has ended.
    const Request* request() const { return stage_ == Stage::ended ? nullptr : &request_; }
    void take(const CarriedSample&);
    /// The crossing, after the search has ended; nullopt after the last one.
    const std::optional<PreciseCrossing>& found() const { return found_; }
    /// Does all of the above for a single ray.
    std::optional<PreciseCrossing> next();

  private:
    // A sample at a distance t from the start of the search.
    struct Sample : CarriedSample {
        double t = 0;
        Phase carried;

        bool has_carried_label() const { return phase == carried; }
    };
    // What the requested sample is: the start of the search, the end of enclosed stretches, the end of a step that is
    // longer than the safe one, the end of any other step, or one of a bisection.
    enum class Stage : unsigned char { start, stretch, long_step, step, bisection, ended };

    glm::dvec3 point(double t) const { return start_ + t * direction_; }
    bool is_in(const Sample& s) const { return s.has_carried_label() || s.component <= value_error_; }
    double step_from(const Sample&) const;
    void ask(Stage, double t);
    void end_search();
    void start_from(const Sample&);
    void go_on();
    void take_step();
    void arrive(const Sample&);
    void count_slow_steps(double step);
    bool enclose_stretches();
    void bracket(const Sample& low, const Sample& high);
    void bisect();
    void report_crossing(const Sample& in, const Sample& out);
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

    Stage stage_ = Stage::ended;
    Request request_{};
    double requested_t_ = 0;
    std::optional<PreciseCrossing> found_;

    Sample at_;                       // the last sample of the search
    std::optional<Sample> labelled_;  // the last sample that is labelled with the carried phase
    double slope_ = -1;               // of the interface distance along the last step, clamped to [−1, 0.9]
    double step_ = 0;                 // the safe length of the current step
    std::optional<ComponentAlongRay> component_;  // of the phase `component_of_`
    Phase component_of_;
    std::size_t samples_ = 0, wait_ = 0, slow_steps_ = 0;
    double shortest_ = 0;  // the length of a step in doubt

    // Bisection: the bracket, its lower end at first, the phase of its upper end, the number of samples taken, and
    // whether the last of them replaced the lower end.
    Sample low_, high_, lowest_;
    Phase sought_;
    int bisections_ = 0;
    bool was_low_ = false;
};

}  // namespace phasetree::trace
