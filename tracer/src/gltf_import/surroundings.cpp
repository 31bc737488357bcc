#include "gltf_import/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "gltf_import/solids.hpp"

namespace phasetree::tracer::gltf_import {

namespace {

using gltf::PunctualLight;

double radius_of(const Bounds& subject) {
    const auto radius = 0.5 * static_cast<double>(subject.diagonal());
    return radius > 0 ? radius : 1;
}

double luminance_of(const glm::vec3& color) {
    return static_cast<double>(0.2126f * color.r + 0.7152f * color.g + 0.0722f * color.b);
}

double distance_to(const PunctualLight& light, const Bounds& subject) {
    return std::max(glm::length(z_up(light.position) - glm::dvec3(subject.centre())), 0.1 * radius_of(subject));
}

// An estimate of the irradiance of the file's lights at the subject's centre, ignoring angles, cones and occlusion.
double irradiance_at(const gltf::GltfFile& file, const Bounds& subject) {
    double sum = 0;
    for (const PunctualLight& light : file.lights) {
        const double d = light.kind == PunctualLight::Kind::directional ? 1 : distance_to(light, subject);
        sum += static_cast<double>(light.intensity) * luminance_of(light.color) / (d * d);
    }
    return sum;
}

SceneJson gradient(double intensity) {
    return {{"gradient",
             {{"zenith", {1, 1, 1}},
              {"horizon", {0.65, 0.65, 0.65}},
              {"ground", {0.4, 0.38, 0.35}},
              {"intensity", rounded(intensity)}}}};
}

SceneJson light_of(const PunctualLight& light, const Bounds& subject) {
    const glm::dvec3 position = z_up(light.position), forward = z_up(light.forward);
    const auto intensity = static_cast<double>(light.intensity);
    if (light.kind == PunctualLight::Kind::directional)
        return {
            {"sun", {{"direction", rounded(-forward)}, {"irradiance", rounded(intensity * glm::dvec3(light.color))}}}};
    const double distance = distance_to(light, subject);
    if (light.kind == PunctualLight::Kind::spot) {
        const double outer = glm::degrees(static_cast<double>(light.outer_cone)),
                     inner = glm::degrees(static_cast<double>(light.inner_cone));
        return {{"spot",
                 {{"position", rounded(position)},
                  {"target", rounded(position + distance * forward)},
                  {"cone", rounded(2 * outer)},
                  {"edge", rounded(outer - inner)},
                  {"color", short_numbers(light.color)},
                  {"intensity", short_number(light.intensity)}}}};
    }
    constexpr double share_of_distance = 0.03;
    const double radius = share_of_distance * distance;
    return {{"sphere",
             {{"centre", rounded(position)},
              {"radius", rounded(radius)},
              {"radiance", short_numbers(light.color)},
              {"intensity", rounded(intensity / (std::numbers::pi * radius * radius))},
              {"visible_to_camera", false}}}};
}

}  // namespace

SceneJson camera_of(const gltf::GltfFile& file, const Bounds& subject) {
    const glm::dvec3 centre(subject.centre());
    const double radius = radius_of(subject);
    if (!file.camera) {
        constexpr double fov = 30, margin = 1.1;
        const glm::dvec3 direction = glm::normalize(glm::dvec3(0.25, -1, 0.45));
        const double distance = margin * radius / std::sin(glm::radians(fov / 2));
        return {{"position", rounded(centre + distance * direction)}, {"look_at", rounded(centre)}, {"fov", fov}};
    }
    const glm::dvec3 position = z_up(file.camera->position), forward = z_up(file.camera->forward),
                     up = z_up(file.camera->up);
    // The depth of the subject's centre. `look_at` is placed at that depth, so that the subject is in focus.
    const double depth = glm::dot(centre - position, forward);
    SceneJson camera{{"position", rounded(position)},
                     {"look_at", rounded(position + (depth > 0.1 * radius ? depth : radius) * forward)},
                     {"fov", rounded(glm::degrees(static_cast<double>(file.camera->vertical_fov)))}};
    const glm::dvec3 upright = glm::dvec3(0, 0, 1) - forward.z * forward;
    const bool is_upright =
        glm::length(upright) > 1e-3 && glm::dot(glm::normalize(upright), up) > 1 - 1e-6 * glm::length(up);
    if (!is_upright) camera["up"] = rounded(up);
    return camera;
}

SceneJson lights_of(const gltf::GltfFile& file, const Bounds& subject) {
    SceneJson lights = SceneJson::array();
    if (file.lights.empty()) {
        const glm::dvec3 centre(subject.centre());
        const double r = radius_of(subject);
        lights.push_back({{"rectangle",
                           {{"centre", rounded(centre + r * glm::dvec3(-3, -1.5, 3.5))},
                            {"target", rounded(centre)},
                            {"width", rounded(2.5 * r)},
                            {"height", rounded(2.5 * r)},
                            {"intensity", 6},
                            {"visible_to_camera", false}}}});
        lights.push_back(gradient(0.5));
        return lights;
    }
    for (const PunctualLight& light : file.lights) lights.push_back(light_of(light, subject));
    // About half of the lights' irradiance.
    lights.push_back(gradient(0.2 * irradiance_at(file, subject)));
    return lights;
}

SceneJson render_settings_of(const gltf::GltfFile& file, const Bounds& subject, bool has_phases, bool is_dispersive) {
    constexpr double height = 768, samples = 256;
    const double aspect = std::clamp(
        static_cast<double>(file.camera ? file.camera->aspect_ratio.value_or(4.0f / 3) : 4.0f / 3), 0.1, 10.0);
    SceneJson render{{"width", static_cast<int>(std::lround(aspect * height))},
                     {"height", static_cast<int>(height)},
                     {"samples", static_cast<int>(samples)}};
    if (is_dispersive) render["spectral"] = true;
    if (file.lights.empty()) return render;
    // White paper that faces the lights has a luminance of 1.2, to the nearest half stop.
    const double radiance = 1.5 * irradiance_at(file, subject) / std::numbers::pi;
    const double stops = std::clamp(std::round(2 * std::log(1.2 / radiance) / std::numbers::ln2) / 2, -50.0, 50.0);
    if (stops != 0) render["exposure"] = stops;
    if (has_phases) render["caustics"] = true;
    return render;
}

}  // namespace phasetree::tracer::gltf_import
