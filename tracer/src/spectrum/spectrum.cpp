#include "spectrum/spectrum.hpp"

#include <algorithm>

namespace phasetree::tracer {

Spectrum::Spectrum(std::vector<Point> points) : points_(std::move(points)) {
    colour_ = glm::vec3(colour_of([this](double nanometres) { return at(static_cast<float>(nanometres)); }));
}

float Spectrum::at(float nanometres) const {
    const auto above = std::ranges::upper_bound(points_, nanometres, {}, &Point::nanometres);
    if (above == points_.begin()) return above->value;
    const auto below = above - 1;
    if (above == points_.end()) return below->value;
    const float part = (nanometres - below->nanometres) / (above->nanometres - below->nanometres);
    return below->value + part * (above->value - below->value);
}

glm::vec3 Spectrum::at(const Wavelengths& wavelengths) const {
    const glm::vec3& nm = wavelengths.nanometres;
    return {at(nm.x), at(nm.y), at(nm.z)};
}

float Spectrum::greatest() const {
    return std::ranges::max_element(points_, {}, &Point::value)->value;
}

}  // namespace phasetree::tracer
