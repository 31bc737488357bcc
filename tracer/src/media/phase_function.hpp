// The list of all phase functions, and a phase function of any kind by value.
#pragma once

#include <concepts>
#include <memory>
#include <variant>

#include "media/draine.hpp"
#include "media/droplets.hpp"
#include "media/henyey_greenstein.hpp"
#include "media/mixture_of_two.hpp"
#include "media/phase_function_contract.hpp"
#include "media/rayleigh.hpp"

namespace phasetree::tracer {

class PhaseFunction;

/// A mixture of two phase functions of any kind.
class MixedPhaseFunction {
  public:
    /// `share` is that of the second, from 0 to 1.
    MixedPhaseFunction(const PhaseFunction& first, const PhaseFunction& second, float share);

    float mean_cosine() const;
    float evaluate(float cosine) const;
    glm::vec3 sample(const glm::vec2& u) const;

  private:
    std::shared_ptr<const PhaseFunction> first_, second_;
    float share_;
};

template <PhaseFunctionKind... Kinds>
using PhaseFunctionOf = std::variant<Kinds...>;

/// Every kind of phase function. The first is the default, and isotropic by default.
using AnyPhaseFunction = PhaseFunctionOf<HenyeyGreenstein, Rayleigh, Draine, Droplets, MixedPhaseFunction>;

class PhaseFunction {
  public:
    PhaseFunction() = default;
    template <class Kind>
    requires(!std::same_as<Kind, PhaseFunction>) && PhaseFunctionKind<Kind> PhaseFunction(const Kind& kind)
        : kind_(kind) {}

    float mean_cosine() const {
        return std::visit([](const auto& kind) { return kind.mean_cosine(); }, kind_);
    }
    float evaluate(float cosine) const {
        return std::visit([&](const auto& kind) { return kind.evaluate(cosine); }, kind_);
    }
    glm::vec3 sample(const glm::vec2& u) const {
        return std::visit([&](const auto& kind) { return kind.sample(u); }, kind_);
    }

  private:
    AnyPhaseFunction kind_;
};

inline MixedPhaseFunction::MixedPhaseFunction(const PhaseFunction& first, const PhaseFunction& second, float share)
    : first_(std::make_shared<const PhaseFunction>(first)),
      second_(std::make_shared<const PhaseFunction>(second)),
      share_(share) {}
inline float MixedPhaseFunction::mean_cosine() const {
    return mixed(share_, first_->mean_cosine(), second_->mean_cosine());
}
inline float MixedPhaseFunction::evaluate(float cosine) const {
    return mixed(share_, first_->evaluate(cosine), second_->evaluate(cosine));
}
inline glm::vec3 MixedPhaseFunction::sample(const glm::vec2& u) const {
    return sample_of_two(share_, u, *first_, *second_);
}

}  // namespace phasetree::tracer
