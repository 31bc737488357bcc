// Caustics: light that reaches surfaces and media through clear interfaces, curved or rough, or by reflection from
// metal, found by photons.
//
// Each pass over the picture has photons of its own. Their number, and the gathering radius, depend only on the number
// of the pass and on the whole picture, so that an image does not depend on how it was divided among threads, crops or
// machines. The radius shrinks from pass to pass, r = r₀ (1 + pass)^(−1/6), so that the blur of the photons vanishes in
// the limit (Hachisuka, Ogaki & Jensen: Progressive Photon Mapping, SIGGRAPH Asia 2008; Knaus & Zwicker, TOG 30(3),
// 2011, with α = 2/3).
#pragma once

#include <functional>
#include <optional>

#include "caustics/emission.hpp"
#include "caustics/photon_map.hpp"

namespace phasetree::tracer {

class Caustics {
  public:
    /// Traces photons to learn which sources, and which bins of their directions, contribute. Refers to the world and
    /// the scene.
    Caustics(const World& world, const Scene& scene);

    /// Traces the photons of the pass that adds the sample with this number to each pixel. Uses all threads of the
    /// calling arena. Returns nullopt if `cancelled` returns true; it may be called from any thread.
    std::optional<PhotonMap> photons(int pass, PathCounters& counters, const std::function<bool()>& cancelled) const;
    const PhotonEmission& emission() const { return emission_; }
    float radius(int pass) const;
    /// The time of all photons of a pass, as a share of the shutter interval. A photon lights what is there at its own
    /// time, so the paths that gather the photons of a pass must have the same time. The times of the passes are spread
    /// evenly.
    float time(int pass) const;
    /// The wavelengths of all light of a pass. Photons and the paths that gather them must have the same ones. Those of
    /// consecutive passes are spread evenly. nullopt if the scene needs none.
    std::optional<Wavelengths> wavelengths(int pass) const;

  private:
    TracedPhotons traced(std::uint32_t pass, std::size_t from, std::size_t to, PathCounters& counters) const;
    void learn();
    double worth_of(const Photon& photon, float expected, float pdf) const;

    const World& world_;
    const Scene& scene_;
    PhotonEmission emission_;
    std::size_t photons_per_pass_;
    float first_radius_;
};

}  // namespace phasetree::tracer
