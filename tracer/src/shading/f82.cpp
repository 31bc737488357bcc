#include "shading/f82.hpp"

#include "shading/fresnel.hpp"
#include "shading/thin_film.hpp"

namespace phasetree::tracer {

glm::vec3 F82Metal::under_film(float mu, const Wavelengths* wavelengths) const {
    const glm::vec3 k = k_of_reflectance(normal);
    if (!wavelengths) return film->colours->reflectance(film->outside, film->ior, k, mu, film->thickness);
    glm::vec3 result;
    for (int i = 0; i < 3; ++i)
        result[i] = mu > 0.0f
                        ? static_cast<float>(thin_film_reflectance(
                              static_cast<double>(film->outside), static_cast<double>(film->ior), 1.0,
                              static_cast<double>(k[i]), static_cast<double>(mu), static_cast<double>(film->thickness),
                              static_cast<double>(wavelengths->nanometres[i])))
                        : 1.0f;
    return result;
}

}  // namespace phasetree::tracer
