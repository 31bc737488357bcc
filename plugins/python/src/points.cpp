// Labels, distances and gradients at arrays of points.
#include <optional>

#include "at_points.hpp"
#include "interruptible.hpp"
#include "module.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/program/program.hpp"

namespace py = pybind11;

namespace phasetree::python {

namespace {

py::array_t<std::uint8_t> labels(const Evaluator& evaluator, const Points& points) {
    const std::size_t n = count_of(points, "points");
    auto result = array_of<std::uint8_t>(n);
    const float* const from = points.data();
    std::uint8_t* const to = result.mutable_data();
    for_each_block(n, points_a_block,
                   [&](std::size_t begin, std::size_t end) { labels_at(evaluator, from, begin, end, to); });
    return result;
}

py::array_t<float> distances(const Evaluator& evaluator, const Points& points, std::size_t columns) {
    const std::size_t n = count_of(points, "points");
    for (const Output& output : evaluator.program().outputs)
        if (output.phase.index >= columns) throw std::invalid_argument("too few columns");
    auto result = array_of<float>(n, columns);
    const float* const from = points.data();
    float* const to = result.mutable_data();
    for_each_block(n, points_a_block,
                   [&](std::size_t begin, std::size_t end) { distances_at(evaluator, from, begin, end, columns, to); });
    return result;
}

py::array_t<float> components(const Evaluator& evaluator, const Points& points, int phase) {
    if (phase < 0 || phase >= Phase::capacity) throw std::invalid_argument("no such phase");
    const std::size_t n = count_of(points, "points");
    auto result = array_of<float>(n);
    const float* const from = points.data();
    float* const to = result.mutable_data();
    const Phase chosen{static_cast<std::uint8_t>(phase)};
    for_each_block(n, points_a_block,
                   [&](std::size_t begin, std::size_t end) { components_at(evaluator, from, begin, end, chosen, to); });
    return result;
}

py::array_t<float> gradients(const Evaluator& evaluator, const Points& points, int phase) {
    if (phase >= Phase::capacity) throw std::invalid_argument("no such phase");
    const std::size_t n = count_of(points, "points");
    auto result = array_of<float>(n, 3);
    const float* const from = points.data();
    float* const to = result.mutable_data();
    std::optional<Phase> chosen;
    if (phase >= 0) chosen = Phase{static_cast<std::uint8_t>(phase)};
    for_each_block(n, points_a_block / 8,
                   [&](std::size_t begin, std::size_t end) { gradients_at(evaluator, from, begin, end, chosen, to); });
    return result;
}

}  // namespace

void add_points(py::module_& module) {
    py::class_<Evaluator>(module, "Evaluator")
        .def(py::init([](const Field& field) { return Evaluator(record(field)); }))
        .def(py::init([](const Phased& object) { return Evaluator(record(object)); }))
        .def_property_readonly("instructions", [](const Evaluator& e) { return e.program().instructions.size(); })
        .def("label", &labels, py::arg("points").noconvert())
        .def("phi", &distances, py::arg("points").noconvert(), py::arg("columns"))
        .def("component", &components, py::arg("points").noconvert(), py::arg("phase"))
        .def("gradient", &gradients, py::arg("points").noconvert(), py::arg("phase"));
}

}  // namespace phasetree::python
