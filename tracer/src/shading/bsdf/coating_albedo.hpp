// How much light a dielectric coating reflects, averaged as the layer below it needs.
//
//   E(μ)   the coating's directional albedo from outside: Fresnel's F(μ) when smooth; when rough the GGX integral of F
//          over the visible normals, tabulated
//   E_avg  = 2 ∫ E(μ) μ dμ, the albedo under uniform light
//   F_int  = 1 − (1 − E_avg)/η², the part of diffuse light from inside that is reflected back inside, by reciprocity
//
// η is the coating's index relative to the clear medium it touches. Less than 1 is possible (varnish under a denser
// liquid): then E is 1 beyond the critical angle, and the equations still hold.
//
// Reference for the reciprocity: Egan & Hilgeman, Optical Properties of Inhomogeneous Materials, 1979, chapter 6.
#pragma once

#include <array>
#include <cstddef>

namespace phasetree::tracer {

class CoatingAlbedo {
  public:
    /// `roughness` is GGX's α; 0 is smooth.
    CoatingAlbedo(float eta, float roughness);

    float eta() const { return eta_; }
    float roughness() const { return roughness_; }
    float directional(float cos_theta) const;  ///< E(μ)
    float average() const { return average_; }
    float internal() const { return internal_; }

  private:
    static constexpr std::size_t nodes = 64;  ///< at μ = (i / (nodes − 1))², dense where E is steep

    float eta_;
    float roughness_;
    float average_ = 0.0f;
    float internal_ = 0.0f;
    std::array<float, nodes> table_{};
};

}  // namespace phasetree::tracer
