// Everything in which paths are traced: the geometry, and data found by rays beforehand. It is immutable after
// construction, so any number of threads may use it.
#pragma once

#include <algorithm>
#include <vector>

#include "spectrum/wavelengths.hpp"
#include "world/flat_boundaries.hpp"
#include "world/traced_geometry.hpp"
#include "world/wavelengths_of_lights.hpp"

namespace phasetree::tracer {

class World {
  public:
    /// Refers to the scene, which must outlive it. Throws like TracedGeometry's constructor.
    explicit World(const Scene& scene, const WorldOptions& options = {})
        : geometry_(scene, options),
          flat_boundaries_(!options.is_first_look ? tracer::flat_boundaries(geometry_, scene)
                                                  : std::vector<FlatBoundary>{}),
          disperses_(std::ranges::any_of(scene.materials,
                                         [](const Material& material) {
                                             const Clear* clear = std::get_if<Clear>(&material);
                                             return clear && clear->dispersion;
                                         })),
          is_spectral_(scene.settings.spectral),
          distribution_(wavelengths_of_lights(scene)) {}
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    const TracedGeometry& geometry() const { return geometry_; }
    /// The flat sides through which lights reach the inside of the object.
    const std::vector<FlatBoundary>& flat_boundaries() const { return flat_boundaries_; }
    /// Whether any refraction in it depends on the wavelength.
    bool disperses() const { return disperses_; }
    /// Whether paths have wavelengths, from the start or from where they are dispersed.
    bool needs_wavelengths() const { return disperses_ || is_spectral_; }
    /// The wavelengths of a path, chosen by u in [0, 1).
    Wavelengths wavelengths(float u) const {
        return is_spectral_ ? Wavelengths::three(u, distribution_)
                            : Wavelengths::of_dispersed_colours(sampled_wavelength(u));
    }

  private:
    TracedGeometry geometry_;
    std::vector<FlatBoundary> flat_boundaries_;
    bool disperses_;
    bool is_spectral_;
    WavelengthDistribution distribution_;
};

}  // namespace phasetree::tracer
