#include "lights/ies_light.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "parameters/named_file.hpp"
#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

}  // namespace

IesLight::IesLight(const glm::vec3& position, const glm::vec3& target, float turn_degrees,
                   std::shared_ptr<const IesProfile> profile, const glm::vec3& intensity)
    : position_(position), intensity_(intensity), profile_(std::move(profile)) {
    check_point(position, "the IES light's position");
    check_point(target, "the IES light's target");
    check_colour(intensity, "the IES light's intensity");
    down_ = glm::normalize(glm::dvec3(target) - glm::dvec3(position));
    const glm::dvec3 up = -down_;
    const glm::dvec3 across = glm::cross(glm::dvec3(0.0, 1.0, 0.0), up);
    // A luminaire that points along y also has +x in its 0° plane.
    const glm::dvec3 x = glm::length(across) > 1e-6 ? glm::normalize(across) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 y = glm::cross(up, x);
    const double turn = std::remainder(static_cast<double>(turn_degrees), 360.0) * degree;
    first_ = std::cos(turn) * x + std::sin(turn) * y;
    second_ = std::cos(turn) * y - std::sin(turn) * x;
}

glm::vec3 IesLight::intensity(const glm::vec3& away) const {
    const glm::dvec3 w(away);
    const double along = glm::dot(w, down_), x = glm::dot(w, first_), y = glm::dot(w, second_);
    const double vertical = portable::atan2(portable::hypot(x, y), along) / degree;
    const double horizontal = portable::atan2(y, x) / degree;
    return intensity_ * profile_->relative_intensity(vertical, horizontal);
}

void IesLightParameters::check() const {
    if (!(glm::length(target - position) > 0))
        throw ParameterError("target", "\"target\" must differ from the light's position");
}

IesLight IesLightParameters::made() const {
    check();
    const std::string text = read_whole_file(file, std::uintmax_t{1} << 20, "1 MiB");
    try {
        return IesLight(position, target, turn_degrees, std::make_shared<const IesProfile>(text), color * intensity);
    } catch (const std::runtime_error& e) {
        throw ParameterError("file", fmt::format("cannot use the photometric file {}: {}", file.string(), e.what()));
    }
}

}  // namespace phasetree::tracer
