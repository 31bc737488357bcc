// Crossings along arrays of rays, and the closest interface to points.
#include "at_rays.hpp"
#include "embree_core/prepared_object.hpp"
#include "interruptible.hpp"
#include "module.hpp"

namespace py = pybind11;

namespace phasetree::python {

using embree::PreparedObject;

namespace {

// Rays per block: few, because a single ray may take a long time.
constexpr std::size_t rays_a_block = 256;
constexpr std::size_t queries_a_block = 16;

std::size_t count_of_rays(const Points& origins, const Points& directions) {
    const std::size_t n = count_of(origins, "origins");
    if (count_of(directions, "directions") != n)
        throw std::invalid_argument("directions and origins must have the same number of rows");
    return n;
}

py::tuple trace(const PreparedObject& object, const Points& origins, const Points& directions) {
    const std::size_t n = count_of_rays(origins, directions);
    const RaysIn rays{origins.data(), directions.data()};
    auto start = array_of<std::uint8_t>(n);
    std::uint8_t* const start_to = start.mutable_data();
    std::vector<CrossingList> blocks((n + rays_a_block - 1) / rays_a_block);
    for_each_block(n, rays_a_block, [&](std::size_t begin, std::size_t end) {
        trace_rays(object.scene(), rays, begin, end, start_to, blocks[begin / rays_a_block]);
    });
    std::size_t total = 0;
    for (const CrossingList& block : blocks) total += block.crossings.size();
    auto offsets = array_of<std::int64_t>(n + 1);
    auto t = array_of<float>(total), normal = array_of<float>(total, 3);
    auto before = array_of<std::uint8_t>(total), after = array_of<std::uint8_t>(total);
    join(
        blocks, rays_a_block, n,
        {offsets.mutable_data(), t.mutable_data(), before.mutable_data(), after.mutable_data(), normal.mutable_data()});
    return py::make_tuple(start, offsets, t, before, after, normal);
}

py::tuple intersect(const PreparedObject& object, const Points& origins, const Points& directions) {
    const std::size_t n = count_of_rays(origins, directions);
    const RaysIn rays{origins.data(), directions.data()};
    auto t = array_of<float>(n), normal = array_of<float>(n, 3);
    auto before = array_of<std::uint8_t>(n), after = array_of<std::uint8_t>(n);
    const FirstCrossings to{t.mutable_data(), before.mutable_data(), after.mutable_data(), normal.mutable_data()};
    for_each_block(n, rays_a_block,
                   [&](std::size_t begin, std::size_t end) { intersect_rays(object.scene(), rays, begin, end, to); });
    return py::make_tuple(t, before, after, normal);
}

py::tuple closest(const PreparedObject& object, const Points& points, float radius, float tolerance) {
    if (!(radius >= 0)) throw ModelError(fmt::format("the radius is {}; it must be a distance", radius));
    if (!(tolerance >= 0.001f && tolerance <= 1))
        throw ModelError(fmt::format("the tolerance is {}; it must be 0.001 … 1", tolerance));
    const std::size_t n = count_of(points, "points");
    const float* const from = points.data();
    auto distance = array_of<float>(n), nearest = array_of<float>(n, 3);
    auto here = array_of<std::uint8_t>(n), there = array_of<std::uint8_t>(n);
    const ClosestInterfaces to{distance.mutable_data(), nearest.mutable_data(), here.mutable_data(),
                               there.mutable_data()};
    for_each_block(n, queries_a_block, [&](std::size_t begin, std::size_t end) {
        find_closest_to(object.scene(), from, begin, end, radius, tolerance, to);
    });
    return py::make_tuple(distance, nearest, here, there);
}

std::unique_ptr<PreparedObject> prepared(const Phased& object, bool is_quick, float resolution,
                                         const py::object& tell) {
    std::unique_ptr<PreparedObject> result;
    run_beside(tell, [&](const auto& cancelled, const auto& progress) {
        CellOptions options;
        options.resolution = resolution;
        options.quality = is_quick ? BuildQuality::low : BuildQuality::medium;
        options.cancelled = cancelled;
        options.progress = [&](float share) { progress("preparing", share); };
        result = std::make_unique<PreparedObject>(object, options);
    });
    return result;
}

}  // namespace

void add_rays(py::module_& module) {
    py::class_<PreparedObject>(module, "PreparedObject")
        .def(py::init(&prepared), py::arg("object"), py::arg("is_quick"), py::arg("resolution"), py::arg("tell"))
        .def_property_readonly("resolution", [](const PreparedObject& o) { return o.cells().resolution(); })
        .def_property_readonly("warning", [](const PreparedObject& o) { return o.cells().warning(); })
        .def_property_readonly("cells", [](const PreparedObject& o) { return o.cells().size(); })
        .def("trace", &trace, py::arg("origins").noconvert(), py::arg("directions").noconvert())
        .def("intersect", &intersect, py::arg("origins").noconvert(), py::arg("directions").noconvert())
        .def("closest", &closest, py::arg("points").noconvert(), py::arg("radius"), py::arg("tolerance"));
}

}  // namespace phasetree::python
