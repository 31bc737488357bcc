// From a tree to cells: recording, the first division of the bounds (where the program is longest, so mostly pruning),
// and all of it, on as many threads as TBB takes.
#include <benchmark/benchmark.h>

#include "objects/cluster.hpp"
#include "objects/tentacle.hpp"
#include "phasetree/cells/cells.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/program/program.hpp"

namespace phasetree::bench {

namespace {

void recording(benchmark::State& state, const Phased& object) {
    for (auto _ : state) benchmark::DoNotOptimize(record(object));
    state.counters["instructions"] = static_cast<double>(record(object).instructions.size());
}

void cells(benchmark::State& state, const Phased& object, const CellOptions& options) {
    std::size_t count = 0;
    for (auto _ : state) {
        const InterfaceCells built(object, options);
        count = built.size();
    }
    state.counters["cells"] = static_cast<double>(count);
}

CellOptions divided_once() {
    CellOptions options;
    options.max_depth = 1;
    return options;
}

const Phased few = cluster(8), many = tentacle(300);

}  // namespace

BENCHMARK_CAPTURE(recording, cluster_of_8_phases, few)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(recording, tentacle_with_300_bumps, many)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cells, cluster_divided_once, few, divided_once())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cells, tentacle_divided_once, many, divided_once())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cells, cluster, few, CellOptions{})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(cells, tentacle, many, CellOptions{})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace phasetree::bench
