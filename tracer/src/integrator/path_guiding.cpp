#include "integrator/path_guiding.hpp"

namespace phasetree::tracer {

namespace {

// Only opaque surfaces that receive light from nearly all directions are guided; elsewhere the BSDF is better. Media
// are not guided: a path is scattered there many times, and each guided direction widens the spread of path weights.
// For a body of jade, guiding increased the variance sevenfold.
bool can_be_guided(const Surface& surface, const Bsdf& bsdf) {
    return !surface.far_side && bsdf.is_diffuse();
}

}  // namespace

const DirectionTree* PathGuiding::at(const Surface& surface, const Bsdf& bsdf) const {
    if (!guide_ || !may_differ() || !can_be_guided(surface, bsdf)) return nullptr;
    return guide_->at(surface.near_side.origin, facing_of(surface.geometric_normal));
}

void PathGuiding::leave(const Surface& surface, const Bsdf& bsdf, const GuidedBsdf::Sample& next,
                        const glm::vec3& direction, const glm::vec3& throughput) {
    pdf_over_unguided_ *= next.pdf_over_unguided;
    if (samples_ && !next.delta && can_be_guided(surface, bsdf))
        samples_->leave(surface.near_side.origin, facing_of(surface.geometric_normal), direction, next.wi.z / next.pdf,
                        brightness(throughput, is_spectral_));
}

}  // namespace phasetree::tracer
