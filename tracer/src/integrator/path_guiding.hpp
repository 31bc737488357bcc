// Connects a path to guides (guiding/guide.hpp): at which surfaces a guide is used, and what is reported to train the
// next one. Also tracks how far guides, and the choice by lights at smooth interfaces (interface_choice.hpp), have
// changed the pdf of the path from that of the BSDFs alone.
#pragma once

#include "film/path_record.hpp"
#include "guiding/guide.hpp"
#include "guiding/path_guide_samples.hpp"
#include "image/luminance.hpp"
#include "integrator/guided.hpp"
#include "world/hit.hpp"

namespace phasetree::tracer {

class PathGuiding {
  public:
    /// Both may be null, which disables guiding or reporting.
    PathGuiding(const Guide* guide, PathGuideSamples* samples, bool is_spectral)
        : guide_(guide), samples_(samples), is_spectral_(is_spectral) {}

    /// The guide's distribution of directions at a surface; null if only the BSDF chooses.
    const DirectionTree* at(const Surface& surface, const Bsdf& bsdf) const;
    /// Whether the path may still deviate from the pdfs of the BSDFs.
    bool may_differ() const { return pdf_over_unguided_ >= least_pdf_over_unguided; }
    /// Reports that the path leaves a surface in this direction of world space, with this throughput, before roulette.
    void leave(const Surface& surface, const Bsdf& bsdf, const GuidedBsdf::Sample& next, const glm::vec3& direction,
               const glm::vec3& throughput);
    /// Reports radiance that the path found. If the path is spectral, it is in the path's wavelengths, like the
    /// throughput passed to leave().
    void add_light(const glm::vec3& radiance) {
        if (samples_) samples_->add_light(brightness(radiance, is_spectral_));
    }

    /// The product of GuidedBsdf::Sample::pdf_over_unguided over the path. Multiplied by it, the throughput is what it
    /// would be if the BSDFs had chosen the same directions.
    float pdf_over_unguided() const { return pdf_over_unguided_; }

  private:
    // Once the product falls below this, a path samples from the BSDFs alone. A wrong guide, or an occluded lamp
    // (interface_choice.hpp), may double a path's weight at each surface. The last doubling may start right at this
    // limit, so the limit is twice 1/weight_limit.
    static constexpr float least_pdf_over_unguided = 2.0f / PathRecord::weight_limit;

    const Guide* guide_;
    PathGuideSamples* samples_;
    bool is_spectral_;
    float pdf_over_unguided_ = 1;
};

}  // namespace phasetree::tracer
