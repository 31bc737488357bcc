#include "shading/thin_film.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "shading/film_faces.hpp"
#include "spectrum/colour_matching.hpp"

namespace phasetree::tracer {

namespace {

// Airy's sum.
struct Faces : FilmFaces {
    using FilmFaces::FilmFaces;

    // Whether there is neither absorption nor total reflection. Then the faces' coefficients have no phase, and Airy's
    // sum is real, with |e^{iδ}| = 1:  |a + b e^{iδ}|² = a² + b² + 2ab cos δ.
    bool is_real() const {
        for (const Complex& z : {inside, outer[0], outer[1], inner[0], inner[1]})
            if (z.imaginary != 0.0) return false;
        return true;
    }
    double real_reflectance(double thickness, double wavelength) const {
        const double cosine = std::cos(4.0 * std::numbers::pi * thickness / wavelength * inside.real);
        double sum = 0.0;
        for (int i = 0; i < 2; ++i) {
            const double a = outer[i].real, b = inner[i].real, mixed = 2.0 * a * b * cosine;
            sum += 0.5 * (a * a + b * b + mixed) / (1.0 + a * a * b * b + mixed);
        }
        return std::min(sum, 1.0);
    }

    double reflectance(double thickness, double wavelength) const {
        const Complex phase = exp(Complex{0.0, 4.0 * std::numbers::pi * thickness / wavelength} * inside);
        double sum = 0.0;
        for (int i = 0; i < 2; ++i) {
            const Complex again = inner[i] * phase;
            sum += 0.5 * squared_magnitude((outer[i] + again) / (Complex{1.0} + outer[i] * again));
        }
        return std::min(sum, 1.0);
    }
};

glm::vec3 colour(const ThinFilm::Layers& layers, const std::vector<SpectralWeight>& weights, double cos_theta,
                 double thickness) {
    // All grazing light is reflected; the formulas would be 0/0.
    if (!(cos_theta > 0.0)) return glm::vec3(1.0f);
    const bool grey = layers.eta == glm::vec3(layers.eta.x) && layers.k == glm::vec3(layers.k.x);
    glm::dvec3 sum(0.0);
    for (int c = 0; c < (grey ? 1 : 3); ++c) {
        const Faces faces(static_cast<double>(layers.outside), static_cast<double>(layers.film),
                          {static_cast<double>(layers.eta[c]), static_cast<double>(layers.k[c])}, cos_theta);
        const bool is_real = faces.is_real();
        for (const SpectralWeight& w : weights) {
            const double reflectance =
                is_real ? faces.real_reflectance(thickness, w.wavelength) : faces.reflectance(thickness, w.wavelength);
            if (grey)
                sum += reflectance * w.weight;
            else
                sum[c] += reflectance * w.weight[c];
        }
    }
    return glm::clamp(glm::vec3(sum), 0.0f, 1.0f);
}

}  // namespace

double thin_film_reflectance(double outside, double film, double behind_eta, double behind_k, double cos_theta,
                             double thickness, double wavelength) {
    return Faces(outside, film, {behind_eta, behind_k}, cos_theta).reflectance(thickness, wavelength);
}

ThinFilm::ThinFilm(const Layers& layers, float least_thickness, float greatest_thickness)
    : layers_(layers), least_(least_thickness) {
    // R oscillates with the period λ/(2 n₂), some 150 nm; the error of linear interpolation over this step is less than
    // a thousandth.
    constexpr float widest_step = 4.0f;
    const float range = greatest_thickness - least_thickness;
    const int intervals = range > 0.0f ? static_cast<int>(std::ceil(range / widest_step)) : 0;
    if (intervals > 0) step_ = range / static_cast<float>(intervals);
    const std::vector<SpectralWeight> weights = spectral_weights();
    for (int row = 0; row <= intervals; ++row) {
        const double thickness = static_cast<double>(least_ + step_ * static_cast<float>(row));
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < cosines; ++i) {
            const double cosine = static_cast<double>(i) / (cosines - 1);
            table_.push_back(colour(layers, weights, cosine, thickness));
            // Trapezoidal rule for 2 ∫ R μ dμ. Both ends are included, and μ is 0 at the first.
            sum += 2.0 * cosine * glm::dvec3(table_.back()) * (i + 1 == cosines ? 0.5 : 1.0) / (cosines - 1.0);
        }
        averages_.emplace_back(sum);
    }
}

std::size_t ThinFilm::row_of(float thickness, float& part) const {
    part = 0.0f;
    if (averages_.size() == 1) return 0;
    const float position = std::clamp((thickness - least_) / step_, 0.0f, static_cast<float>(averages_.size() - 1));
    const std::size_t row = std::min(static_cast<std::size_t>(position), averages_.size() - 2);
    part = position - static_cast<float>(row);
    return row;
}

glm::vec3 ThinFilm::reflectance_at(const glm::vec3& nanometres, const glm::vec3& eta, const glm::vec3& k,
                                   float cos_theta, float thickness) const {
    if (!(cos_theta > 0.0f)) return glm::vec3(1.0f);
    const auto faces_before = [&](int i) {
        return Faces(static_cast<double>(layers_.outside), static_cast<double>(layers_.film),
                     {static_cast<double>(eta[i]), static_cast<double>(k[i])},
                     static_cast<double>(std::min(cos_theta, 1.0f)));
    };
    const bool is_alike = eta == glm::vec3(eta.x) && k == glm::vec3(k.x);
    Faces faces = faces_before(0);
    glm::vec3 reflectance;
    for (int i = 0; i < 3; ++i) {
        if (i > 0 && !is_alike) faces = faces_before(i);
        const double nm = static_cast<double>(nanometres[i]), thick = static_cast<double>(thickness);
        reflectance[i] =
            static_cast<float>(faces.is_real() ? faces.real_reflectance(thick, nm) : faces.reflectance(thick, nm));
    }
    return reflectance;
}

glm::vec3 ThinFilm::reflectance(float cos_theta, float thickness) const {
    const float position = std::clamp(cos_theta, 0.0f, 1.0f) * static_cast<float>(cosines - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(position), cosines - 2);
    const float between = position - static_cast<float>(below);
    const auto in_row = [&](std::size_t row) {
        const glm::vec3* at = &table_[row * cosines + below];
        return glm::mix(at[0], at[1], between);
    };
    float part = 0.0f;
    const std::size_t row = row_of(thickness, part);
    return part > 0.0f ? glm::mix(in_row(row), in_row(row + 1), part) : in_row(row);
}

glm::vec3 ThinFilm::average(float thickness) const {
    float part = 0.0f;
    const std::size_t row = row_of(thickness, part);
    return part > 0.0f ? glm::mix(averages_[row], averages_[row + 1], part) : averages_[row];
}

}  // namespace phasetree::tracer
