#include "spectrum/spectrum.hpp"

#include <algorithm>

namespace phasetree::tracer {

Spectrum::Spectrum(std::vector<Point> points) : points_(std::move(points)) {
    colour_ = glm::vec3(colour_of([this](double nanometres) { return mean_around(nanometres); }));
}

float Spectrum::at(float nanometres) const {
    const auto above = std::ranges::upper_bound(points_, nanometres, {}, &Point::nanometres);
    if (above == points_.begin()) return above->value;
    const auto below = above - 1;
    if (above == points_.end()) return below->value;
    const float part = (nanometres - below->nanometres) / (above->nanometres - below->nanometres);
    return below->value + part * (above->value - below->value);
}

double Spectrum::mean_around(double nanometres) const {
    const double from = nanometres - 0.5, to = nanometres + 0.5;
    double last = from, last_value = static_cast<double>(at(static_cast<float>(from))), sum = 0.0;
    const auto go_to = [&](double nm, double value) {
        sum += 0.5 * (last_value + value) * (nm - last);
        last = nm;
        last_value = value;
    };
    auto point = std::ranges::upper_bound(points_, from, {}, [](const Point& p) { return double{p.nanometres}; });
    for (; point != points_.end() && double{point->nanometres} < to; ++point)
        go_to(double{point->nanometres}, double{point->value});
    go_to(to, static_cast<double>(at(static_cast<float>(to))));
    return sum;
}

glm::vec3 Spectrum::at(const Wavelengths& wavelengths) const {
    const glm::vec3& nm = wavelengths.nanometres;
    return {at(nm.x), at(nm.y), at(nm.z)};
}

float Spectrum::greatest() const {
    return std::ranges::max_element(points_, {}, &Point::value)->value;
}

}  // namespace phasetree::tracer
