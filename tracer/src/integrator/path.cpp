#include "integrator/path.hpp"

#include <algorithm>
#include <glm/glm.hpp>

#include "caustics/photon_map.hpp"
#include "integrator/interface_choice.hpp"
#include "integrator/medium_vertex.hpp"
#include "integrator/next_event_estimation.hpp"
#include "integrator/path_guiding.hpp"
#include "integrator/path_radiance.hpp"
#include "integrator/path_recorder.hpp"
#include "integrator/path_state.hpp"
#include "integrator/photon_gathering.hpp"
#include "integrator/roulette.hpp"
#include "integrator/surface_vertex.hpp"
#include "phasetree/math/bounds.hpp"
#include "world/chain.hpp"

namespace phasetree::tracer {

namespace {

// Photons and the paths that gather them have the same wavelengths.
PathWavelengths sampled_wavelengths(const PathContext& context) {
    if (!context.world.needs_wavelengths()) return {};
    const Photons& photons = context.photons;
    return PathWavelengths(photons && photons.map->wavelengths()
                               ? *photons.map->wavelengths()
                               : context.world.wavelengths(context.sampler.next_evenly()));
}

class PathIntegrator {
  public:
    PathIntegrator(const PathContext& context, const Ray& camera_ray, PathRecord* record, const PathHelp& help)
        : context_(context),
          camera_ior_(clear_at(context.scene, camera_ray.phase).ior),
          path_{.ray = camera_ray, .wavelengths = sampled_wavelengths(context)},
          guiding_(help.guide, help.guide_samples, context.scene.settings.spectral),
          recorder_(record, context.scene, camera_ior_),
          radiance_(guiding_, recorder_) {}

    PathIntegrator(const PathIntegrator&) = delete;  // radiance_ refers to other members
    PathIntegrator& operator=(const PathIntegrator&) = delete;

    glm::vec3 radiance() {
        trace();
        recorder_.finish(radiance_.rgb());
        return radiance_.rgb();
    }

  private:
    void trace() {
        const Scene& scene = context_.scene;
        Ray& ray = path_.ray;
        for (int depth = 0; depth < scene.settings.max_depth;) {
            // Find the closest hit, and the nearest light in front of it.
            const Hit hit = context_.world.geometry().intersect(ray, context_.counters);
            const Surface* surface = std::get_if<Surface>(&hit);
            const float distance = surface ? surface->distance : Bounds::infinity;
            const auto light = scene.lights.seen(ray.origin, ray.direction, distance, is_camera_ray_, wavelengths());
            const float end = light ? light->distance : distance;

            // Sample the medium on the way there: whether it scatters the path, and what it emits.
            const Flight flight = fly(medium(), context_.world.geometry().way_through_medium(ray, end, wavelengths()),
                                      path_.throughput, context_.sampler);
            if (flight.emitted != glm::vec3(0.0f)) add_emission_of_medium(flight.emitted, end);

            // End the path at a light, or where nothing is hit.
            if (light && !flight.scattered_at) {
                if (is_camera_ray_ && light->distance == Bounds::infinity) recorder_.shows_background();
                add_seen(path_.throughput * path_.chain.weight(scene, context_.photons, ray) * flight.weight *
                             light->radiance,
                         light->source);
                return;
            }
            if (wavelengths())
                recorder_.flew(medium(), {ray.origin, ray.direction, distance}, flight, path_.throughput,
                               context_.sampler);
            path_.throughput *= flight.weight;

            // Scatter the path in the medium.
            if (flight.scattered_at) {
                recorder_.travelled(ray.phase, *flight.scattered_at);
                scatter_in_medium(*flight.scattered_at);
                if (!survives_roulette(++depth)) return;
                continue;
            }
            if (!surface) return;
            path_.chain.by_photons.reach_boundary(distance);
            recorder_.travelled(ray.phase, distance);
            ++depth;

            // Add the emission of the surface.
            if (const auto emitted = surface->emitted(wavelengths()))
                add_seen(
                    path_.throughput * path_.chain.weight(scene, context_.photons, ray, *surface) * emitted->radiance,
                    OfEmissiveSurface{emitted->group});

            // Evaluate the BSDF, at the hero wavelength alone if the surface disperses the path.
            if (surface->optics.get().disperses()) disperse();
            const Bsdf bsdf = surface->bsdf(wavelengths());

            // Pass an interface of equal indices. It scatters nothing, but counts towards max_depth.
            if (bsdf.passes_through()) {
                ray = surface->transmitted(ray.direction);
                path_.last_boundary_normal = surface->normal;
                continue;
            }

            // Scatter the path at the surface.
            if (!scatter_at_surface(*surface, bsdf) || !survives_roulette(depth)) return;
        }
    }

    const Medium& medium() const { return clear_at(context_.scene, path_.ray.phase).interior; }
    // What the path's numbers stand for; null while they are red, green and blue.
    const Wavelengths* wavelengths() const { return path_.wavelengths.now(); }

    // From here on, the path carries its hero wavelength only.
    void disperse() {
        if (path_.wavelengths.is_dispersed()) return;
        path_.wavelengths.disperse();
        if (wavelengths()->is_spectral)
            path_.throughput *= wavelengths()->hero_to_all;
        else
            recorder_.dispersed(path_.throughput);
    }

    // Adds light that the path's own segment meets.
    void add_seen(const glm::vec3& found, const LightSource& source) {
        radiance_.add(found, wavelengths(), source, path_.ray.direction, false);
    }

    // Emission of a medium belongs to no lamp and is recorded with the background. It is that of the whole segment up
    // to `end`, even if the path is scattered before.
    void add_emission_of_medium(const glm::vec3& emitted, float end) {
        add_seen(
            path_.throughput * path_.chain.weight_of_medium(context_.scene, context_.photons, path_.ray, end) * emitted,
            Background{});
    }

    // Scatters the path in the medium, at this distance along its ray. There is always a next ray.
    void scatter_in_medium(float distance) {
        begin_scattering();
        const MediumVertex vertex(context_, path_, distance);
        add_light_at(vertex);
        // Sample the phase function.
        const glm::vec3 direction = vertex.sample_direction(context_.sampler.next2());
        path_.ray = vertex.leaving(direction);
        path_.chain = vertex.chain_from(direction);
        recorder_.scattered_in_medium();
    }

    // Returns whether there is a next ray.
    bool scatter_at_surface(const Surface& surface, const Bsdf& bsdf) {
        begin_scattering();
        const SurfaceVertex vertex(context_, path_, guiding_, surface, bsdf);
        if (vertex.receives_light()) add_light_at(vertex);
        // Sample the BSDF or the guide.
        const auto [u_lobe, probability_over_fresnel] = choice_at(vertex, context_.sampler.next());
        const glm::vec2 u = context_.sampler.next2();
        auto next = vertex.bsdf().sample(u_lobe, u);
        if (next) next->count_as_chosen(probability_over_fresnel);
        recorder_.scattered(surface, vertex.bsdf(), {u_lobe, u, probability_over_fresnel, next}, path_.ray.phase,
                            path_.throughput, path_.wavelengths);
        if (!next) return false;
        path_.throughput *= next->weight;
        path_.ray = continued(surface, vertex.frame(), *next);
        recorder_.chose(probability_over_fresnel);
        if (surface.far_side && surface.entered)
            path_.last_boundary_normal = next->transmitted ? surface.normal : -surface.normal;
        guiding_.leave(surface, bsdf, *next, path_.ray.direction, path_.throughput);
        continue_chain(vertex, *next);
        return true;
    }

    void begin_scattering() {
        ++context_.counters.interactions;
        is_camera_ray_ = false;
    }

    // Adds the light that a vertex scatters into the path, found by shadow rays and by photons.
    template <PathVertex Vertex>
    void add_light_at(const Vertex& vertex) {
        add_direct_light(context_, path_, vertex, radiance_);
        gather_photons(context_, path_, vertex, radiance_);
    }

    // Chooses between reflection and refraction at a smooth interface. All other BSDFs use their own probabilities, and
    // so do paths whose weight has grown too large.
    InterfaceChoice choice_at(const SurfaceVertex& vertex, float u) const {
        const GuidedBsdf& bsdf = vertex.bsdf();
        if (!is_link(bsdf.bsdf(), vertex.surface()) || !guiding_.may_differ()) return {u, 1.0f};
        return chosen_by_lights(context_.scene, vertex.surface(), bsdf.bsdf(), vertex.frame(), bsdf.wo(), u);
    }

    // The path has left a surface: continues its chain, or begins a new one.
    void continue_chain(const SurfaceVertex& vertex, const GuidedBsdf::Sample& next) {
        const Surface& surface = vertex.surface();
        const Bsdf& bsdf = vertex.bsdf().bsdf();
        if (!next.delta) {
            path_.chain = vertex.chain_from(next, path_.ray.direction);
        } else if (bsdf.pane() && next.transmitted) {
            // Straight on, where shadow rays and photons continue as if there were no interface.
        } else if (const bool is_of_interface = is_link(bsdf, surface) && !bsdf.pane();
                   (is_of_interface || is_mirror(bsdf) || bsdf.pane()) &&
                   moves_away(surface, path_.ray.direction, next.transmitted)) {
            ++path_.chain.length;
            path_.chain.has_mirror |= !is_of_interface;
        } else {
            // A delta lobe that neither shadow rays nor photons follow: a smooth coat, or one whose bump sends the path
            // to the surface again.
            path_.chain = {};
        }
    }

    // Russian roulette on the contribution that the path can still bring to the camera. Refraction preserves L/n², and
    // the throughput applies to L, so the share of the camera's light that is found here is throughput ·
    // n²(here)/n²(camera). Returns whether the path continues. Where a guide, or the choice by lights at interfaces,
    // changed the probabilities of the path's directions, the share is computed as if the BSDFs had chosen them. The
    // purpose of such a choice is to produce many paths towards light, each with a low weight; roulette must not end
    // them because of that weight.
    bool survives_roulette(int depth) {
        glm::vec3& throughput = path_.throughput;
        const float ior = clear_at(context_.scene, path_.ray.phase).ior / camera_ior_;
        // After dispersion, the hero's throughput represents all three wavelengths.
        const float hero_scale =
            path_.wavelengths.is_dispersed() && wavelengths()->is_spectral ? wavelengths()->hero_to_all.x : 1.0f;
        const float worth = std::max({throughput.x, throughput.y, throughput.z}) / hero_scale * ior * ior;
        if (!(worth > 0)) return false;
        const float survival = roulette_survival(std::max(guiding_.pdf_over_unguided(), 1.0f) * worth, depth);
        if (survival < 1.0f) {
            if (context_.sampler.next() >= survival) return false;
            throughput /= survival;
            recorder_.survived(survival);
        }
        return true;
    }

    PathContext context_;
    float camera_ior_;
    PathState path_;
    bool is_camera_ray_ = true;
    PathGuiding guiding_;
    PathRecorder recorder_;
    PathRadiance radiance_;
};

}  // namespace

glm::vec3 trace_path(const World& world, const Scene& scene, const Ray& ray, Sampler& sampler, PathCounters& counters,
                     PathRecord* record, const PathHelp& help) {
    ++counters.paths;
    if (!is_clear(scene.materials[ray.phase.index])) {
        PathRecorder(record, scene, 1.0f).finish(glm::vec3(0.0f));
        return glm::vec3(0.0f);
    }
    return PathIntegrator({world, scene, help.photons, sampler, counters}, ray, record, help).radiance();
}

}  // namespace phasetree::tracer
