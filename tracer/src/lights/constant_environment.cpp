#include "lights/constant_environment.hpp"

#include "image/luminance.hpp"
#include "lights/check.hpp"
#include "sampling/warps.hpp"

namespace phasetree::tracer {

ConstantEnvironment::ConstantEnvironment(const glm::vec3& radiance) : radiance_(radiance) {
    check_colour(radiance, "the environment's radiance");
}

glm::vec3 ConstantEnvironment::radiance(const glm::vec3&) const {
    return radiance_;
}

std::optional<DirectionSample> ConstantEnvironment::sample(const glm::vec2& u) const {
    return DirectionSample{square_to_uniform_sphere(u), uniform_sphere_pdf()};
}

float ConstantEnvironment::pdf(const glm::vec3&) const {
    return uniform_sphere_pdf();
}

float ConstantEnvironment::fluence() const {
    return luminance(radiance_) / uniform_sphere_pdf();
}

}  // namespace phasetree::tracer
