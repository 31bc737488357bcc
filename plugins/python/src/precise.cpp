// Phases, safe distances and crossings in double precision.
#include <pybind11/stl.h>

#include <limits>
#include <optional>

#include "arrays.hpp"
#include "interruptible.hpp"
#include "module.hpp"
#include "phasetree/trace/precise_tracer.hpp"

namespace py = pybind11;

namespace phasetree::python {

namespace {

/// Contiguous (N, 3) doubles; the package converts other arrays before the call.
using PrecisePoints = py::array_t<double, py::array::c_style>;
using Numbers = py::array_t<double, py::array::c_style>;
using Labels = py::array_t<std::uint8_t, py::array::c_style>;

constexpr std::size_t precise_points_a_block = 1024, precise_rays_a_block = 64;

std::size_t count_of(const PrecisePoints& points, const char* what) {
    if (points.ndim() != 2 || points.shape(1) != 3)
        throw std::invalid_argument(fmt::format("{} must have the shape (N, 3)", what));
    return static_cast<std::size_t>(points.shape(0));
}
glm::dvec3 point_of(const double* points, std::size_t i) {
    return {points[3 * i], points[3 * i + 1], points[3 * i + 2]};
}
void put(double* points, std::size_t i, const glm::dvec3& p) {
    for (int axis = 0; axis < 3; ++axis) points[3 * i + static_cast<std::size_t>(axis)] = p[axis];
}

py::array_t<std::uint8_t> locate(const PreciseEvaluator& evaluator, const PrecisePoints& points) {
    const std::size_t n = count_of(points, "points");
    auto result = array_of<std::uint8_t>(n);
    const double* const from = points.data();
    std::uint8_t* const to = result.mutable_data();
    for_each_block(n, precise_points_a_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) to[i] = evaluator.label(point_of(from, i)).index;
    });
    return result;
}

py::array_t<double> safe_distance(const PreciseEvaluator& evaluator, const PrecisePoints& points, double error) {
    const std::size_t n = count_of(points, "points");
    auto result = array_of<double>(n);
    const double* const from = points.data();
    double* const to = result.mutable_data();
    for_each_block(n, precise_points_a_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) to[i] = evaluator.safe_distance(point_of(from, i), error);
    });
    return result;
}

// The rays of a call. `phases` is None, or has the phase of each ray; `limits` has the largest t of each.
class PreciseRaysIn {
  public:
    PreciseRaysIn(const PrecisePoints& origins, const PrecisePoints& directions, const std::optional<Labels>& phases,
                  const Numbers& limits)
        : count_(count_of(origins, "origins")),
          origins_(origins.data()),
          directions_(directions.data()),
          phases_(phases ? phases->data() : nullptr),
          limits_(limits.data()) {
        const auto rows = static_cast<py::ssize_t>(count_);
        if (count_of(directions, "directions") != count_ || limits.size() != rows || (phases && phases->size() != rows))
            throw std::invalid_argument("directions, phases, limits and origins must have the same number of rows");
        for (std::size_t i = 0; phases_ && i < count_; ++i)
            if (phases_[i] >= Phase::capacity)
                throw std::invalid_argument(fmt::format("there is no phase {}", phases_[i]));
    }
    std::size_t count() const { return count_; }
    PreciseRay operator[](std::size_t i) const {
        PreciseRay ray{point_of(origins_, i), point_of(directions_, i), limits_[i], std::nullopt};
        if (phases_) ray.carried = Phase{phases_[i]};
        return ray;
    }

  private:
    std::size_t count_;
    const double* origins_;
    const double* directions_;
    const std::uint8_t* phases_;
    const double* limits_;
};

py::tuple next_crossing(const PreciseTracer& tracer, const PrecisePoints& origins, const PrecisePoints& directions,
                        const std::optional<Labels>& phases, const Numbers& limits) {
    const PreciseRaysIn rays(origins, directions, phases, limits);
    const std::size_t n = rays.count();
    auto t = array_of<double>(n), normal = array_of<double>(n, 3), near = array_of<double>(n, 3),
         far = array_of<double>(n, 3);
    auto before = array_of<std::uint8_t>(n), after = array_of<std::uint8_t>(n);
    double *const t_to = t.mutable_data(), *const normal_to = normal.mutable_data(),
                  *const near_to = near.mutable_data(), *const far_to = far.mutable_data();
    std::uint8_t *const before_to = before.mutable_data(), *const after_to = after.mutable_data();
    for_each_block(n, precise_rays_a_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            constexpr double nan = std::numeric_limits<double>::quiet_NaN();
            const PreciseRay ray = rays[i];
            PreciseCrossing c;
            if (const auto found = tracer.first_crossing(ray)) {
                c = *found;
            } else {
                c.t_from = std::numeric_limits<double>::infinity();
                c.p_from = c.p_to = glm::dvec3(nan);
                c.from = c.to = ray.carried ? *ray.carried : tracer.evaluator().label(ray.origin);
            }
            t_to[i] = c.t_from;
            before_to[i] = c.from.index;
            after_to[i] = c.to.index;
            put(normal_to, i, c.normal);
            put(near_to, i, c.p_from);
            put(far_to, i, c.p_to);
        }
    });
    return py::make_tuple(t, before, after, normal, near, far);
}

py::tuple crossings(const PreciseTracer& tracer, const PrecisePoints& origins, const PrecisePoints& directions,
                    const std::optional<Labels>& phases, const Numbers& limits) {
    const PreciseRaysIn rays_in(origins, directions, phases, limits);
    std::optional<PreciseCrossings> all;
    bool has_error = false;
    {
        const py::gil_scoped_release unlocked;
        Interruption interruption;
        std::vector<PreciseRay> rays(rays_in.count());
        for (std::size_t i = 0; i < rays.size(); ++i) rays[i] = rays_in[i];
        all = tracer.crossings(rays, [&] { return interruption.asked(); });
        has_error = interruption.has_error();
    }
    if (has_error) throw py::error_already_set();
    const std::size_t n = all->start.size(), total = all->crossings.size();
    auto start = array_of<std::uint8_t>(n), before = array_of<std::uint8_t>(total),
         after = array_of<std::uint8_t>(total);
    auto offsets = array_of<std::int64_t>(n + 1);
    auto t = array_of<double>(total), normal = array_of<double>(total, 3);
    for (std::size_t i = 0; i < n; ++i) start.mutable_data()[i] = all->start[i].index;
    for (std::size_t i = 0; i <= n; ++i) offsets.mutable_data()[i] = static_cast<std::int64_t>(all->offsets[i]);
    for (std::size_t i = 0; i < total; ++i) {
        const PreciseCrossing& c = all->crossings[i];
        t.mutable_data()[i] = c.t_from;
        before.mutable_data()[i] = c.from.index;
        after.mutable_data()[i] = c.to.index;
        put(normal.mutable_data(), i, c.normal);
    }
    return py::make_tuple(start, offsets, t, before, after, normal);
}

}  // namespace

void add_precise(py::module_& module) {
    py::class_<PreciseEvaluator>(module, "PreciseEvaluator")
        .def(py::init<const Phased&>(), py::arg("object"))
        .def("locate", &locate, py::arg("points").noconvert())
        .def("safe_distance", &safe_distance, py::arg("points").noconvert(), py::arg("error"));
    py::class_<PreciseTracer>(module, "PreciseTracer")
        .def(py::init<const Phased&, double>(), py::arg("object"), py::arg("resolution"))
        .def_property_readonly("resolution", &PreciseTracer::resolution)
        .def_property_readonly("value_error", &PreciseTracer::value_error)
        .def("crossings", &crossings, py::arg("origins").noconvert(), py::arg("directions").noconvert(),
             py::arg("phases"), py::arg("limits").noconvert())
        .def("next_crossing", &next_crossing, py::arg("origins").noconvert(), py::arg("directions").noconvert(),
             py::arg("phases"), py::arg("limits").noconvert());
}

}  // namespace phasetree::python
