#include "integrator/path.hpp"

#include <algorithm>
#include <cmath>

#include "caustics/photon_map.hpp"
#include "caustics/photon_placement.hpp"
#include "caustics/trace_photon.hpp"
#include "integrator/interface_choice.hpp"
#include "integrator/light_proposal.hpp"
#include "integrator/path_chain.hpp"
#include "integrator/path_guiding.hpp"
#include "integrator/path_recorder.hpp"
#include "integrator/photon_density.hpp"
#include "integrator/roulette.hpp"
#include "integrator/shadow_ray.hpp"
#include "integrator/technique_weight.hpp"
#include "media/channel_choice.hpp"
#include "phasetree/math/bounds.hpp"
#include "world/chain.hpp"

namespace phasetree::tracer {

namespace {

// The state of one path.
class Path {
  public:
    Path(const World& world, const Scene& scene, const Ray& ray, Sampler& sampler, PathCounters& counters,
         const PathHelp& help, PathRecord* record)
        : world_(world),
          scene_(scene),
          photons_(help.photons),
          guiding_(help.guide, help.findings, scene.settings.spectral),
          sampler_(sampler),
          counters_(counters),
          ray_(ray),
          camera_ior_(clear_at(scene, ray.phase).ior),
          recorder_(record, scene) {
        // Photons and the paths that gather them have the same wavelengths.
        if (!world.needs_wavelengths()) return;
        wavelengths_ = photons_ && photons_.map->wavelengths() ? *photons_.map->wavelengths()
                                                               : world.wavelengths(sampler.next_evenly());
        if (wavelengths_->is_spectral) current_ = &*wavelengths_;
    }

    Path(const Path&) = delete;  // current_ points into it
    Path& operator=(const Path&) = delete;

    glm::vec3 trace() {
        for (int depth = 0; depth < scene_.settings.max_depth;) {
            const Hit hit = world_.geometry().intersect(ray_, counters_);
            const Surface* surface = std::get_if<Surface>(&hit);
            const float distance = surface ? surface->distance : Bounds::infinity;
            const auto light = scene_.lights.seen(ray_.origin, ray_.direction, distance, is_camera_ray_, current_);
            const float end = light ? light->distance : distance;
            const Flight flight = through_medium(end);
            add_emission_of_medium(flight.emitted, end);
            if (light && !flight.scattered_at) {
                if (is_camera_ray_ && light->distance == Bounds::infinity) recorder_.shows_background();
                add_light(throughput_ * chain_.weight(scene_, photons_, ray_) * flight.weight * light->radiance,
                          light->source, ray_.direction, false);
                break;
            }
            if (current_ && recorder_.is_asked()) recorded_throughput_ *= weight_of_colours(flight, distance);
            throughput_ *= flight.weight;
            if (flight.scattered_at) {
                recorder_.travelled(ray_.phase, *flight.scattered_at);
                scatter_in_medium(*flight.scattered_at);
                recorder_.scattered_in_medium();
                if (!roulette(++depth)) break;
                continue;
            }
            if (!surface) break;
            chain_.by_photons.reach_boundary(distance);
            recorder_.travelled(ray_.phase, distance);
            ++depth;
            if (const auto emitted = surface->emitted(current_))
                add_light(throughput_ * chain_.weight(scene_, photons_, ray_, *surface) * emitted->radiance,
                          OfGlowingSurface{emitted->group}, ray_.direction, false);
            if (surface->optics.get().disperses()) disperse();
            const Bsdf bsdf = surface->bsdf(current_);
            if (bsdf.passes_through()) {  // equal indices scatter nothing, but count towards max_depth
                ray_ = surface->transmitted(ray_.direction);
                entered_ = surface->normal;
                continue;
            }
            if (!scatter_and_continue(*surface, bsdf) || !roulette(depth)) break;
        }
        recorder_.finish(radiance_);
        return radiance_;
    }

  private:
    const Medium& medium() const { return clear_at(scene_, ray_.phase).interior; }
    // See PathWavelengths; null if the path carries colours.
    const Wavelengths* all_wavelengths() const { return wavelengths_ ? &*wavelengths_ : nullptr; }
    // From here on, the path carries its hero wavelength only.
    void disperse() {
        if (is_dispersed_) return;
        is_dispersed_ = true;
        current_ = &wavelengths_.value();
        if (current_->is_spectral)
            throughput_ *= current_->hero_to_all;
        else
            recorded_throughput_ = throughput_;
    }

    Flight through_medium(float distance) {
        return fly(medium(), world_.geometry().way_through_medium(ray_, distance, current_), throughput_, sampler_);
    }

    // Like scatter_and_continue() of a surface, in the medium at that distance along the ray. There is always a next
    // ray.
    void scatter_in_medium(float distance) {
        const HenyeyGreenstein& phase = *phase_function(medium());
        scatter_and_continue(MediumPoint{ray_.origin + distance * ray_.direction, ray_.phase, phase, ray_.in});
    }

    // Emission of a medium belongs to no lamp and is recorded with the background. It is that of the whole segment up
    // to `end`, even if the path is scattered before.
    void add_emission_of_medium(const glm::vec3& emitted, float end) {
        if (emitted == glm::vec3(0.0f)) return;
        const glm::vec3 radiance = throughput_ * chain_.weight_of_medium(scene_, photons_, ray_, end) * emitted;
        add_light(radiance, Background{}, ray_.direction, false);
    }

    // Adds radiance of a light that was seen in `direction`. The radiance of a spectral path is converted to a colour
    // here.
    void add_light(const glm::vec3& found, const LightSource& source, const glm::vec3& direction,
                   bool is_to_be_scattered) {
        radiance_ += colour_of_found(found, current_);
        guiding_.add_light(found);
        recorder_.add_light(found, current_, source, direction, is_to_be_scattered);
    }

    // Returns the weight of red, green and blue after a flight past `distance`. In a medium that scatters or varies,
    // all three have the same weight: the mean of the flight's weights by channel_choice(), because only that mean is
    // bounded.
    glm::vec3 weight_of_colours(const Flight& flight, float distance) {
        if (const auto* absorbing = std::get_if<AbsorbingMedium>(&medium()))
            return absorbing->transmittance({ray_.origin, ray_.direction, distance}, sampler_);
        return glm::vec3(glm::dot(channel_choice(throughput_), flight.weight));
    }

    // Reports a surface to the recorder before the path's ray leaves it in the direction `next`, which was chosen with
    // `odds` (InterfaceChoice).
    void record(const Surface& surface, const GuidedBsdf& bsdf, float lobe, float odds, const glm::vec2& u,
                const std::optional<GuidedBsdf::Sample>& next) {
        if (!current_)
            return record(surface, bsdf.bsdf(),
                          bsdf.guide() ? bsdf.unguided_sample(lobe, u) : std::optional<BsdfSample>(next), throughput_);
        // The albedo is recorded in colours even for spectral paths because it describes what a surface looks like. The
        // BSDF is therefore sampled again, in colours and with the same random numbers. At a smooth interface, it is
        // sampled for the branch that the path took: with films and dispersion the odds differ in colours, and a
        // reflection must not get the weight of a refraction.
        const Bsdf in_colours = surface.bsdf();
        if (next && is_link(in_colours, surface)) lobe = next->transmitted ? greatest_below_one : 0.0f;
        const auto seen = GuidedBsdf(in_colours, bsdf.frame(), bsdf.wo(), bsdf.guide()).unguided_sample(lobe, u);
        record(surface, in_colours, seen, recorded_throughput_);
        recorded_throughput_ *= seen ? seen->weight / odds : glm::vec3(0.0f);
    }
    void record(const Surface& surface, const Bsdf& bsdf, const std::optional<BsdfSample>& next,
                const glm::vec3& throughput) {
        const auto ior = [&](Phase phase) { return clear_at(scene_, phase).ior; };
        const Phase after = next && next->transmitted ? surface.far_side->phase : ray_.phase;
        const glm::vec3 weight = next ? next->weight : glm::vec3(0.0f);
        const float bent = ior(after) / ior(ray_.phase), from_camera = ior(after) / camera_ior_;
        const bool is_of_chain = is_link(bsdf, surface);
        // A smooth interface reflects and refracts all of the light.
        recorder_.scattered(surface, bsdf.is_delta(), is_of_chain,
                            is_of_chain ? glm::vec3(1.0f) : weight * (bent * bent),
                            throughput * weight * (from_camera * from_camera));
    }

    // Adds direct light and photons, and samples the path's next ray. Returns whether there is one.
    bool scatter_and_continue(const Surface& surface, const Bsdf& unguided) {
        ++counters_.interactions;
        is_camera_ray_ = false;
        const Frame frame = surface.frame();
        const GuidedBsdf bsdf(unguided, frame, frame.to_local(-ray_.direction), guiding_.at(surface, unguided));
        LightProposal proposal;
        const auto per_line_density_of = [&](const glm::vec3& wi) {
            return is_passed_by_photons(surface, unguided)
                       ? per_line_density_beyond(chain_.by_photons.per_line_density / *chain_.pdf, scene_, surface,
                                                 bsdf, wi)
                       : per_line_density_at(photons_, scene_, surface, bsdf, wi);
        };
        if (!unguided.is_delta()) {
            // Photons that continue from the surface are weighted with the same pdf of shadow rays, which must not
            // depend on refraction.
            proposal = surface.far_side || is_passed_by_photons(surface, unguided)
                           ? LightProposal(receiver_of_passed_light(surface, surface.near_side))
                           : LightProposal::at(surface, world_, scene_, counters_, all_wavelengths());
            add_direct_light(surface, bsdf, proposal, per_line_density_of);
            add_caustics(surface, bsdf, proposal);
        }
        const auto [lobe, odds] = choice_at(surface, frame, unguided, bsdf.wo(), sampler_.next());
        const glm::vec2 u = sampler_.next2();
        auto next = bsdf.sample(lobe, u);
        if (next) next->count_as_chosen(odds);
        // The recorded albedo ignores the guide because guided directions have noisier weights.
        if (recorder_.is_asked()) record(surface, bsdf, lobe, odds, u, next);
        if (!next) return false;
        throughput_ *= next->weight;
        ray_ = continued(surface, frame, *next);
        recorder_.chose(odds);
        if (surface.far_side) entered_ = next->transmitted ? surface.normal : -surface.normal;
        guiding_.leave(surface, unguided, *next, ray_.direction, throughput_);
        if (!next->delta)
            chain_ = {.pdf = next->pdf,
                      .proposal = proposal,
                      .direction = ray_.direction,
                      .by_photons = {per_line_density_of(next->wi)},
                      .interfaces_before = interfaces_before(surface, unguided)};
        else if (is_link(unguided, surface))
            ++chain_.length;
        else if (is_mirror(unguided) && glm::dot(ray_.direction, surface.geometric_normal) > 0.0f) {
            ++chain_.length;
            chain_.has_mirror = true;
        } else
            // A delta lobe that neither shadow rays nor photons follow: a smooth coat, or a mirror whose bump sends the
            // path into the mirror again.
            chain_ = {};
        return true;
    }

    // Chooses between reflection and refraction at a smooth interface. All other BSDFs use their own odds, and so do
    // paths whose weight has grown too large.
    InterfaceChoice choice_at(const Surface& surface, const Frame& frame, const Bsdf& bsdf, const glm::vec3& wo,
                              float u) const {
        if (!is_link(bsdf, surface) || !guiding_.may_differ()) return {u, 1.0f};
        return chosen_by_lights(scene_, surface, bsdf, frame, wo, u);
    }

    void scatter_and_continue(const MediumPoint& point) {
        ++counters_.interactions;
        is_camera_ray_ = false;
        const HenyeyGreenstein& phase = point.phase_function;
        const auto proposal = LightProposal::at(point, entered_, world_, scene_, all_wavelengths());
        const auto placement = photons_ ? PhotonPlacement::in(medium(), photons_.map->half_length()) : std::nullopt;
        const PhotonDensity by_photons{placement ? per_line_density_across(photons_, scene_, point.phase) : 0.0f,
                                       placement};
        if (const auto light = sampled_light(proposal)) {
            const float f = phase.evaluate(glm::dot(ray_.direction, light->wi));
            add_direct_light(*light, glm::vec3(f), f, by_photons, point.leaving(light->wi), 0);
        }
        if (placement) add_caustics(point, *placement, proposal);
        const glm::vec3 direction = glm::normalize(Frame(ray_.direction).to_world(phase.sample(sampler_.next2())));
        const float pdf = phase.evaluate(glm::dot(ray_.direction, direction));
        ray_ = point.leaving(direction);
        chain_ = {.pdf = pdf, .proposal = proposal, .direction = direction, .by_photons = by_photons};
    }

    // Next-event estimation: adds the light that arrives by a shadow ray and is scattered into the path.
    template <class PerLineDensity>
    void add_direct_light(const Surface& surface, const GuidedBsdf& bsdf, const LightProposal& proposal,
                          PerLineDensity&& per_line_density_of) {
        const auto light = sampled_light(proposal);
        if (!light) return;
        const glm::vec3 wi = bsdf.frame().to_local(light->wi);
        const glm::vec3 f = bsdf.evaluate(wi);
        if (f == glm::vec3(0.0f)) return;
        const float per_line_density = per_line_density_of(wi);
        add_direct_light(*light, f, bsdf.pdf(wi, light->wi), {per_line_density},
                         wi.z < 0 ? surface.transmitted(light->wi) : surface.reflected(light->wi),
                         interfaces_before(surface, bsdf.bsdf()));
    }

    std::optional<LightSample> sampled_light(const LightProposal& proposal) {
        return proposal.sample(scene_.lights, sampler_.next2(), current_);
    }

    // `f` is the BSDF or phase function, including the cosine. `pdf` is that with which the path itself would continue
    // in the light's direction.
    void add_direct_light(const LightSample& light, const glm::vec3& f, float pdf, PhotonDensity by_photons,
                          const Ray& shadow, int interfaces_before) {
        if (scene_.settings.techniques == Techniques::directions_alone) return;
        const Photons photons = by_photons.per_line_density > 0.0f ? photons_ : Photons{};
        const Arrival arrival = trace_shadow_ray({world_, scene_, photons, sampler_, counters_}, shadow, light,
                                                 {all_wavelengths(), is_dispersed_}, interfaces_before);
        // No sampled direction of the path meets a point.
        const float by_directions = light.is_of_point_light() ? 0.0f : pdf;
        const auto weight = [&](float density_of_photons) {
            return technique_weight(scene_.settings.techniques, Technique::shadow_rays, light.pdf, by_directions,
                                    density_of_photons);
        };
        const auto add = [&](const glm::vec3& radiance, float line_density, const LightSource& source,
                             const glm::vec3& direction) {
            // Photons reach a medium through its boundary. A shadow ray that meets no boundary has line density 0 and
            // an infinite distance to the boundary, for which coverage is undefined.
            if (line_density > 0.0f) by_photons.reach_boundary(arrival.to_boundary);
            add_light(throughput_ * f * radiance * (weight(by_photons.per_line_density * line_density) / light.pdf),
                      source, direction, true);
        };
        for (const auto& [radiance, line_density] : arrival.from_media)
            add(radiance, line_density, Background{}, light.wi);
        if (arrival.light)
            add(arrival.light->radiance, arrival.light->line_density, arrival.light->source, arrival.light->direction);
    }

    // Whether photons that continue from the surface count at an earlier vertex of the path, and not at the surface.
    bool is_passed_by_photons(const Surface& surface, const Bsdf& bsdf) const {
        return sends_photons_on(bsdf, surface) && chain_.photons_count_earlier();
    }
    // PathChain::interfaces_before of a chain that starts at the surface.
    int interfaces_before(const Surface& surface, const Bsdf& bsdf) const {
        return is_passed_by_photons(surface, bsdf) ? chain_.interfaces() + 1 : 0;
    }
    // Adds the contribution of one photon at the point `at`. `f` is the BSDF or the phase function for the photon's
    // direction, and `power` the photon's power after attenuation up to the point. `by_photons` is the pdf of that
    // direction for photons, and `pdf` that of the path itself. Called only if all techniques are used.
    void add_photon(const Photon& photon, const glm::vec3& power, const glm::vec3& f, float by_photons, float pdf,
                    const LightProposal& proposal, const glm::vec3& at) {
        const float weight = photon.weight(by_photons, pdf, [&] {
            // A small lamp may be visible in the photon's direction from the photon's line, but from nowhere else near
            // the point. The pdf of shadow rays is therefore evaluated at the closest point of that line, where their
            // weight for the same light complements this one.
            const float along = glm::dot(at - photon.position, photon.direction);
            return proposal.pdf_from(scene_.lights, photon.position + along * photon.direction, photon.direction);
        });
        glm::vec3 fluence = power / photons_.map->expected();
        if (photon.of_one_wavelength) {
            if (!is_dispersed_) fluence *= wavelengths_->hero_to_all;
        } else if (current_ && !current_->is_spectral) {
            fluence = for_light(fluence, current_);
        }
        add_light(throughput_ * f * fluence * weight, photon.source, photon.towards_light, true);
    }

    // Adds the photons that landed near the surface point.
    void add_caustics(const Surface& surface, const GuidedBsdf& bsdf, const LightProposal& proposal) {
        if (!photons_ || scene_.settings.techniques != Techniques::all) return;
        const Phase near = surface.near_side.phase;
        const auto add = [&](const Photon& photon) {
            const glm::vec3 wi = bsdf.frame().to_local(photon.direction);
            // A photon on another surface nearby may come from the wrong side.
            const bool is_from_near = photon.phase == near;
            if (!is_from_near && !(surface.far_side && photon.phase == surface.far_side->phase)) return;
            if (is_from_near != (wi.z > 0.0f)) return;
            const float by_photons = per_line_density_at(photons_, scene_, surface, bsdf, wi) * photon.line_density;
            if (!(by_photons > 0.0f)) return;
            // Photons are counted per area of the surface, which already includes the surface's cosine.
            const glm::vec3 f = bsdf.evaluate(wi) / photon_cosine(surface, bsdf.frame(), wi);
            add_photon(photon, photon.power, f, by_photons, bsdf.pdf(wi, photon.direction), proposal,
                       surface.near_side.origin);
        };
        if (is_passed_by_photons(surface, bsdf.bsdf())) return;
        if (!surface.far_side)
            photons_.map->near(surface.near_side.origin, surface.geometric_normal, add);
        else
            photons_.map->near_at_interface(surface.near_side.origin, surface.normal, add);
    }

    // Adds the photons whose points in a medium are near `point`.
    void add_caustics(const MediumPoint& point, const PhotonPlacement& placement, const LightProposal& proposal) {
        if (scene_.settings.techniques != Techniques::all) return;
        const float across = per_line_density_across(photons_, scene_, point.phase);
        photons_.map->near_in_medium(point.position, point.phase, [&](const Photon& photon, float depth) {
            const float coverage = placement.coverage(depth);
            const float by_photons = across * photon.line_density * coverage;
            if (!(by_photons > 0.0f)) return;
            // The transmittance for the photon between the boundary and the point. It is 1 for points before the
            // boundary.
            const Wavelengths* of_photon = photon.of_one_wavelength ? &*wavelengths_ : current_;
            const glm::vec3 left = transmittance(
                medium(),
                world_.geometry().way_through_medium(point.leaving(photon.direction), std::max(depth, 0.0f), of_photon),
                sampler_);
            const float f = point.phase_function.get().evaluate(glm::dot(ray_.direction, photon.direction));
            add_photon(photon, photon.power * left / coverage, glm::vec3(f), by_photons, f, proposal, point.position);
        });
    }

    // Russian roulette on the contribution that the path can still bring to the camera. Refraction preserves L/n², and
    // the throughput applies to L, so the share of the camera's light that is found here is throughput ·
    // n²(here)/n²(camera). Returns whether the path continues. Where a guide, or the choice by lights at interfaces,
    // changed the odds of the path's directions, the share is computed as if the BSDFs had chosen them. Paths towards
    // light have low weights each, and producing them is the purpose of such a choice.
    bool roulette(int depth) {
        const float ior = clear_at(scene_, ray_.phase).ior / camera_ior_;
        // After dispersion, the hero's throughput represents all three wavelengths.
        const float alone = is_dispersed_ && current_->is_spectral ? current_->hero_to_all.x : 1.0f;
        const float worth = std::max({throughput_.x, throughput_.y, throughput_.z}) / alone * ior * ior;
        if (!(worth > 0)) return false;
        const float survival = roulette_survival(std::max(guiding_.pdf_over_unguided(), 1.0f) * worth, depth);
        if (survival < 1.0f) {
            if (sampler_.next() >= survival) return false;
            throughput_ /= survival;
            recorded_throughput_ /= survival;
        }
        return true;
    }

    const World& world_;
    const Scene& scene_;
    const Photons& photons_;
    PathGuiding guiding_;
    Sampler& sampler_;
    PathCounters& counters_;
    Ray ray_;
    float camera_ior_;
    glm::vec3 radiance_{0.0f}, throughput_{1.0f};
    PathChain chain_;
    // The outward normal of the last clear boundary that the path met in this medium.
    std::optional<glm::vec3> entered_;
    bool is_camera_ray_ = true;
    // Those of the path, even while it still carries colours; nullopt if the world needs none.
    std::optional<Wavelengths> wavelengths_;
    // What the path's numbers stand for: null while they are red, green and blue, else wavelengths_.
    const Wavelengths* current_ = nullptr;
    bool is_dispersed_ = false;
    // The throughput in red, green and blue for the record; a path of colours uses it once it is dispersed.
    glm::vec3 recorded_throughput_{1.0f};
    PathRecorder recorder_;
};

}  // namespace

glm::vec3 trace_path(const World& world, const Scene& scene, const Ray& ray, Sampler& sampler, PathCounters& counters,
                     PathRecord* record, const PathHelp& help) {
    ++counters.paths;
    if (!is_clear(scene.materials[ray.phase.index])) {
        PathRecorder(record, scene).finish(glm::vec3(0.0f));
        return glm::vec3(0.0f);
    }
    return Path(world, scene, ray, sampler, counters, help, record).trace();
}

}  // namespace phasetree::tracer
