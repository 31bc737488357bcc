// A batch of points through one node: what an instruction costs, family by family. A sphere is the least that there is;
// what it takes is the price of a call.
#include <benchmark/benchmark.h>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/blob.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/displace.hpp"
#include "phasetree/nodes/fields/ellipsoid.hpp"
#include "phasetree/nodes/fields/gyroid.hpp"
#include "phasetree/nodes/fields/round_cone.hpp"
#include "phasetree/nodes/fields/smooth_union.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/torus.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/fields/voronoi_cells.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/twist.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "phasetree/program/program.hpp"
#include "rays/random.hpp"

namespace phasetree::bench {

namespace {

struct Points {
    BatchOfFloats x{}, y{}, z{};
};

Points points() {
    Random random(1);
    Points p;
    for (std::size_t i = 0; i < batch_size; ++i) {
        p.x[i] = 2 * random.next() - 1;
        p.y[i] = 2 * random.next() - 1;
        p.z[i] = 2 * random.next() - 1;
    }
    return p;
}

void evaluate(benchmark::State& state, const Field& field) {
    const Evaluator evaluator(record(field));
    const Points p = points();
    Samples samples;
    Evaluator::Workspace workspace;
    for (auto _ : state) {
        evaluator.sample(p.x, p.y, p.z, samples, workspace);
        benchmark::DoNotOptimize(samples);
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(batch_size));
    state.counters["instructions"] = static_cast<double>(evaluator.program().instructions.size());
}

Field seven_points() {
    Blob blob;
    blob.points = {{0, 0, 0}, {0.5f, 0, 0}, {-0.5f, 0, 0}, {0, 0.5f, 0}, {0, -0.5f, 0}, {0, 0, 0.5f}, {0, 0, -0.5f}};
    blob.radii = {0.6f};
    return blob;
}

const Field ball = Sphere{0.7f}, box = Box{glm::vec3(1, 0.8f, 1.2f)};

}  // namespace

BENCHMARK_CAPTURE(evaluate, sphere, ball);
BENCHMARK_CAPTURE(evaluate, box, box);
BENCHMARK_CAPTURE(evaluate, torus, Field(Torus{}));
BENCHMARK_CAPTURE(evaluate, round_cone, Field(RoundCone{}));
BENCHMARK_CAPTURE(evaluate, ellipsoid, Field(Ellipsoid{}));
BENCHMARK_CAPTURE(evaluate, gyroid, Field(Gyroid{}));
BENCHMARK_CAPTURE(evaluate, blob_of_seven_points, seven_points());
BENCHMARK_CAPTURE(evaluate, voronoi_cells, Field(VoronoiCells{}));
BENCHMARK_CAPTURE(evaluate, noise_of_three_octaves,
                  Field(Displace{.of = ball, .amplitude = 0.1f, .scale = 0.3f, .octaves = 3}));
BENCHMARK_CAPTURE(evaluate, union_of_two, Field(Union{{ball, box}}));
BENCHMARK_CAPTURE(evaluate, smooth_union_of_two, Field(SmoothUnion{.of = {ball, box}, .radius = 0.2f}));
BENCHMARK_CAPTURE(evaluate, turned_box, warped(Rotate{.axis = {1, 2, 3}, .angle = 40}, box));
BENCHMARK_CAPTURE(evaluate, twisted_box, warped(Twist{.rate = 60}, box));

}  // namespace phasetree::bench
