// Fills in a PathRecord (film/path_record.hpp) while a path is traced. Without a record, a call costs at most a
// comparison or an assignment.
#pragma once

#include "film/path_record.hpp"
#include "integrator/guided.hpp"
#include "integrator/path_wavelengths.hpp"
#include "media/medium.hpp"
#include "scene/scene.hpp"
#include "world/hit.hpp"

namespace phasetree::tracer {

class PathRecorder {
  public:
    /// A null record disables recording. `camera_ior` is the refractive index around the camera. Keeps a reference to
    /// the scene, which must outlive it.
    PathRecorder(PathRecord* record, const Scene& scene, float camera_ior)
        : record_(record), scene_(scene), camera_ior_(camera_ior) {
        if (record_) begin();
    }

    /// The path has sampled a flight along `segment`, which ends at the next surface, or at infinity. The flight may
    /// have been scattered before that. Call this only for paths that carry wavelengths. `throughput` is that at the
    /// start of the flight.
    void flew(const Medium& medium, const Way& segment, const Flight& flight, const glm::vec3& throughput,
              Sampler& sampler) {
        if (record_) rgb_throughput_ *= rgb_weight(medium, segment, flight, throughput, sampler);
    }

    /// An RGB path has been dispersed.
    void dispersed(const glm::vec3& throughput) { rgb_throughput_ = throughput; }

    /// The path has travelled this distance in the phase.
    void travelled(Phase phase, float distance) {
        if (record_ && !record_->behind) add_length(phase, distance);
    }

    /// How the path leaves a surface.
    struct Departure {
        float u_lobe;                                   ///< the first argument of GuidedBsdf::sample()
        glm::vec2 u;                                    ///< the second one
        float probability_over_fresnel;                 ///< as in InterfaceChoice
        const std::optional<GuidedBsdf::Sample>& next;  ///< the result
    };
    /// The path was scattered at a surface that it met in the phase `from`, with this throughput and wavelengths.
    void scattered(const Surface& surface, const GuidedBsdf& bsdf, const Departure& departure, Phase from,
                   const glm::vec3& throughput, const PathWavelengths& wavelengths) {
        if (record_) add_departure(surface, bsdf, departure, from, throughput, wavelengths);
    }

    /// The path chose its branch with `probability_over_fresnel` times the probability of Fresnel's equations.
    void chose(float probability_over_fresnel) {
        if (record_ && !record_->behind) record_->weight /= probability_over_fresnel;
    }

    /// The path has survived roulette with this probability.
    void survived(float probability) { rgb_throughput_ /= probability; }

    /// The camera ray met nothing and shows the background.
    void shows_background() {
        if (record_) record_->shows_background = true;
    }

    /// The path was scattered in a medium.
    void scattered_in_medium() {
        if (record_) ++scatterings_;
    }

    /// The path found light in `direction`, in wavelengths or in red, green and blue. `is_to_be_scattered` is true if a
    /// shadow ray or a photon brought it to the vertex that the next call of scattered() or scattered_in_medium()
    /// reports.
    void add_light(const glm::vec3& found, const Wavelengths* wavelengths, const LightSource& source,
                   const glm::vec3& direction, bool is_to_be_scattered) {
        if (record_) add_to_parts(found, wavelengths, source, direction, is_to_be_scattered);
    }

    /// The path has ended.
    void finish(const glm::vec3& radiance) {
        if (record_) record_->indirect = radiance - record_->direct;
    }

  private:
    void begin();
    static glm::vec3 rgb_weight(const Medium& medium, const Way& segment, const Flight& flight,
                                const glm::vec3& throughput, Sampler& sampler);
    void add_length(Phase phase, float distance);
    void add_departure(const Surface& surface, const GuidedBsdf& bsdf, const Departure& departure, Phase from,
                       const glm::vec3& throughput, const PathWavelengths& wavelengths);
    void add_surface(const Surface& surface, const Bsdf& bsdf, const std::optional<BsdfSample>& next, Phase from,
                     const glm::vec3& throughput);
    void add_to_parts(const glm::vec3& found, const Wavelengths* wavelengths, const LightSource& source,
                      const glm::vec3& direction, bool is_to_be_scattered);

    PathRecord* record_;
    const Scene& scene_;
    float camera_ior_;
    /// The path's throughput in red, green and blue, for paths in wavelengths.
    glm::vec3 rgb_throughput_{1.0f};
    float distance_ = 0;  ///< from the camera
    int scatterings_ = 0;
};

}  // namespace phasetree::tracer
