#include "command/carve_report.hpp"

#include <chrono>

#include "command/numbers.hpp"
#include "command/streams.hpp"

namespace phasetree::tracer {

namespace {

double volume_of(const Bounds& box) {
    if (box.empty()) return 0;
    const glm::dvec3 extent(box.extent());
    return extent.x * extent.y * extent.z;
}

nlohmann::ordered_json numbers(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

}  // namespace

std::vector<CarvedPart> carve_parts(const SceneTree& tree, int max_planes) {
    CarveOptions options;
    options.max_planes = max_planes;
    std::vector<CarvedPart> parts;
    const auto add = [&](std::string name, PhaseSet of) {
        const auto start = std::chrono::steady_clock::now();
        CarvedBounds bounds = carve(tree.object, of, options);
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        parts.push_back({std::move(name), std::move(bounds), taken.count()});
    };
    const std::uint64_t materials = phases(tree.object).bits & ~std::uint64_t{1};
    if (materials == 0) return parts;
    add("", {});
    if (std::popcount(materials) == 1) return parts;
    for_each_phase(materials, [&](int i) {
        add(tree.phases.names[static_cast<std::size_t>(i)], PhaseSet::of(Phase{static_cast<std::uint8_t>(i)}));
    });
    return parts;
}

void add_carved(nlohmann::ordered_json& json, const std::vector<CarvedPart>& parts) {
    auto& list = json["carved"] = nlohmann::ordered_json::array();
    for (const CarvedPart& part : parts) {
        const CarvedBounds& c = part.bounds;
        auto& item = list.emplace_back();
        if (part.name.empty())
            item["phase"] = nullptr;
        else
            item["phase"] = part.name;
        item["empty"] = c.box.empty();
        if (!c.box.empty()) item["box"] = {numbers(glm::dvec3(c.box.low)), numbers(glm::dvec3(c.box.high))};
        auto& planes = item["planes"] = nlohmann::ordered_json::array();
        for (const HalfSpace& h : c.planes) planes.push_back({{"normal", numbers(h.normal)}, {"offset", h.offset}});
        auto& corners = item["corners"] = nlohmann::ordered_json::array();
        for (const glm::dvec3& p : c.mesh.corners) corners.push_back(numbers(p));
        item["faces"] = c.mesh.faces;
        item["volume"] = c.volume;
        item["box_volume"] = volume_of(c.box);
        item["area"] = c.area;
        item["evaluations"] = c.evaluations;
        item["within_tolerance"] = c.is_within_tolerance;
        item["seconds"] = part.seconds;
    }
}

void print_carved(const std::vector<CarvedPart>& parts) {
    for (const CarvedPart& part : parts) {
        const CarvedBounds& c = part.bounds;
        const std::string name = part.name.empty() ? "whole object" : part.name;
        if (c.box.empty()) {
            put("{:<14}{}: empty\n", "carved", name);
            continue;
        }
        put("{:<14}{}: {} planes, volume {:.4g}, {:.0f} % of its bounding box; {} evaluations{}\n", "carved", name,
            c.planes.size(), c.volume, 100 * c.volume / volume_of(c.box), c.evaluations,
            c.is_within_tolerance ? "" : "; not within the tolerance");
    }
}

}  // namespace phasetree::tracer
