// The directions in which a path goes on from a surface, chosen by its BSDF alone, or half by that and half by a guide
// (guiding/guide.hpp). The two together have one density, the mean of theirs, which enters the weights of shadow rays,
// photons and directions. So a bad guide costs noise and never shifts the mean.
//
// A guide knows nothing of smooth coats: where there is one, it leaves half as many directions for the coat's mirror.
#pragma once

#include <optional>

#include "guiding/direction_tree.hpp"
#include "shading/bsdf.hpp"
#include "shading/frame.hpp"

namespace phasetree::tracer {

class GuidedBsdf {
  public:
    /// For light that leaves in the direction `wo` of the frame. It refers to the BSDF, the frame and the guide;
    /// without a guide (null) all is as the BSDF has it.
    GuidedBsdf(const Bsdf& bsdf, const Frame& frame, const glm::vec3& wo, const DirectionTree* guide)
        : bsdf_(bsdf), frame_(frame), wo_(wo), guide_(guide) {}

    const Bsdf& bsdf() const { return bsdf_; }
    const Frame& frame() const { return frame_; }
    const glm::vec3& wo() const { return wo_; }
    const DirectionTree* guide() const { return guide_; }

    /// As Bsdf has it, for a direction of the frame.
    glm::vec3 evaluate(const glm::vec3& wi) const { return bsdf_.evaluate(wo_, wi); }
    /// The density of sample(), delta lobes left out. `world` is `wi` in world space.
    float pdf(const glm::vec3& wi, const glm::vec3& world) const { return mixed(bsdf_.pdf(wo_, wi), world); }

    struct Sample : BsdfSample {
        /// The density of `wi` over that with which the BSDF alone would choose it. A guide changes it, and so do the
        /// lights at smooth interfaces (interface_choice.hpp); it is never less than a half.
        float pdf_over_unguided = 1;

        /// It was chosen so many times as often as the BSDF alone would have chosen it.
        void count_as_chosen(float odds) {
            weight /= odds;
            pdf *= odds;
            pdf_over_unguided *= odds;
        }
    };
    /// Nothing if the path ends here.
    std::optional<Sample> sample(float u_lobe, const glm::vec2& u) const {
        if (guide_ && u_lobe < guided_share) return sampled_by_guide(u);
        const auto next = sampled_by_bsdf(u_lobe, u);
        if (!next) return std::nullopt;
        if (!guide_) return Sample{*next};
        // A guide never chooses the one direction of a delta lobe.
        return as_chosen_with(
            next->delta ? (1.0f - guided_share) * next->pdf : mixed(next->pdf, frame_.to_world(next->wi)), *next);
    }
    /// What the BSDF alone would choose by the same numbers.
    std::optional<BsdfSample> unguided_sample(float u_lobe, const glm::vec2& u) const {
        return guide_ && u_lobe < guided_share ? bsdf_.sample(wo_, u_lobe / guided_share, u)
                                               : sampled_by_bsdf(u_lobe, u);
    }

  private:
    static constexpr float guided_share = 0.5f;

    static float mean(float by_bsdf, float by_guide) {
        return (1.0f - guided_share) * by_bsdf + guided_share * by_guide;
    }
    float mixed(float by_bsdf, const glm::vec3& world) const {
        return guide_ ? mean(by_bsdf, guide_->pdf(world)) : by_bsdf;
    }
    static Sample as_chosen_with(float pdf, const BsdfSample& by_bsdf) {
        Sample next{by_bsdf};
        next.count_as_chosen(pdf / by_bsdf.pdf);
        next.pdf = pdf;  // without the rounding of the quotient
        return next;
    }
    std::optional<BsdfSample> sampled_by_bsdf(float u_lobe, const glm::vec2& u) const {
        return bsdf_.sample(wo_, guide_ ? (u_lobe - guided_share) / (1.0f - guided_share) : u_lobe, u);
    }
    std::optional<Sample> sampled_by_guide(const glm::vec2& u) const {
        const DirectionTree::Sample chosen = guide_->sample(u);
        const glm::vec3 wi = frame_.to_local(chosen.direction);
        const glm::vec3 f = evaluate(wi);
        const float by_bsdf = bsdf_.pdf(wo_, wi);
        if (f == glm::vec3(0.0f) || !(by_bsdf > 0.0f)) return std::nullopt;
        return as_chosen_with(mean(by_bsdf, chosen.pdf), {wi, f / by_bsdf, by_bsdf, false, wi.z < 0.0f});
    }

    const Bsdf& bsdf_;
    const Frame& frame_;
    glm::vec3 wo_;
    const DirectionTree* guide_;
};

}  // namespace phasetree::tracer
