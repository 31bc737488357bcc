// Adds up the light that a path finds, and reports it to the guide samples and to the record.
#pragma once

#include <glm/vec3.hpp>

#include "integrator/path_guiding.hpp"
#include "integrator/path_recorder.hpp"
#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

class PathRadiance {
  public:
    /// Keeps references to both, which must outlive it.
    PathRadiance(PathGuiding& guiding, PathRecorder& recorder) : guiding_(guiding), recorder_(recorder) {}

    /// Adds light that was found in `direction`, weighted with the path's throughput, in wavelengths or, if they are
    /// null, in red, green and blue. See PathRecorder::add_light for `is_to_be_scattered`.
    void add(const glm::vec3& found, const Wavelengths* wavelengths, const LightSource& source,
             const glm::vec3& direction, bool is_to_be_scattered) {
        rgb_ += colour_of_found(found, wavelengths);
        guiding_.add_light(found);
        recorder_.add_light(found, wavelengths, source, direction, is_to_be_scattered);
    }

    /// The sum in red, green and blue.
    const glm::vec3& rgb() const { return rgb_; }

  private:
    glm::vec3 rgb_{0.0f};
    PathGuiding& guiding_;
    PathRecorder& recorder_;
};

}  // namespace phasetree::tracer
