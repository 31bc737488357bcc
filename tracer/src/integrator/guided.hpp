// Chooses the direction in which a path leaves a surface: by the BSDF alone, or with equal probability by the BSDF or a
// guide (guiding/guide.hpp). The pdf of the mixture is the mean of both pdfs. It enters the MIS weights of shadow rays,
// photons and sampled directions, so a bad guide adds noise but no bias.
//
// Guides ignore smooth coats. On a coated surface, the guide's half of the choices never samples the coat's specular
// reflection, which is therefore sampled half as often.
#pragma once

#include <optional>

#include "guiding/direction_tree.hpp"
#include "shading/bsdf.hpp"
#include "shading/frame.hpp"

namespace phasetree::tracer {

class GuidedBsdf {
  public:
    /// For light that leaves in the direction `wo`, in the frame. Keeps references to the BSDF, the frame and the
    /// guide, which must outlive it. If the guide is null, all members behave as those of the BSDF.
    GuidedBsdf(const Bsdf& bsdf, const Frame& frame, const glm::vec3& wo, const DirectionTree* guide)
        : bsdf_(bsdf), frame_(frame), wo_(wo), guide_(guide) {}

    const Bsdf& bsdf() const { return bsdf_; }
    const Frame& frame() const { return frame_; }
    const glm::vec3& wo() const { return wo_; }
    const DirectionTree* guide() const { return guide_; }

    /// See Bsdf; `wi` is in the frame.
    glm::vec3 evaluate(const glm::vec3& wi) const { return bsdf_.evaluate(wo_, wi); }
    /// The pdf of sample() without delta lobes. `world` is `wi` in world space.
    float pdf(const glm::vec3& wi, const glm::vec3& world) const { return mixed(bsdf_.pdf(wo_, wi), world); }

    struct Sample : BsdfSample {
        /// The pdf of `wi` divided by the pdf with which the BSDF alone would choose it. It differs from 1 only where a
        /// guide, or the choice by lights at a smooth interface (interface_choice.hpp), changed the probability. It is
        /// never less than a half.
        float pdf_over_unguided = 1;

        /// Accounts for choosing this sample `ratio` times as often as the BSDF alone would have.
        void count_as_chosen(float ratio) {
            weight /= ratio;
            pdf *= ratio;
            pdf_over_unguided *= ratio;
        }
    };
    /// nullopt if the path ends here.
    std::optional<Sample> sample(float u_lobe, const glm::vec2& u) const {
        if (guide_ && u_lobe < guided_share) return sampled_by_guide(u);
        const auto next = sampled_by_bsdf(u_lobe, u);
        if (!next) return std::nullopt;
        if (!guide_) return Sample{*next};
        // A guide never samples the direction of a delta lobe.
        return as_chosen_with(
            next->delta ? (1.0f - guided_share) * next->pdf : mixed(next->pdf, frame_.to_world(next->wi)), *next);
    }
    /// The sample that the BSDF alone would return for the same random numbers.
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
