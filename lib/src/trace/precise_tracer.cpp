#include "phasetree/trace/precise_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "evaluation/in_blocks.hpp"
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
        for (std::size_t i = begin; i < end; ++i) found[i] = PreciseMarch(*this, rays[i]).next();
    });
}

std::optional<PreciseCrossings> PreciseTracer::crossings(std::span<const PreciseRay> rays,
                                                         const std::function<bool()>& cancelled) const {
    PreciseCrossings all;
    all.start.resize(rays.size());
    all.offsets.resize(rays.size() + 1);
    std::vector<std::vector<PreciseCrossing>> blocks((rays.size() + precise_rays - 1) / precise_rays);
    const bool is_complete = in_blocks(rays.size(), precise_rays, cancelled, [&](std::size_t begin, std::size_t end) {
        std::vector<PreciseCrossing>& found = blocks[begin / precise_rays];
        for (std::size_t i = begin; i < end; ++i) {
            PreciseMarch march(*this, rays[i]);
            all.start[i] = march.phase();
            const std::size_t before = found.size();
            while (const auto c = march.next()) found.push_back(*c);
            all.offsets[i + 1] = found.size() - before;
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
