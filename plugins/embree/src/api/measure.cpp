// Volumes, masses and moments of trees.
#include "phasetree/embree/measure.h"

#include "api/measured.hpp"
#include "api/tree_data.hpp"
#include "phasetree/measuring/measure.hpp"
#include "phasetree/trace/tracer.hpp"

namespace phasetree::embree::api {

namespace {

static_assert(static_cast<int>(MeasureEnd::tolerance) == PHASETREE_MEASURE_END_TOLERANCE);
static_assert(static_cast<int>(MeasureEnd::precision) == PHASETREE_MEASURE_END_PRECISION);
static_assert(static_cast<int>(MeasureEnd::seconds) == PHASETREE_MEASURE_END_SECONDS);
static_assert(static_cast<int>(MeasureEnd::boxes) == PHASETREE_MEASURE_END_BOXES);
static_assert(static_cast<int>(MeasureEnd::cancelled) == PHASETREE_MEASURE_END_CANCELLED);

MeasureOptions checked(const PhasetreeMeasureOptions* given, const SceneTree& tree) {
    PhasetreeMeasureOptions o;
    phasetreeInitMeasureOptions(&o);
    if (given) o = *given;
    MeasureOptions options;
    options.tolerance = o.tolerance;
    options.seconds = o.seconds;
    options.max_boxes = o.maxBoxes;
    const PhaseSet used = phases(tree.object);
    for (std::size_t i = 1; o.densities && i < tree.phases.names.size(); ++i) {
        if (std::isnan(o.densities[i])) continue;
        if (!(o.densities[i] >= 0 && std::isfinite(o.densities[i])))
            throw invalid("options->densities[{}] is {}; it must be NaN or a finite number that is not negative", i,
                          o.densities[i]);
        const Phase phase{static_cast<std::uint8_t>(i)};
        if (used.contains(phase)) options.densities.emplace_back(phase, o.densities[i]);
    }
    if (o.cancelled) options.cancelled = [o] { return o.cancelled(o.cancelledUserPtr); };
    if (o.progress) options.progress = [o](float done) { o.progress(o.progressUserPtr, static_cast<double>(done)); };
    return options;
}

PhasetreeBody body_of(const Body& body) {
    PhasetreeBody to;
    to.volume = returned(body.volume);
    to.mass = returned(body.mass);
    for (std::size_t i = 0; i < 3; ++i) to.centre[i] = returned(body.centre[i]);
    constexpr std::size_t row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
    for (std::size_t i = 0; i < 6; ++i) to.inertia[i] = returned(body.inertia[row[i]][column[i]]);
    return to;
}

// Of a phase of which nothing is known but its volume.
PhasetreeMeasuredPhase of_volume(const Measured& volume) {
    Body body;
    body.volume = body.mass = volume;
    PhasetreeMeasuredPhase to;
    to.body = body_of(body);
    for (std::size_t i = 0; i < 3; ++i) to.boxLow[i] = to.boxHigh[i] = returned(Measured());
    return to;
}

}  // namespace

}  // namespace phasetree::embree::api

using namespace phasetree;
using namespace phasetree::embree::api;

PhasetreeError phasetreeMeasureTree(PhasetreeTree tree, const PhasetreeMeasureOptions* options,
                                    PhasetreeMeasuredPhase* phases, PhasetreeBody* all, PhasetreeMeasureEnd* end) {
    return guarded_call(__func__, [&] {
        const TreeData& data = data_of(tree);
        require(phases, "phases");
        const MeasureOptions with = checked(options, data.tree);
        (void)prepare_to_trace(data.tree.object);  // so that other errors are those of options
        const MeasureResult result = as_argument([&] { return measure(data.tree.object, with); });
        phases[0] = of_volume(result.vacuum);
        for (std::size_t i = 1; i < data.tree.phases.names.size(); ++i) phases[i] = of_volume({0, 0, 0});
        for (const MeasuredPhase& p : result.phases) {
            PhasetreeMeasuredPhase& to = phases[p.phase.index];
            to.body = body_of(p.body);
            for (std::size_t i = 0; i < 3; ++i) {
                to.boxLow[i] = returned(p.box_low[i]);
                to.boxHigh[i] = returned(p.box_high[i]);
            }
        }
        if (all) *all = result.all ? body_of(*result.all) : PhasetreeBody{};
        if (end) *end = static_cast<PhasetreeMeasureEnd>(result.end);
    });
}
