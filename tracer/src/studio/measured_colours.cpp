#include "studio/measured_colours.hpp"

#include <algorithm>
#include <cmath>

#include "media/measured.hpp"
#include "shading/metals.hpp"

namespace phasetree::tracer::studio {

namespace {

double reflectance_of_metal(double eta, double k) {
    return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
}

// The diffuse reflectance of a half-space: Jensen et al. 2001, equations 6 and 15, for the index 1.3.
double reflectance_of_medium(double reduced_scattering, double absorption) {
    constexpr double index = 1.3;
    constexpr double internal = -1.440 / (index * index) + 0.710 / index + 0.668 + 0.0636 * index;
    constexpr double mismatch = (1 + internal) / (1 - internal);
    const double albedo = reduced_scattering / (reduced_scattering + absorption);
    const double root = std::sqrt(3 * (1 - albedo));
    return albedo / 2 * (1 + std::exp(-4.0 / 3 * mismatch * root)) * std::exp(-root);
}

template <class Reflectance>
glm::vec3 each(const glm::vec3& a, const glm::vec3& b, const Reflectance& reflectance) {
    glm::vec3 colour;
    for (int i = 0; i < 3; ++i)
        colour[i] =
            static_cast<float>(std::clamp(reflectance(static_cast<double>(a[i]), static_cast<double>(b[i])), 0.0, 1.0));
    return colour;
}

}  // namespace

std::vector<MeasuredColour> measured_colours() {
    std::vector<MeasuredColour> colours;
    for (const Metal& metal : metals())
        colours.push_back({std::string(metal.name), "metals", each(metal.eta, metal.k, reflectance_of_metal)});
    for (const MeasuredMedium& medium : measured_media())
        colours.push_back({std::string(medium.name), "materials",
                           each(medium.reduced_scattering, medium.absorption, reflectance_of_medium)});
    return colours;
}

}  // namespace phasetree::tracer::studio
