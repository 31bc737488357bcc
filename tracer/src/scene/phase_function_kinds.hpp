// The kinds of phase functions in scene files: one list, from which the reader, the reference and the schema are
// derived. made() returns the phase function.
#pragma once

#include <type_traits>
#include <utility>
#include <variant>

#include "media/phase_function.hpp"
#include "phasetree/io/kind.hpp"
#include "scene/parameter_types.hpp"

namespace phasetree::tracer {

struct HenyeyGreensteinParameters {
    static constexpr KindInfo info{
        "henyey_greenstein",
        "A single lobe, forwards or backwards: milk, wax, smoke. `\"anisotropy\": g` is short "
        "for it.",
        "p(μ) = (1 − g²)/(4π (1 + g² − 2gμ)^(3/2))"};

    float g = 0.0f;

    template <class V>
    static void parameters(V&& v) {
        v(&HenyeyGreensteinParameters::g, Parameter{"g", "", "Mean cosine; positive values scatter forwards.",
                                                    Limits{.low = -0.99f, .high = 0.99f}, true});
    }
    HenyeyGreenstein made() const { return HenyeyGreenstein(g); }
};

struct RayleighParameters {
    static constexpr KindInfo info{"rayleigh",
                                   "Particles much smaller than the wavelength, such as molecules of air or the finest "
                                   "smoke. They scatter as much backwards as forwards, and half as much to the side.",
                                   "p(μ) = 3 (1 + μ²)/(16π)"};

    template <class V>
    static void parameters(V&&) {}
    Rayleigh made() const { return {}; }
};

struct DraineParameters {
    static constexpr KindInfo info{"draine",
                                   "Draine's phase function for dust: a lobe that scatters more light forwards and "
                                   "backwards than `henyey_greenstein`, and less to the side.",
                                   "p(μ) = 1/(4π) (1 − g²)/(1 + g² − 2gμ)^(3/2) (1 + α μ²)/(1 + α (1 + 2g²)/3)"};

    float g = 0.5f;
    float alpha = 1.0f;

    template <class V>
    static void parameters(V&& v) {
        using P = DraineParameters;
        v(&P::g, Parameter{"g", "",
                           "Shape of the lobe, as in `henyey_greenstein`; the mean cosine also depends on α. Values "
                           "within 0.001 of 0 count as 0.",
                           Limits{.low = -0.99f, .high = 0.99f}, true});
        v(&P::alpha, Parameter{"alpha", "", "α. With 0, it is `henyey_greenstein`; with 1 and g = 0, `rayleigh`.",
                               Limits{.low = 0, .high = 1000}, true});
    }
    Draine made() const { return {g, alpha}; }
};

struct DropletsParameters {
    static constexpr KindInfo info{"droplets",
                                   "Water droplets of one size, in fog and clouds: Jendersie and d'Eon's fit to Mie's "
                                   "theory (2023), a mixture of `henyey_greenstein` and `draine`. It has neither glory "
                                   "nor fogbow."};

    float diameter = 15.0f;

    template <class V>
    static void parameters(V&& v) {
        v(&DropletsParameters::diameter,
          Parameter{"diameter", "µm", "Diameter of the droplets: 5 to 15 in fog, 10 to 50 in clouds.",
                    Limits{.low = Droplets::least_diameter, .high = Droplets::greatest_diameter}, true});
    }
    Droplets made() const { return Droplets(diameter); }
};

struct MixedPhaseFunctionParameters {
    static constexpr KindInfo info{"mix",
                                   "A mix of two phase functions, such as one lobe forwards and one backwards. Either "
                                   "may be a mix itself.",
                                   "p(μ) = (1 − a) p₁(μ) + a p₂(μ)"};

    PhaseFunction first{};
    PhaseFunction second{};
    float amount = 0.5f;

    template <class V>
    static void parameters(V&& v) {
        using P = MixedPhaseFunctionParameters;
        v(&P::first, Parameter{"first", "", "Phase function where the amount is 0."});
        v(&P::second, Parameter{"second", "", "Phase function where the amount is 1."});
        v(&P::amount, Parameter{"amount", "", "a, the fraction of the scattered light that the second distributes.",
                                limits::fraction, true});
    }
    MixedPhaseFunction made() const { return {first, second, amount}; }
};

using PhaseFunctionKinds = TypeList<HenyeyGreensteinParameters, RayleighParameters, DraineParameters,
                                    DropletsParameters, MixedPhaseFunctionParameters>;

// A phase function missing from the list fails to compile here.
template <class... Kinds, class... Functions>
constexpr bool make_all_phase_functions(TypeList<Kinds...>, const std::variant<Functions...>*) {
    constexpr auto is_made = []<class F>(const F*) {
        return (std::is_same_v<F, decltype(std::declval<Kinds>().made())> || ...);
    };
    return (is_made(static_cast<const Functions*>(nullptr)) && ...);
}
static_assert(make_all_phase_functions(PhaseFunctionKinds(), static_cast<AnyPhaseFunction*>(nullptr)),
              "every phase function has a kind in the list");

}  // namespace phasetree::tracer
