#include "shading/film_colours.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "shading/film_faces.hpp"
#include "spectrum/colour_matching.hpp"

namespace phasetree::tracer {

FilmColours::FilmColours() {
    const std::vector<SpectralWeight> weights = spectral_weights();
    for (int i = 0; static_cast<float>(i) * step <= longest; ++i) {
        const double path = static_cast<double>(static_cast<float>(i) * step);
        glm::dvec3 real(0.0), imaginary(0.0);
        for (const SpectralWeight& w : weights) {
            const double phase = 2.0 * std::numbers::pi * path / w.wavelength;
            real += w.weight * std::cos(phase);
            imaginary += w.weight * std::sin(phase);
        }
        table_.push_back({glm::vec3(real), glm::vec3(imaginary)});
    }
}

FilmColours::Transform FilmColours::at(float path) const {
    const float position = path / step;
    if (!(position < static_cast<float>(table_.size() - 1))) return {};
    const auto below = static_cast<std::size_t>(position);
    const float part = position - static_cast<float>(below);
    const Transform &a = table_[below], &b = table_[below + 1];
    return {glm::mix(a.real, b.real, part), glm::mix(a.imaginary, b.imaginary, part)};
}

glm::vec3 FilmColours::reflectance(float outside, float film, const glm::vec3& k, float cos_theta,
                                   float thickness) const {
    // All grazing light is reflected; the formulas would be 0/0.
    if (!(cos_theta > 0.0f)) return glm::vec3(1.0f);
    constexpr int most_terms = 64;
    constexpr double negligible = 1e-8;  // of |x|²ᵐ
    glm::dvec3 sum(0.0);
    for (int colour = 0; colour < 3; ++colour) {
        const FilmFaces faces(static_cast<double>(outside), static_cast<double>(film),
                              {1.0, static_cast<double>(k[colour])}, static_cast<double>(std::min(cos_theta, 1.0f)));
        // Light that the film would reflect totally: all of it comes back, as if the film were thick.
        if (!(faces.inside.real > 0.0)) return glm::vec3(1.0f);
        const float path = 2.0f * thickness * static_cast<float>(faces.inside.real);
        for (int i = 0; i < 2; ++i) {
            const Complex x = Complex{-1.0} * faces.outer[i] * faces.inner[i];
            const double size2 = squared_magnitude(x);
            double series = 1.0;
            Complex power = x;
            for (int m = 1; m <= most_terms && squared_magnitude(power) > negligible; ++m) {
                const Transform w = at(static_cast<float>(m) * path);
                series += 2.0 * (power.real * static_cast<double>(w.real[colour]) -
                                 power.imaginary * static_cast<double>(w.imaginary[colour]));
                power = power * x;
            }
            const double passed = (1.0 - squared_magnitude(faces.outer[i])) * (1.0 - squared_magnitude(faces.inner[i]));
            sum[colour] += 0.5 * (1.0 - passed / std::max(1.0 - size2, 1e-12) * series);
        }
    }
    return glm::vec3(glm::clamp(sum, 0.0, 1.0));
}

}  // namespace phasetree::tracer
