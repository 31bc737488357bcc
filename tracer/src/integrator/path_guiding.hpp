// What a path has to do with guides (guiding/guide.hpp): at which surfaces it asks one, and what it reports for the
// next guide. It also keeps how far guides, and the choice by lights at smooth interfaces (interface_choice.hpp), have
// led the path from where BSDFs alone would have sent it.
#pragma once

#include "film/path_record.hpp"
#include "guiding/guide.hpp"
#include "guiding/path_findings.hpp"
#include "image/luminance.hpp"
#include "integrator/guided.hpp"
#include "world/hit.hpp"

namespace phasetree::tracer {

class PathGuiding {
  public:
    /// Either may be null: then the path asks no guide, or reports nothing.
    PathGuiding(const Guide* guide, PathFindings* findings, bool is_spectral)
        : guide_(guide), findings_(findings), is_spectral_(is_spectral) {}

    /// The density of directions that takes part in the choice at a surface; null if only the BSDF chooses.
    const DirectionTree* at(const Surface& surface, const Bsdf& bsdf) const {
        if (!guide_ || !may_differ() || !can_be_guided(surface, bsdf)) return nullptr;
        return guide_->at(surface.near_side.origin, facing_of(surface.geometric_normal));
    }
    /// Whether the path may still choose otherwise than BSDFs would.
    bool may_differ() const { return pdf_over_unguided_ >= least_pdf_over_unguided; }
    /// The path leaves a surface in this direction of world space, with this throughput, before roulette.
    void leave(const Surface& surface, const Bsdf& bsdf, const GuidedBsdf::Sample& next, const glm::vec3& direction,
               const glm::vec3& throughput) {
        pdf_over_unguided_ *= next.pdf_over_unguided;
        if (findings_ && !next.delta && can_be_guided(surface, bsdf))
            findings_->leave(surface.near_side.origin, facing_of(surface.geometric_normal), direction,
                             next.wi.z / next.pdf, brightness(throughput, is_spectral_));
    }
    /// The path brings radiance, of its wavelengths if it has any, as the throughput is that leave() is told.
    void add_light(const glm::vec3& radiance) {
        if (findings_) findings_->add_light(brightness(radiance, is_spectral_));
    }

    /// The product of GuidedBsdf::Sample::pdf_over_unguided over the path: the throughput times this is what it would
    /// be had the BSDFs chosen the same directions.
    float pdf_over_unguided() const { return pdf_over_unguided_; }

  private:
    // Once the product falls below this a path chooses as BSDFs do. A guide that is wrong, or a lamp that is hidden
    // (interface_choice.hpp), may double a path's weight at each surface, once more after it has grown so far.
    static constexpr float least_pdf_over_unguided = 2.0f / PathRecord::weight_limit;

    // An opaque surface that gets light from nearly all directions. Elsewhere the BSDF knows better. No medium is one:
    // a path is scattered there many times, and each guided direction spreads the weights of paths further. Of a body
    // of jade the variance was seven times that without a guide.
    static bool can_be_guided(const Surface& surface, const Bsdf& bsdf) {
        return !surface.far_side && bsdf.is_diffuse();
    }

    const Guide* guide_;
    PathFindings* findings_;
    bool is_spectral_;
    float pdf_over_unguided_ = 1;
};

}  // namespace phasetree::tracer
