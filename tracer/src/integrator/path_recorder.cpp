#include "integrator/path_recorder.hpp"

namespace phasetree::tracer {

void PathRecorder::begin(const Scene& scene) {
    record_->direct = record_->indirect = glm::vec3(0.0f);
    record_->groups.assign(scene.lights.groups().size(), glm::vec3(0.0f));
    record_->shows_background = false;
    record_->weight = 1.0f;
    record_->first.reset();
    record_->behind.reset();
    record_->lengths.assign(scene.materials.size(), 0.0f);
}

void PathRecorder::add_length(Phase phase, float distance) {
    record_->lengths[phase.index] += distance;
    distance_ += distance;
}

void PathRecorder::scattered(const Surface& surface, bool is_delta, bool is_link, const glm::vec3& weight,
                             const glm::vec3& throughput) {
    if (!record_) return;
    if (!is_link) ++scatterings_;
    if (record_->behind) return;
    RecordedSurface met{.position = surface.near_side.origin,
                        .normal = surface.normal,
                        .distance = distance_,
                        .albedo = weight,
                        .object = surface.object,
                        .instance = surface.place.copy,
                        .left = surface.near_side.phase,
                        .entered = surface.entered};
    if (!record_->first) record_->first = met;
    if (is_delta) return;
    met.albedo = throughput;
    record_->behind = met;
}

void PathRecorder::add_to_parts(const glm::vec3& found, const Wavelengths* wavelengths, const LightSource& source,
                                const glm::vec3& direction, bool is_to_be_scattered) {
    if (scatterings_ + (is_to_be_scattered ? 1 : 0) <= 1) record_->direct += colour_of_found(found, wavelengths);
    lights_.add_to_groups(found, wavelengths, source, direction, record_->groups);
}

}  // namespace phasetree::tracer
