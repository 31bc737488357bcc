// Caustics: light that lamps throw through clear interfaces, curved or rough, found by photons.
//
// Each pass over the picture has photons of its own. How many there are, and in what radius a surface gathers them,
// follows from the number of the pass and from the whole picture, so that an image does not depend on how it was
// divided among threads, crops or machines. The radius shrinks as the passes go on, r = r₀ (1 + pass)^(−1/6), so that
// the blur that photons bring vanishes in the limit (Hachisuka, Ogaki & Jensen: Progressive Photon Mapping, SIGGRAPH
// Asia 2008; Knaus & Zwicker, TOG 30(3), 2011, with α = 2/3).
#pragma once

#include <functional>
#include <optional>

#include "caustics/emission.hpp"
#include "caustics/photon_map.hpp"

namespace phasetree::tracer {

class Caustics {
  public:
    /// Traces photons to learn where they are worth something. Refers to the world and the scene.
    Caustics(const World& world, const Scene& scene);

    /// The photons of the pass that adds the sample of this number to each pixel. Uses all threads of the arena that it
    /// is called in. Nothing if `cancelled` says so; it may be asked from any thread.
    std::optional<PhotonMap> photons(int pass, PathCounters& counters, const std::function<bool()>& cancelled) const;
    const PhotonEmission& emission() const { return emission_; }
    float radius(int pass) const;
    /// When all photons of a pass fly, as a share of the time in which the shutter is open: a photon lights what is
    /// there at its own time, so the paths that gather those of a pass must be of that time, too. Passes are spread
    /// evenly over the time.
    float time(int pass) const;
    /// Those of all light of a pass, so that paths find photons of their own wavelengths: of passes that follow each
    /// other they are spread evenly. None if the scene needs none.
    std::optional<Wavelengths> wavelengths(int pass) const;

  private:
    TracedPhotons traced(std::uint32_t pass, std::size_t from, std::size_t to, PathCounters& counters) const;
    void learn();
    double worth_of(const Photon& photon, float expected, float pdf) const;

    const World& world_;
    const Scene& scene_;
    PhotonEmission emission_;
    std::size_t photons_a_pass_;
    float first_radius_;
};

}  // namespace phasetree::tracer
