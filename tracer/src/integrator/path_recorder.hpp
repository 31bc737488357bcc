// Fills in a PathRecord (film/path_record.hpp) while a path is traced. Without a record, it costs one comparison per
// vertex of the path.
#pragma once

#include "film/path_record.hpp"
#include "scene/scene.hpp"
#include "world/hit.hpp"

namespace phasetree::tracer {

class PathRecorder {
  public:
    /// A null record disables recording. Refers to the scene.
    PathRecorder(PathRecord* record, const Scene& scene) : record_(record), lights_(scene.lights) {
        if (record_) begin(scene);
    }

    bool is_asked() const { return record_ != nullptr; }

    /// The path has travelled this distance in the phase.
    void travelled(Phase phase, float distance) {
        if (record_ && !record_->behind) add_length(phase, distance);
    }

    /// The path was scattered. `is_delta` is true for scattering into a few discrete directions, `is_link` for a smooth
    /// clear interface. `weight` is that of the next direction, or 0, and `throughput` the path's including that
    /// weight. Both apply to basic radiance, which is radiance over the square of the refractive index.
    void scattered(const Surface& surface, bool is_delta, bool is_link, const glm::vec3& weight,
                   const glm::vec3& throughput);

    /// The path's odds of taking its branch were this many times those by Fresnel.
    void chose(float odds_over_fresnel) {
        if (record_ && !record_->behind) record_->weight /= odds_over_fresnel;
    }

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
    void begin(const Scene& scene);
    void add_length(Phase phase, float distance);
    void add_to_parts(const glm::vec3& found, const Wavelengths* wavelengths, const LightSource& source,
                      const glm::vec3& direction, bool is_to_be_scattered);

    PathRecord* record_;
    const Lights& lights_;
    float distance_ = 0;  ///< from the camera
    int scatterings_ = 0;
};

}  // namespace phasetree::tracer
