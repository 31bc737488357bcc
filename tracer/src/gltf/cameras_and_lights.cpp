#include "gltf/cameras_and_lights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "gltf/names.hpp"

namespace phasetree::tracer::gltf {

namespace {

constexpr float pi = 3.14159265f;

// The direction of a column of the placement; `otherwise` if its length is 0.
glm::dvec3 axis(const glm::dmat4& placement, int column, const glm::dvec3& otherwise) {
    const glm::dvec3 v(placement[column]);
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : otherwise;
}

// The name of a camera or a light in quotes, or its number if it has none.
std::string name_of(const Item& item, std::size_t number) {
    const std::string name = clean_name(item.text("name"));
    return name.empty() ? fmt::format("{}", number) : fmt::format("\"{}\"", name);
}

bool is_usable(const glm::dvec3& position) {
    return std::abs(position.x) <= most_magnitude && std::abs(position.y) <= most_magnitude &&
           std::abs(position.z) <= most_magnitude;
}

std::optional<Camera> camera_of(const Document& document, const PlacedMeshes& placed,
                                std::vector<std::string>& not_shown) {
    std::optional<Camera> first;
    for (const PlacedElement& element : placed.cameras) {
        const Item item = document.element("cameras", element.number, document.root());
        const auto perspective = item.item("perspective");
        if (item.text("type") == "orthographic")
            not_shown.push_back(
                fmt::format("the camera {} is orthographic and left out; write it into the scene by "
                            "hand, as an \"orthographic\" camera",
                            name_of(item, element.number)));
        if (first || item.text("type") != "perspective" || !perspective) continue;
        Camera camera{.position = glm::dvec3(element.placement[3]),
                      .forward = -axis(element.placement, 2, {0, 0, 1}),
                      .up = axis(element.placement, 1, {0, 1, 0}),
                      .vertical_fov = perspective->number("yfov", 0)};
        if (!(camera.vertical_fov > 0 && camera.vertical_fov < pi))
            perspective->fail("must have a \"yfov\" that is more than 0 and less than π");
        if (!is_usable(camera.position)) item.fail("is too far away");
        const float aspect = perspective->number("aspectRatio", 0);
        if (aspect > 0) camera.aspect_ratio = aspect;
        first = camera;
    }
    return first;
}

// The reason why a light does not emit; empty if it does.
std::string why_dark(const glm::vec3& color, float intensity) {
    if (intensity < 0) return "a negative intensity";
    if (intensity == 0) return "the intensity 0";
    if (!(color.x > 0 || color.y > 0 || color.z > 0)) return "a black or negative colour";
    return {};
}

std::vector<PunctualLight> lights_of(const Document& document, const PlacedMeshes& placed,
                                     std::vector<std::string>& not_shown) {
    std::vector<PunctualLight> lights;
    if (placed.lights.empty()) return lights;
    const auto extension = document.root().extension("KHR_lights_punctual");
    const std::vector<Item> items = extension ? extension->items("lights") : std::vector<Item>();
    for (const PlacedElement& element : placed.lights) {
        if (element.number >= items.size()) document.root().fail("has a node with a light that does not exist");
        const Item& item = items[element.number];
        const std::string type = item.text("type");
        const glm::vec3 color = item.vec3("color", glm::vec3(1));
        PunctualLight light{.position = glm::dvec3(element.placement[3]),
                            .forward = -axis(element.placement, 2, {0, 0, 1}),
                            .color = glm::max(color, glm::vec3(0)),
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
        const std::string dark = why_dark(color, light.intensity), name = name_of(item, element.number);
        if (!dark.empty()) {
            not_shown.push_back(fmt::format("the light {} has {} and is left out", name, dark));
            continue;
        }
        if (light.color != color)
            not_shown.push_back(
                fmt::format("the light {} has a colour with negative components, which become 0", name));
        lights.push_back(light);
    }
    return lights;
}

}  // namespace

CamerasAndLights cameras_and_lights(const Document& document, const PlacedMeshes& placed) {
    CamerasAndLights all;
    all.camera = camera_of(document, placed, all.not_shown);
    all.lights = lights_of(document, placed, all.not_shown);
    return all;
}

}  // namespace phasetree::tracer::gltf
