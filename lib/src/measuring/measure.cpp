// The bounds are first divided into parts. Then each part is divided by itself, depth first, until the doubt in each
// box is below a threshold. (The doubt of a phase is the volume that may or may not belong to it.) If volumes are not
// precise enough, the threshold is lowered, and all parts are divided again from the beginning. All earlier divisions
// together take less time than the last one, and memory is needed only for one path of boxes per thread.
//
// The sums of a part are added in the order of its division, and those of the parts in the order of the parts, so they
// do not depend on threads.
#include "phasetree/measuring/measure.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "measuring/body.hpp"
#include "measuring/part_division.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/trace/tracer.hpp"
#include "rewriting/rewrite.hpp"

namespace phasetree {

using building::CellBudget, building::WorkerPool;
using rewriting::ArenaScope, rewriting::rewrite;

namespace measuring {

namespace {

// The bounds are divided into at least this many parts in doubt, unless there are fewer after this number of levels.
constexpr std::size_t enough_parts = 256;
constexpr int most_levels_of_parts = 4;
// A volume is compared with the tolerance as if it were at least this fraction of the object's.
constexpr double least_share = 1e-3;

class Measurement {
  public:
    Measurement(const Phased& object, const MeasureOptions& options, const TraceableObject& traceable)
        : options_(options),
          stop_(options),
          reporter_(options.progress),
          recorded_(record(object)),
          root_{traceable.bounds, rewrite(recorded_, arena_)},
          context_{ProgramContext(root_.program, recorded_.constants, PhaseSet(), 0.5f * traceable.resolution),
                   origin_of(traceable.bounds), traceable.resolution},
          budget_(std::numeric_limits<std::size_t>::max()),
          pool_(budget_, recorded_.constants),
          worker_{pool_},
          known_(PhaseSet{phases(object).bits | 1}),
          total_(known_) {}

    MeasureResult run() {
        make_parts();
        add_up();
        const double first_progress = progress_of_doubt();
        const MeasureEnd end = divide_parts(first_progress);
        reporter_.finish();
        return result(end);
    }

  private:
    static std::array<double, 3> origin_of(const Bounds& bounds) {
        const glm::dvec3 centre(bounds.centre());
        return {centre.x, centre.y, centre.z};
    }

    // Divides the bounds level by level. Boxes in one phase are added at once; the others become parts.
    void make_parts() {
        const FlushSubnormals flush;
        std::vector<ExaminedBox> boxes, level;
        divide_into(root_, boxes);
        for (int depth = 1; depth < most_levels_of_parts && boxes.size() < enough_parts; ++depth) {
            level.swap(boxes);
            boxes.clear();
            for (const ExaminedBox& b : level) {
                if (b.can_be_divided && !stop_())
                    divide_into(b.node, boxes);
                else
                    parts_.push_back({b, ObjectSums(known_.phases())});
            }
        }
        for (const ExaminedBox& b : boxes) parts_.push_back({b, ObjectSums(known_.phases())});
        for (Part& part : parts_) {
            part.sums.add(part.box, context_);
            part.is_coarse = part.box.can_be_divided;
        }
    }

    // Divides one box, and appends the boxes in it that are not in one phase.
    void divide_into(const Node& node, std::vector<ExaminedBox>& boxes) {
        const ArenaScope scratch(worker_.scratch);
        const Division division(node, context_, worker_);
        for (std::size_t i = 0; i < division.count(); ++i) {
            ++boxes_;
            const ExaminedBox box = division.examine(i);
            if (box.only)
                known_.add(box, context_);
            else
                boxes.push_back(box);
        }
    }
    void add_up() {
        total_ = known_;
        for (const Part& part : parts_) total_.add(part.sums);
    }
    // The largest allowed width of the interval of a phase's volume. The volume may be as small as the interval's low
    // end, so that is what the width is compared with.
    double allowed(Phase p) const {
        double object = 0;
        for_each_phase(total_.phases().bits & ~PhaseSet::of(vacuum).bits,
                       [&](int i) { object += total_[Phase{static_cast<std::uint8_t>(i)}].estimate[0]; });
        return options_.tolerance * std::max(total_[p].low[0], least_share * object);
    }
    // Calls f(phase) for each phase but the vacuum.
    template <class F>
    void for_each_solid(F&& f) const {
        for_each_phase(total_.phases().bits & ~PhaseSet::of(vacuum).bits,
                       [&](int i) { f(Phase{static_cast<std::uint8_t>(i)}); });
    }
    double width(Phase p) const {
        const MomentBounds m(total_[p], total_.additions());
        return m.high[0] - m.low[0];
    }
    bool must_be_precise(Phase p) const {
        return !options_.precise_phases || options_.precise_phases->contains(p.index);
    }
    bool is_precise(Phase p) const { return !must_be_precise(p) || width(p) <= allowed(p); }
    // Whether the doubt that smaller boxes cannot reduce is most of the total, and by itself exceeds the tolerance.
    bool is_at_end(Phase p) const {
        const double final_doubt = total_[p].final_doubt;
        return final_doubt > allowed(p) && width(p) < 1.5 * final_doubt;
    }

    // How far the doubt has fallen, on a logarithmic scale, relative to what is requested.
    double progress_of_doubt() const {
        double least = 1;
        const double all = static_cast<double>(root_.box.extent().x) * static_cast<double>(root_.box.extent().y) *
                           static_cast<double>(root_.box.extent().z);
        for_each_solid([&](Phase p) {
            const double target = std::max(allowed(p), 1e-12 * all);
            if (must_be_precise(p) && width(p) > target)
                least = std::min(least, std::log(all / width(p)) / std::log(all / target));
        });
        return std::clamp(least, 0.0, 1.0);
    }

    // Lowers the thresholds of phases that are not yet precise. Where components are nearly linear, the doubt in a box
    // falls with the fourth power of its size, and the doubt in all of them with the second. So the total falls with
    // the square root of the threshold.
    void lower_thresholds() {
        for_each_solid([&](Phase p) {
            double& threshold = thresholds_[p.index];
            if (threshold == 0)
                for (const Part& part : parts_) threshold = std::max(threshold, part.sums[p].doubt());
            if (is_precise(p) || is_at_end(p)) return;
            const double needed = 0.7 * allowed(p) / width(p);
            threshold *= std::clamp(needed * needed, 1.0 / 64, 1.0 / 4);
        });
    }

    MeasureEnd divide_parts(double progress) {
        const std::size_t left = options_.max_boxes - std::min(options_.max_boxes, boxes_);
        const std::size_t most_of_part = std::max<std::size_t>(1, left / std::max<std::size_t>(1, parts_.size()));
        // Each pass lowers thresholds at least fourfold, so after these they are below any volume that matters.
        constexpr int most_passes = 40;
        for (int pass = 0; pass < most_passes; ++pass) {
            bool are_precise = true, are_done = true;
            for_each_solid([&](Phase p) {
                are_precise = are_precise && is_precise(p);
                are_done = are_done && (is_precise(p) || is_at_end(p));
            });
            if (are_done) return are_precise ? MeasureEnd::tolerance : MeasureEnd::precision;
            if (options_.is_enough && options_.is_enough(result(MeasureEnd::enough))) return MeasureEnd::enough;
            const auto is_open = [](const Part& p) { return p.is_coarse && !p.is_full; };
            if (std::ranges::none_of(parts_, is_open))
                return std::ranges::any_of(parts_, &Part::is_full) ? MeasureEnd::boxes : MeasureEnd::precision;
            lower_thresholds();
            const double next_progress = std::min(1.0, progress + 0.5 * (1 - progress));
            if (!divide_once(most_of_part, progress, next_progress)) {
                add_up();
                return stop_.end();
            }
            add_up();
            progress = std::max(progress, progress_of_doubt());
        }
        return MeasureEnd::precision;
    }
    // Returns false if it was stopped. Unfinished parts keep their previous results.
    bool divide_once(std::size_t most_of_part, double from, double to) {
        std::atomic<std::size_t> done{0};
        std::atomic<bool> is_stopped{false};
        tbb::parallel_for(std::size_t{0}, parts_.size(), [&](std::size_t i) {
            Part& part = parts_[i];
            if (!part.is_coarse || part.is_full) return;
            if (stop_()) {
                is_stopped = true;
                return;
            }
            const FlushSubnormals flush;
            const WorkerPool::Borrowed worker = pool_.borrow();
            Part next{part.box, ObjectSums(known_.phases()), 1, false, false};
            try {
                PartDivision(context_, thresholds_, most_of_part, stop_, *worker, next).run(part.box);
            } catch (const PartDivision::Stopped&) {
                is_stopped = true;
                return;
            }
            if (next.is_full) {
                // The boxes ran out: the part was divided finely where the division began, and coarsely where it ended.
                part.is_full = true;
                if (!is_better(next.sums, part.sums)) return;
            }
            part = std::move(next);
            const double share = static_cast<double>(++done) / static_cast<double>(parts_.size());
            reporter_.tell(std::max(from + share * (to - from), stop_.share_of_time()));
        });
        return !is_stopped;
    }
    static bool is_better(const ObjectSums& a, const ObjectSums& b) {
        double of_a = 0, of_b = 0;
        for_each_phase(a.phases().bits, [&](int i) {
            of_a += a[Phase{static_cast<std::uint8_t>(i)}].doubt();
            of_b += b[Phase{static_cast<std::uint8_t>(i)}].doubt();
        });
        return of_a < of_b;
    }

    Measured side(double a, double b, int axis) const {
        const double size = static_cast<double>(root_.box.extent()[axis]), error = 1e-12 * size;
        const double origin = context_.origin[static_cast<std::size_t>(axis)];
        const double margin = error + 1e-15 * std::abs(origin);
        const double low = std::min(a, b) + origin - margin, high = std::max(a, b) + origin + margin;
        return measured(low, high, std::isfinite(low) && std::isfinite(high) ? 0.5 * (low + high) : 0);
    }
    // The centre of mass is in every box around the body.
    static void move_centre_into(Body& body, std::size_t axis, double low, double high) {
        Measured& centre = body.centre[axis];
        if (!(body.mass.low > 0) || !(std::max(centre.low, low) <= std::min(centre.high, high))) return;
        centre = measured(std::max(centre.low, low), std::min(centre.high, high), centre.estimate);
    }
    MeasureResult result(MeasureEnd end) const {
        MeasureResult r;
        r.bounds = root_.box;
        r.end = end;
        r.boxes = boxes_;
        for (const Part& part : parts_) r.boxes += part.boxes;
        MomentBounds all;
        double volume_low = 0, volume_high = 0, volume = 0;
        constexpr double infinity = std::numeric_limits<double>::infinity();
        std::array<double, 3> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
        for_each_solid([&](Phase p) {
            const PhaseSums& sums = total_[p];
            const MomentBounds moments(sums, total_.additions());
            MeasuredPhase found;
            found.phase = p;
            for (const auto& [phase, density] : options_.densities)
                if (phase == p) {
                    found.has_density = true;
                    found.density = density;
                }
            MomentBounds mass;
            mass.add(moments, found.density);
            const Measured v = measured(moments.low[0], moments.high[0], moments.estimate[0]);
            found.body = body_of(v, mass, context_.origin);
            for (int i = 0; i < 3; ++i) {
                const auto k = static_cast<std::size_t>(i);
                found.box_low[k] = side(sums.outer_low[k], sums.inner_low[k], i);
                found.box_high[k] = side(sums.inner_high[k], sums.outer_high[k], i);
                move_centre_into(found.body, k, found.box_low[k].low, found.box_high[k].high);
                if (found.has_density && found.density > 0) {
                    low[k] = std::min(low[k], found.box_low[k].low);
                    high[k] = std::max(high[k], found.box_high[k].high);
                }
            }
            r.phases.push_back(found);
            if (!found.has_density) return;
            all.add(mass, 1);
            volume_low += v.low;
            volume_high += v.high;
            volume += v.estimate;
        });
        const MomentBounds vacuum_moments(total_[vacuum], total_.additions());
        r.vacuum = measured(vacuum_moments.low[0], vacuum_moments.high[0], vacuum_moments.estimate[0]);
        if (!options_.densities.empty())
            r.all =
                body_of(measured(volume_low * (1 - 1e-14), volume_high * (1 + 1e-14), volume), all, context_.origin);
        for (std::size_t k = 0; r.all && k < 3; ++k) move_centre_into(*r.all, k, low[k], high[k]);
        return r;
    }

    const MeasureOptions& options_;
    Stop stop_;
    Reporter reporter_;
    Program recorded_;
    rewriting::Arena arena_;
    Node root_;
    MeasureContext context_;
    CellBudget budget_;
    WorkerPool pool_;
    Worker worker_;     // of the boxes of the parts
    ObjectSums known_;  // boxes that are not in a part
    std::vector<Part> parts_;
    ObjectSums total_;
    Thresholds thresholds_{};
    std::size_t boxes_ = 0;  // that are not in a part
};

void check(const Phased& object, const MeasureOptions& options) {
    if (!(options.tolerance > 0 && std::isfinite(options.tolerance)))
        throw ModelError(
            fmt::format("the tolerance must be a positive number, such as 0.001, but is {}", options.tolerance));
    if (!(options.seconds > 0))
        throw ModelError(fmt::format("the time must be a positive number of seconds, but is {}", options.seconds));
    const PhaseSet there = phases(object);
    for (const auto& [phase, density] : options.densities) {
        if (phase == vacuum) throw ModelError("the vacuum has no density");
        if (phase.index >= Phase::capacity || !there.contains(phase))
            throw ModelError(fmt::format("the object has no phase {}, so it needs no density", phase.index));
        if (!(density >= 0 && std::isfinite(density)))
            throw ModelError(fmt::format("the density of phase {} must not be negative or infinite, but is {}",
                                         phase.index, density));
    }
}

}  // namespace

}  // namespace measuring

std::string_view name_of(MeasureEnd end) {
    switch (end) {
        case MeasureEnd::tolerance:
            return "tolerance";
        case MeasureEnd::precision:
            return "precision";
        case MeasureEnd::seconds:
            return "time";
        case MeasureEnd::boxes:
            return "boxes";
        case MeasureEnd::cancelled:
            return "interrupted";
        case MeasureEnd::enough:
            return "enough";
    }
    return "";
}

MeasureResult measure(const Phased& object, const MeasureOptions& options) {
    measuring::check(object, options);
    return measuring::Measurement(object, options, prepare_to_trace(object)).run();
}

}  // namespace phasetree
