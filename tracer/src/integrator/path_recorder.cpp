#include "integrator/path_recorder.hpp"

#include <glm/geometric.hpp>

#include "integrator/interface_choice.hpp"
#include "media/channel_choice.hpp"
#include "world/chain.hpp"

namespace phasetree::tracer {

void PathRecorder::begin() {
    record_->direct = record_->indirect = glm::vec3(0.0f);
    record_->groups.assign(scene_.lights.groups().size(), glm::vec3(0.0f));
    record_->shows_background = false;
    record_->weight = 1.0f;
    record_->first.reset();
    record_->behind.reset();
    record_->lengths.assign(scene_.materials.size(), 0.0f);
}

// In a medium that scatters or varies, red, green and blue get the same weight: the mean of the flight's weights under
// the probabilities of channel_choice(). Only this mean is bounded.
glm::vec3 PathRecorder::rgb_weight(const Medium& medium, const Way& segment, const Flight& flight,
                                   const glm::vec3& throughput, Sampler& sampler) {
    if (const auto* absorbing = std::get_if<AbsorbingMedium>(&medium))
        return absorbing->transmittance(segment, sampler);
    return glm::vec3(glm::dot(channel_choice(throughput), flight.weight));
}

void PathRecorder::add_length(Phase phase, float distance) {
    record_->lengths[phase.index] += distance;
    distance_ += distance;
}

void PathRecorder::add_departure(const Surface& surface, const GuidedBsdf& bsdf, const Departure& departure, Phase from,
                                 const glm::vec3& throughput, const PathWavelengths& wavelengths) {
    const auto& next = departure.next;
    float u_lobe = departure.u_lobe;
    // The recorded albedo ignores the guide because guided directions have noisier weights.
    if (!wavelengths.now()) {
        const auto unguided =
            bsdf.guide() ? bsdf.unguided_sample(u_lobe, departure.u) : std::optional<BsdfSample>(next);
        return add_surface(surface, bsdf.bsdf(), unguided, from, throughput);
    }
    // The albedo is recorded in colours even for spectral paths because it describes what a surface looks like. The
    // BSDF is therefore sampled again, in colours and with the same random numbers. At a smooth interface, it is
    // sampled for the branch that the path took: with films and dispersion the probabilities differ between colours,
    // and a reflection must not get the weight of a refraction.
    const Bsdf in_colours = surface.bsdf();
    if (next && is_link(in_colours, surface)) u_lobe = next->transmitted ? one_minus_epsilon : 0.0f;
    const auto unguided =
        GuidedBsdf(in_colours, bsdf.frame(), bsdf.wo(), bsdf.guide()).unguided_sample(u_lobe, departure.u);
    add_surface(surface, in_colours, unguided, from, rgb_throughput_);
    rgb_throughput_ *= unguided ? unguided->weight / departure.probability_over_fresnel : glm::vec3(0.0f);
}

// `next` is the path's next direction in red, green and blue; nullopt if it ends.
void PathRecorder::add_surface(const Surface& surface, const Bsdf& bsdf, const std::optional<BsdfSample>& next,
                               Phase from, const glm::vec3& throughput) {
    const bool is_of_chain = is_link(bsdf, surface);
    if (!is_of_chain) ++scatterings_;
    if (record_->behind) return;
    // Albedos are weights of basic radiance, which is radiance over the square of the refractive index.
    const auto ior = [&](Phase phase) { return clear_at(scene_, phase).ior; };
    const Phase after = next && next->transmitted ? surface.far_side->phase : from;
    const glm::vec3 weight = next ? next->weight : glm::vec3(0.0f);
    const float bent = ior(after) / ior(from), from_camera = ior(after) / camera_ior_;
    RecordedSurface met{.position = surface.near_side.origin,
                        .normal = surface.normal,
                        .distance = distance_,
                        // A smooth interface reflects and refracts all of the light, unless it is a coloured pane.
                        .albedo = is_of_chain && !bsdf.pane() ? glm::vec3(1.0f) : weight * (bent * bent),
                        .object = surface.object,
                        .instance = surface.place.copy,
                        .phase_from = surface.near_side.phase,
                        .phase_to = surface.entered};
    if (!record_->first) record_->first = met;
    if (bsdf.is_delta()) return;
    met.albedo = throughput * weight * (from_camera * from_camera);
    record_->behind = met;
}

void PathRecorder::add_to_parts(const glm::vec3& found, const Wavelengths* wavelengths, const LightSource& source,
                                const glm::vec3& direction, bool is_to_be_scattered) {
    if (scatterings_ + (is_to_be_scattered ? 1 : 0) <= 1) record_->direct += colour_of_found(found, wavelengths);
    scene_.lights.add_to_groups(found, wavelengths, source, direction, record_->groups);
}

}  // namespace phasetree::tracer
