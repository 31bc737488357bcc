// The loops in C++ that calls from Python are compared with: the same work by the same threads, without Python.
#include <pybind11/pybind11.h>
#include <tbb/parallel_for.h>

#include "../src/at_points.hpp"
#include "../src/at_rays.hpp"
#include "embree_core/prepared_object.hpp"
#include "phasetree/math/float_mode.hpp"

namespace py = pybind11;
using namespace phasetree;
using namespace phasetree::python;
using embree::PreparedObject;

namespace {

template <class F>
void blocks(std::size_t count, std::size_t block, F&& f) {
    tbb::parallel_for(std::size_t{0}, (count + block - 1) / block, [&](std::size_t i) {
        const FlushSubnormals flush;
        f(i * block, std::min(count, (i + 1) * block));
    });
}

std::size_t label_loop(const Evaluator& evaluator, const Points& points) {
    const std::size_t n = count_of(points, "points");
    const std::unique_ptr<std::uint8_t[]> labels(new std::uint8_t[n]);
    blocks(n, points_a_block,
           [&](std::size_t begin, std::size_t end) { labels_at(evaluator, points.data(), begin, end, labels.get()); });
    return labels[n - 1];
}

float phi_loop(const Evaluator& evaluator, const Points& points, std::size_t columns) {
    const std::size_t n = count_of(points, "points");
    const std::unique_ptr<float[]> values(new float[n * columns]);
    blocks(n, points_a_block, [&](std::size_t begin, std::size_t end) {
        distances_at(evaluator, points.data(), begin, end, columns, values.get());
    });
    return values[n - 1];
}

std::size_t trace_loop(const PreparedObject& object, const Points& origins, const Points& directions) {
    constexpr std::size_t block = 256;
    const std::size_t n = count_of(origins, "origins");
    const RaysIn rays{origins.data(), directions.data()};
    const std::unique_ptr<std::uint8_t[]> start(new std::uint8_t[n]);
    std::vector<CrossingList> lists((n + block - 1) / block);
    blocks(n, block, [&](std::size_t begin, std::size_t end) {
        trace_rays(object.scene(), rays, begin, end, start.get(), lists[begin / block]);
    });
    std::size_t total = 0;
    for (const CrossingList& list : lists) total += list.crossings.size();
    return total;
}

float intersect_loop(const PreparedObject& object, const Points& origins, const Points& directions) {
    const std::size_t n = count_of(origins, "origins");
    const RaysIn rays{origins.data(), directions.data()};
    const std::unique_ptr<float[]> t(new float[n]), normal(new float[3 * n]);
    const std::unique_ptr<std::uint8_t[]> before(new std::uint8_t[n]), after(new std::uint8_t[n]);
    blocks(n, 256, [&](std::size_t begin, std::size_t end) {
        intersect_rays(object.scene(), rays, begin, end, {t.get(), before.get(), after.get(), normal.get()});
    });
    return t[n - 1];
}

}  // namespace

PYBIND11_MODULE(_loops, module) {
    module.def("label", &label_loop, py::call_guard<py::gil_scoped_release>());
    module.def("phi", &phi_loop, py::call_guard<py::gil_scoped_release>());
    module.def("trace", &trace_loop, py::call_guard<py::gil_scoped_release>());
    module.def("intersect", &intersect_loop, py::call_guard<py::gil_scoped_release>());
}
