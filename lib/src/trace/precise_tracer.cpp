#include "phasetree/trace/precise_tracer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "evaluation/in_blocks.hpp"
#include "phasetree/program/batch.hpp"
#include "phasetree/trace/tracer.hpp"
#include "phasetree_support/split_mix64.hpp"
#include "trace/precise_march.hpp"

namespace phasetree {

using evaluation::in_blocks, evaluation::PreciseProgram;
using trace::PreciseMarch;

namespace {

// The number of rays in a block that one thread traces: few, because a single ray may take long.
constexpr std::size_t precise_rays = 64;
// The default resolution, as a fraction of the diagonal. Objects with nodes that search in single precision
// (PreciseProgram::searches_in_floats) get the fraction that the single-precision tracer uses near the origin.
constexpr double fine = 0x1p-30, fine_in_floats = 2e-6;
// The finest resolution, as a multiple of value_error(), and the coarsest, as a fraction of the diagonal.
constexpr double min_resolution_over_error = 2, max_resolution_over_diagonal = 0.01;
// value_error() and the error of enclosures, as multiples of the largest measured difference between an enclosure's
// centre and the value in double precision.
constexpr double value_error_over_difference = 4, enclosure_error_over_difference = 2;

// The largest difference, over 16 random points and every value that the program computes, between the centre of its
// enclosure at that point and the value in double precision; infinity if the two cannot be compared.
double measured_difference(const PreciseProgram& program, const Bounds& bounds) {
    // Programs that take long to compare take long to enclose along rays, too.
    constexpr std::size_t longest = 20'000;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (program.program.instructions.size() > longest) return infinity;
    const FlushSubnormals flush;
    support::SplitMix64 random(1);
    double most = 0;
    for (int k = 0; k < 16; ++k) {
        glm::dvec3 p;
        for (int i = 0; i < 3; ++i)
            p[i] = double{bounds.low[i]} + static_cast<double>(random() >> 11) * 0x1p-53 * double{bounds.extent()[i]};
        const std::vector<double> values = evaluation::values_at(program, p);
        const std::vector<double> centres = trace::centres_at(program.routine(), p);
        if (values.size() != centres.size()) return infinity;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double difference = std::abs(values[i] - centres[i]);
            if (!(difference <= most)) most = difference == difference ? difference : infinity;
        }
    }
    return most;
}

// Traces rays `begin` to `end` in one thread, as many at a time as a batch of samples has lanes. Calls started(ray,
// phase) with the phase in which a ray starts, and crossed(ray, crossing) with each of its crossings, or nullopt at its
// end. A ray continues while `crossed` returns true.
template <class Started, class Crossed>
void march_together(const PreciseTracer& tracer, std::span<const PreciseRay> rays, std::size_t begin, std::size_t end,
                    Started&& started, Crossed&& crossed) {
    std::array<std::optional<PreciseMarch>, batch_size> marches;  // a march cannot be moved
    std::array<std::size_t, batch_size> ray_of{}, slots{};        // the first `active` slots are in use
    std::array<evaluation::SampleQuery, batch_size> queries;
    std::size_t active = 0, next = begin;
    std::iota(slots.begin(), slots.end(), std::size_t{0});
    // Starts the next ray that does not end at once. Returns false if there is none.
    const auto start_in = [&](std::size_t slot) {
        for (; next < end; ++next) {
            marches[slot].emplace(tracer, rays[next]);
            started(next, marches[slot]->phase());
            marches[slot]->begin();
            if (marches[slot]->request()) {
                ray_of[slot] = next++;
                return true;
            }
            crossed(next, std::nullopt);
        }
        return false;
    };
    // Continues the ray of a slot, or starts another one. Returns false if there is none.
    const auto go_on_in = [&](std::size_t slot) {
        PreciseMarch& march = *marches[slot];
        while (!march.request()) {
            if (!crossed(ray_of[slot], march.found()) || !march.found()) return start_in(slot);
            march.begin();
        }
        return true;
    };
    while (active < batch_size && start_in(active)) ++active;
    while (active > 0) {
        for (std::size_t k = 0; k < active; ++k) {
            const PreciseMarch::Request& request = *marches[slots[k]]->request();
            queries[k].point = request.point;
            queries[k].carried = request.carried;
        }
        evaluation::answer(tracer.evaluator().program(), std::span(queries).first(active));
        for (std::size_t k = active; k-- > 0;) {
            marches[slots[k]]->take(queries[k].result);
            if (!go_on_in(slots[k])) std::swap(slots[k], slots[--active]);
        }
    }
}

}  // namespace

PreciseTracer::PreciseTracer(const Phased& object, double resolution)
    : evaluator_(object), bounds_(prepare_to_trace(object).bounds) {
    const double diagonal = double{bounds_.diagonal()};
    value_error_ = evaluator_.value_error(trace::farthest_coordinate_of(bounds_));
    const PreciseProgram& program = evaluator_.program();
    const double difference = measured_difference(program, bounds_);
    if (!(difference < 0.01 * diagonal)) {
        enclosure_error_ = std::numeric_limits<double>::infinity();
    } else if (value_error_over_difference * difference > value_error_) {
        value_error_ = value_error_over_difference * difference;
        enclosure_error_ = enclosure_error_over_difference * difference;
    }
    const double chosen = resolution > 0 ? resolution : (program.searches_in_floats ? fine_in_floats : fine) * diagonal;
    resolution_ =
        std::max(std::min(chosen, max_resolution_over_diagonal * diagonal), min_resolution_over_error * value_error_);
}

std::optional<PreciseCrossing> PreciseTracer::first_crossing(const PreciseRay& ray) const {
    const FlushSubnormals flush;
    return PreciseMarch(*this, ray).next();
}

bool PreciseTracer::first_crossings(std::span<const PreciseRay> rays, std::span<std::optional<PreciseCrossing>> found,
                                    const std::function<bool()>& cancelled) const {
    if (found.size() != rays.size()) throw std::invalid_argument("there must be as many results as rays");
    return in_blocks(rays.size(), precise_rays, cancelled, [&](std::size_t begin, std::size_t end) {
        march_together(
            *this, rays, begin, end, [](std::size_t, Phase) {},
            [&](std::size_t ray, const std::optional<PreciseCrossing>& c) {
                found[ray] = c;
                return false;
            });
    });
}

std::optional<PreciseCrossings> PreciseTracer::crossings(std::span<const PreciseRay> rays,
                                                         const std::function<bool()>& cancelled) const {
    PreciseCrossings all;
    all.start.resize(rays.size());
    all.offsets.resize(rays.size() + 1);
    std::vector<std::vector<PreciseCrossing>> blocks((rays.size() + precise_rays - 1) / precise_rays);
    const bool is_complete = in_blocks(rays.size(), precise_rays, cancelled, [&](std::size_t begin, std::size_t end) {
        std::vector<std::vector<PreciseCrossing>> found(end - begin);
        march_together(
            *this, rays, begin, end, [&](std::size_t ray, Phase phase) { all.start[ray] = phase; },
            [&](std::size_t ray, const std::optional<PreciseCrossing>& c) {
                if (c) found[ray - begin].push_back(*c);
                return c.has_value();
            });
        std::vector<PreciseCrossing>& block = blocks[begin / precise_rays];
        for (std::size_t i = begin; i < end; ++i) {
            block.insert(block.end(), found[i - begin].begin(), found[i - begin].end());
            all.offsets[i + 1] = found[i - begin].size();
        }
    });
    if (!is_complete) return std::nullopt;
    for (std::size_t i = 0; i < rays.size(); ++i) all.offsets[i + 1] += all.offsets[i];
    all.crossings.reserve(all.offsets.back());
    for (std::vector<PreciseCrossing>& block : blocks) {
        all.crossings.insert(all.crossings.end(), block.begin(), block.end());
        block = {};
    }
    return all;
}

}  // namespace phasetree
