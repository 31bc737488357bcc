// What sampling a BSDF gives.
//
// The frame of all BSDFs: z is the surface normal on the side the ray came from. `wo` points back along the ray, so
// wo.z > 0; `wi` is where the path goes on. wi.z > 0 is reflection, wi.z < 0 transmission. "From" is the medium of wo,
// "to" the one behind the surface.
//
// Radiance is carried from the camera's side. Across a refracting interface radiance scales with the square of the
// index: L_from = T · L_to · (η_from/η_to)², and the weight of a transmitted sample contains that factor.
#pragma once

#include <glm/vec3.hpp>

namespace phasetree::tracer {

struct BsdfSample {
    glm::vec3 wi;
    glm::vec3 weight;  ///< f |cos θi| / pdf
    float pdf;         ///< per solid angle; of a delta lobe, the probability with which it was chosen
    bool delta;
    bool transmitted;
};

}  // namespace phasetree::tracer
