// Fresnel's equations for unpolarised light.
//
// `eta` is always the index behind the interface divided by the index on the ray's side. With c = cos θ, sin²θ' = (1 −
// c²)/η² and c' = cos θ':
//
//   r∥ = (η c − c') / (η c + c'),   r⊥ = (c − η c') / (c + η c'),   F = (r∥² + r⊥²) / 2
//
// and the same with a complex η + ik for conductors, written in real arithmetic.
//
// Reference: Born & Wolf, Principles of Optics, 7th ed., 1.5.2, 1.5.4 and 14.4.
#pragma once

#include <glm/vec3.hpp>

namespace phasetree::tracer {

struct DielectricFresnel {
    float reflectance;      ///< exactly 1 in total internal reflection
    float cos_transmitted;  ///< ≥ 0; 0 in total internal reflection
};

/// `cos_theta` in [0, 1].
DielectricFresnel fresnel_dielectric(float cos_theta, float eta);

float fresnel_conductor(float cos_theta, float eta, float k);
glm::vec3 fresnel_conductor(float cos_theta, const glm::vec3& eta, const glm::vec3& k);

/// k of the index 1 + ik that reflects this part of the light at normal incidence: k² = 4 r / (1 − r). No such index
/// reflects all light, so the reflectance is clamped to 0.9999.
float k_of_reflectance(float reflectance);
glm::vec3 k_of_reflectance(const glm::vec3& reflectance);

}  // namespace phasetree::tracer
