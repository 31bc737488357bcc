#include "gltf/cameras_and_lights.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <string>

namespace phasetree::tracer::gltf {

namespace {

constexpr float pi = 3.14159265f;

// The direction of a column of the placement; `otherwise` if it has no length.
glm::dvec3 axis(const glm::dmat4& placement, int column, const glm::dvec3& otherwise) {
    const glm::dvec3 v(placement[column]);
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : otherwise;
}

bool is_usable(const glm::dvec3& position) {
    return std::abs(position.x) <= most_magnitude && std::abs(position.y) <= most_magnitude &&
           std::abs(position.z) <= most_magnitude;
}

}  // namespace

std::optional<Camera> camera_of(const Document& document, const PlacedMeshes& placed) {
    for (const PlacedElement& element : placed.cameras) {
        const Item item = document.element("cameras", element.number, document.root());
        const auto perspective = item.item("perspective");
        if (item.text("type") != "perspective" || !perspective) continue;
        Camera camera{.position = glm::dvec3(element.placement[3]),
                      .forward = -axis(element.placement, 2, {0, 0, 1}),
                      .up = axis(element.placement, 1, {0, 1, 0}),
                      .vertical_fov = perspective->number("yfov", 0)};
        if (!(camera.vertical_fov > 0 && camera.vertical_fov < pi))
            perspective->fail("must have a \"yfov\" that is more than 0 and less than π");
        if (!is_usable(camera.position)) item.fail("is too far away");
        const float aspect = perspective->number("aspectRatio", 0);
        if (aspect > 0) camera.aspect_ratio = aspect;
        return camera;
    }
    return std::nullopt;
}

std::vector<PunctualLight> lights_of(const Document& document, const PlacedMeshes& placed) {
    std::vector<PunctualLight> lights;
    if (placed.lights.empty()) return lights;
    const auto extension = document.root().extension("KHR_lights_punctual");
    const std::vector<Item> items = extension ? extension->items("lights") : std::vector<Item>();
    for (const PlacedElement& element : placed.lights) {
        if (element.number >= items.size()) document.root().fail("has a node with a light that does not exist");
        const Item& item = items[element.number];
        const std::string type = item.text("type");
        PunctualLight light{.position = glm::dvec3(element.placement[3]),
                            .forward = -axis(element.placement, 2, {0, 0, 1}),
                            .color = glm::max(item.vec3("color", glm::vec3(1)), glm::vec3(0)),
                            .intensity = item.number("intensity", 1)};
        if (type == "directional") {
            light.kind = PunctualLight::Kind::directional;
        } else if (type == "spot") {
            light.kind = PunctualLight::Kind::spot;
            const auto spot = item.item("spot");
            light.outer_cone = std::clamp(spot ? spot->number("outerConeAngle", pi / 4) : pi / 4, 0.001f, pi / 2);
            light.inner_cone = std::clamp(spot ? spot->number("innerConeAngle", 0) : 0.0f, 0.0f, light.outer_cone);
        } else if (type != "point") {
            item.fail("must have the \"type\" \"directional\", \"point\" or \"spot\"");
        }
        if (!is_usable(light.position)) item.fail("is too far away");
        if (light.intensity > 0 && light.color != glm::vec3(0)) lights.push_back(light);
    }
    return lights;
}

}  // namespace phasetree::tracer::gltf
