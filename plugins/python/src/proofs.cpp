// Statements about objects that are proved or refuted.
#include <pybind11/stl.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "module.hpp"
#include "phasetree/measuring/prove.hpp"
#include "scene/expectations.hpp"

namespace py = pybind11;

namespace phasetree::python {

namespace {

py::list listed(const std::vector<Proof>& found, const std::vector<tracer::Expectation>& expected,
                const std::vector<std::string>& names) {
    py::list all;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Proof& p = found[i];
        py::list points;
        for (const Witness& w : p.witnesses)
            points.append(py::make_tuple(py::make_tuple(w.point.x, w.point.y, w.point.z), names[w.phase.index]));
        const double size = expected[i].unit;
        py::object interval = py::none();
        if (std::isfinite(p.measured.low) && std::isfinite(p.measured.high))
            interval = py::make_tuple(p.measured.low / size, p.measured.high / size);
        all.append(py::make_tuple(std::string(name_of(p.verdict)), p.reason, points, p.resolution, interval));
    }
    return all;
}

// `text` is a scene file that has only "expect". `densities` holds pairs of a phase's number and its density in kg/m³.
py::list proofs(const Phased& object, const std::vector<std::string>& names, const std::string& text,
                const std::string& unit, const std::vector<std::pair<int, double>>& densities, double resolution,
                std::optional<double> seconds, const py::object& tell) {
    PhaseNames phases;
    phases.names = names;
    std::vector<std::optional<double>> by_phase(names.size());
    for (const auto& [phase, density] : densities) by_phase.at(static_cast<std::size_t>(phase)) = density;
    const auto lengths = tracer::length_unit_named(unit);
    if (!lengths) throw ModelError("the unit must be " + tracer::names_of_length_units() + ", but is \"" + unit + "\"");
    const auto expected =
        tracer::read_expectations(Document::from_text(text, "<statements>"), {phases, lengths->metres, by_phase});
    std::vector<Statement> statements;
    for (const tracer::Expectation& e : expected) statements.push_back(e.statement);
    ProveOptions options;
    options.resolution = resolution;
    if (seconds) options.seconds = *seconds;
    std::vector<Proof> found;
    return run_for_result(
        tell,
        [&](const auto& cancelled, const auto& progress) {
            options.cancelled = cancelled;
            options.progress = [&](float share) { progress("proving", share); };
            found = prove(object, statements, options);
        },
        [&] { return listed(found, expected, names); });
}

}  // namespace

void add_proofs(py::module_& module) {
    module.def("prove", &proofs, py::arg("object"), py::arg("names"), py::arg("text"), py::arg("unit"),
               py::arg("densities"), py::arg("resolution"), py::arg("seconds"), py::arg("tell"));
}

}  // namespace phasetree::python
