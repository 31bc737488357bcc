// Measures volumes, masses, moments, areas and thicknesses of an object's phases, and solves for the number that gives
// one of them a requested value.
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "embree_core/line_tracer.hpp"
#include "embree_core/prepared_object.hpp"
#include "module.hpp"
#include "phasetree/measuring/areas.hpp"
#include "phasetree/measuring/measure.hpp"
#include "phasetree/measuring/prove.hpp"
#include "phasetree/measuring/solve.hpp"

namespace py = pybind11;

namespace phasetree::python {

namespace {

constexpr py::ssize_t numbers_of_one = 3;  // low, high, estimate

// Appends rows of [low, high, estimate].
class Rows {
  public:
    Rows(py::ssize_t phases, std::vector<py::ssize_t> shape_of_one) : shape_(std::move(shape_of_one)) {
        shape_.insert(shape_.begin(), phases);
        shape_.push_back(numbers_of_one);
    }
    void add(const Measured& m) { values_.insert(values_.end(), {m.low, m.high, m.estimate}); }
    void add(const std::array<Measured, 3>& all) {
        for (const Measured& m : all) add(m);
    }
    py::array_t<double> array() const { return py::array_t<double>(shape_, values_.data()); }

  private:
    std::vector<py::ssize_t> shape_;
    std::vector<double> values_;
};

// The arrays of Measures.
py::tuple arrays_of(const MeasureResult& result) {
    const auto count = static_cast<py::ssize_t>(result.phases.size());
    Rows volume(count, {}), mass(count, {}), centre(count, {3}), inertia(count, {3, 3}), low(count, {3}),
        high(count, {3});
    py::list numbers;
    for (const MeasuredPhase& p : result.phases) {
        numbers.append(p.phase.index);
        volume.add(p.body.volume);
        mass.add(p.body.mass);
        centre.add(p.body.centre);
        for (const auto& row : p.body.inertia) inertia.add(row);
        low.add(p.box_low);
        high.add(p.box_high);
    }
    return py::make_tuple(numbers, volume.array(), mass.array(), centre.array(), inertia.array(), low.array(),
                          high.array(), name_of(result.end), result.boxes);
}

py::tuple measures(const Phased& object, double tolerance, std::optional<double> seconds,
                   const std::vector<std::pair<int, double>>& densities, const py::object& tell) {
    MeasureOptions options;
    options.tolerance = tolerance;
    if (seconds) options.seconds = *seconds;
    for (const auto& [phase, density] : densities)
        options.densities.emplace_back(Phase{static_cast<std::uint8_t>(phase)}, density);
    MeasureResult result;
    return run_for_result(
        tell,
        [&](const auto& cancelled, const auto& progress) {
            options.cancelled = cancelled;
            options.progress = [&](float share) { progress("measuring", share); };
            result = measure(object, options);
        },
        [&] { return arrays_of(result); });
}

// For each phase [area, standard error]; and for each contact, the numbers of both phases, and the same.
py::tuple areas(const embree::PreparedObject& object, double tolerance, std::optional<double> seconds,
                const py::object& tell) {
    AreaOptions options;
    options.tolerance = std::max(options.tolerance, tolerance);
    if (seconds) options.seconds = *seconds;
    AreaResult result;
    return run_for_result(
        tell,
        [&](const auto& cancelled, const auto&) {
            options.cancelled = cancelled;
            result = estimate_areas(object.cells().bounds(), embree::line_tracer(object.scene()), options);
        },
        [&] {
            py::list phases, contacts;
            for (const auto& p : result.phases) phases.append(py::make_tuple(p.phase.index, p.area, p.standard_error));
            for (const auto& c : result.contacts)
                contacts.append(py::make_tuple(c.first.index, c.second.index, c.area, c.standard_error));
            return py::make_tuple(phases, contacts);
        });
}

// For each phase (number, low, high, place or None).
py::list thicknesses(const Phased& object, std::optional<double> seconds, const py::object& tell) {
    ProveOptions options;
    if (seconds) options.seconds = *seconds;
    std::vector<WallThickness> walls;
    return run_for_result(
        tell,
        [&](const auto& cancelled, const auto& progress) {
            options.cancelled = cancelled;
            options.progress = [&](float share) { progress("finding thin walls", share); };
            walls = wall_thicknesses(object, options);
        },
        [&] {
            py::list all;
            for (const WallThickness& w : walls) {
                py::object place = py::none();
                if (w.place) place = py::make_tuple(w.place->x, w.place->y, w.place->z);
                all.append(py::make_tuple(w.phase.index, w.low, w.high, place));
            }
            return all;
        });
}

// (number, [low, high, estimate]), or None.
py::object point(const std::optional<SolvePoint>& p) {
    if (!p) return py::none();
    Rows measure(1, {});
    measure.add(p->measure);
    return py::make_tuple(p->at, measure.array());
}

// `make` returns the handle of the object for a number. No other Python code runs during the call.
py::tuple solution(const py::function& make, const std::vector<std::pair<int, double>>& weights, double value,
                   double low, double high, double width, std::optional<double> seconds, const py::object& tell) {
    SolveTarget target{{}, value};
    for (const auto& [phase, weight] : weights)
        target.weights.emplace_back(Phase{static_cast<std::uint8_t>(phase)}, weight);
    SolveOptions options;
    options.width = width;
    if (seconds) options.seconds = *seconds;
    SolveResult result;
    return run_for_result(
        tell,
        [&](const auto& cancelled, const auto& progress) {
            options.cancelled = cancelled;
            options.progress = [&](const SolveProgress& p) { progress("solving", static_cast<float>(p.share)); };
            const auto object = [&](double number) {
                const py::gil_scoped_acquire lock;
                return make(number).cast<Phased>();
            };
            result = solve(object, target, low, high, options);
        },
        [&] {
            return py::make_tuple(name_of(result.end), point(result.best), point(result.low), point(result.high),
                                  point(result.undecided), result.measurements);
        });
}

}  // namespace

void add_measures(py::module_& module) {
    module.def("measure", &measures, py::arg("object"), py::arg("tolerance"), py::arg("seconds"), py::arg("densities"),
               py::arg("tell"));
    module.def("areas", &areas, py::arg("object"), py::arg("tolerance"), py::arg("seconds"), py::arg("tell"));
    module.def("thicknesses", &thicknesses, py::arg("object"), py::arg("seconds"), py::arg("tell"));
    module.def("solve", &solution, py::arg("make"), py::arg("weights"), py::arg("value"), py::arg("low"),
               py::arg("high"), py::arg("width"), py::arg("seconds"), py::arg("tell"));
}

}  // namespace phasetree::python
