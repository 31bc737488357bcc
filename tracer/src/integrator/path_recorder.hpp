// Fills in what a path tells of itself (film/path_record.hpp) as it is traced. Where nobody asks, a step of a path
// costs one comparison more.
#pragma once

#include "film/path_record.hpp"
#include "scene/scene.hpp"
#include "world/hit.hpp"

namespace phasetree::tracer {

class PathRecorder {
  public:
    /// Records nothing without a record. It refers to the scene.
    PathRecorder(PathRecord* record, const Scene& scene) : record_(record), lights_(scene.lights) {
        if (record_) begin(scene);
    }

    bool is_asked() const { return record_ != nullptr; }

    /// The path has gone so far in the phase.
    void travelled(Phase phase, float distance) {
        if (record_ && !record_->behind) add_length(phase, distance);
    }

    /// The path was scattered: `is_delta` if in one of few directions, `is_link` if by a smooth clear interface.
    /// `weight` is that of the next direction, or 0, and `throughput` the path's with that; both of basic radiance,
    /// which is radiance over the square of the refractive index.
    void scattered(const Surface& surface, bool is_delta, bool is_link, const glm::vec3& weight,
                   const glm::vec3& throughput);

    /// The path was so many times as likely to go on as it does as Fresnel's odds are.
    void chose(float odds_over_fresnel) {
        if (record_ && !record_->behind) record_->weight /= odds_over_fresnel;
    }

    /// The camera ray met nothing and saw what is behind the scene.
    void shows_background() {
        if (record_) record_->shows_background = true;
    }

    /// The path was scattered in a medium.
    void scattered_in_medium() {
        if (record_) ++scatterings_;
    }

    /// The path brings light that was seen in the direction, of wavelengths or of red, green and blue.
    /// `is_to_be_scattered` says that a shadow ray or a photon brought it to the place of which scattered() or
    /// scattered_in_medium() is to tell next.
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
