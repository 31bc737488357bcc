// The result of sampling a BSDF.
//
// The frame of all BSDFs: z is the surface normal on the side from which the ray came. `wo` points back along the ray,
// so wo.z > 0; `wi` is the direction in which the path continues. wi.z > 0 is reflection, wi.z < 0 transmission. "From"
// is the medium of wo, "to" the one behind the surface.
//
// Weights are for radiance, with paths traced from the camera. Refraction scales radiance by the square of the index:
// L_from = T · L_to · (η_from/η_to)², and the weight of a transmitted sample contains that factor.
#pragma once

#include <glm/vec3.hpp>

namespace phasetree::tracer {

struct BsdfSample {
    glm::vec3 wi;
    glm::vec3 weight;  ///< f |cos θi| / pdf
    float pdf;         ///< per steradian; for a delta lobe, the probability of choosing it
    bool delta;
    bool transmitted;
};

}  // namespace phasetree::tracer
