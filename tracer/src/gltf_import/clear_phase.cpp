#include "gltf_import/clear_phase.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

namespace phasetree::tracer::gltf_import {

namespace {

// Darker colours are read as this, because nothing absorbs all light.
constexpr float darkest = 1e-6f;

SceneJson film_numbers(const SurfaceFilm& film) {
    const float* const thickness = std::get_if<float>(&film.thickness);
    return {{"film_thickness", short_number(thickness ? *thickness : 0)}, {"film_ior", short_number(film.ior)}};
}

}  // namespace

SceneJson clear_phase(const gltf::ClearMaterial& material, double mean_chord, std::vector<std::string>& losses) {
    constexpr float least_abbe = 10, most_abbe = 1000;
    SceneJson clear{{"ior", short_number(material.ior)}};
    const float alpha = material.roughness * material.roughness;
    if (material.dispersion > 0) {
        const float abbe = 20 / material.dispersion;
        if (alpha > 0 || material.film)
            losses.emplace_back(
                "loses its dispersion, which only smooth materials without a film can have (KHR_materials_dispersion)");
        else if (abbe <= most_abbe)
            clear["abbe_number"] = short_number(std::max(abbe, least_abbe));
        if (abbe < least_abbe && clear.contains("abbe_number"))
            losses.push_back(fmt::format("has the Abbe number {:.3g}, which is below the minimum; 10 is used", abbe));
    }
    if (alpha > 0) clear["roughness"] = short_number(alpha);
    const glm::vec3 attenuation = glm::max(material.attenuation_color, glm::vec3(darkest));
    const bool absorbs = material.attenuation_distance && attenuation != glm::vec3(1);
    if (material.tint != glm::vec3(1) && mean_chord > 0) {
        glm::dvec3 absorption = -2.0 * glm::log(glm::dvec3(glm::max(material.tint, glm::vec3(darkest)))) / mean_chord;
        if (absorbs)
            absorption -= glm::log(glm::dvec3(attenuation)) / static_cast<double>(*material.attenuation_distance);
        clear["absorption"] = rounded(absorption);
        losses.emplace_back(
            "has a base colour that tints its surface; this becomes absorption inside, so thick parts are darker than "
            "thin ones");
    } else if (absorbs) {
        clear["color"] = short_numbers(attenuation);
        clear["color_distance"] = short_number(*material.attenuation_distance);
    }
    if (material.film) clear.update(film_numbers(*material.film));
    return {{"clear", std::move(clear)}};
}

}  // namespace phasetree::tracer::gltf_import
