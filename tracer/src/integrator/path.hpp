// Unidirectional path tracing from phase to phase (Kajiya: The Rendering Equation, SIGGRAPH 1986), with next-event
// estimation, multiple importance sampling by the power heuristic (Veach & Guibas, SIGGRAPH 1995) and Russian roulette.
#pragma once

#include "film/path_record.hpp"
#include "sampling/sobol.hpp"
#include "world/world.hpp"

namespace phasetree::tracer {

class Guide;
class PathFindings;
class PhotonEmission;
class PhotonMap;

/// The photons that light what a path meets, if there are any.
struct Photons {
    const PhotonEmission* emission = nullptr;
    const PhotonMap* map = nullptr;
    explicit operator bool() const { return map != nullptr; }
};

/// What helps a path, and what it reports to. Each may be left out.
struct PathHelp {
    Photons photons{};
    const Guide* guide = nullptr;      ///< in which directions paths are to go on from surfaces (path_guiding.hpp)
    PathFindings* findings = nullptr;  ///< collects what the path finds, for the next guide
};

/// An estimate of the radiance that arrives along a ray, unbiased but for the light that is lost where paths end
/// because they have been scattered, or met surfaces, RenderSettings::max_depth times. It is black for a ray that
/// starts in an opaque phase.
///
/// Light through clear interfaces. A shadow ray that meets a smooth interface of two clear phases is not lost: it goes
/// on as a path would, reflected or refracted by Fresnel's odds, and what it finds in the end is the light that arrives
/// from its first direction ω. A thin wall hardly bends it, so a lamp behind glass is found about as often as one in
/// plain sight. Shadow rays, and the path's own way on in a direction that the BSDF samples, are thus two techniques
/// for the same integral over ω,
///     ∫ f(ω) E(ω) dω,   E: emission at the end of a chain of smooth clear interfaces, of any length from 0,
/// and combine by the power heuristic of their densities *of ω*: of the light sampling, and of the BSDF. A path keeps
/// these two through the chain. Nothing is counted twice, whatever the light is seen through, and nothing is lost but
/// what a path would have found that ends by max_depth within the chain, which no weight knows of. In which directions
/// shadow rays start is for light_proposal.hpp.
///
/// Media that scatter. On its way a path may be scattered in a medium, which is a place like a surface: light is looked
/// for there, and a direction sampled, with the phase function instead of the BSDF. E then includes the transmittance
/// along the chain, by absorption and scattering together, whichever technique finds it.
///
/// Photons are a third technique for the same integral, for chains of at least one interface: E as found from the
/// light's end (caustics/caustics.hpp). Where N of them start and those within r of the surface count, directions ω are
/// found with the expected density
///     N π r² (p(line)/m²) n² cos θ,
/// of which p(line) is the density at the light, per area across the line and solid angle, m the index around the light
/// (p(line)/m² is EmittedPhoton::line_density), n the index at the surface, and cos θ turns area across the line into
/// area of the surface: the étendue, index² · area across the line · solid angle, is the same all along a chain,
/// however its interfaces are curved. Fresnel's odds are the same in both directions and cancel. Gathering is the one
/// estimate here that is biased: it blurs within r (Georgiev et al.: Light Transport Simulation with Vertex Connection
/// and Merging, SIGGRAPH Asia 2012, has the general case). Media dim photons on their way, and scatter none.
///
/// Rough interfaces end shadow rays and chains, for a path is scattered there. Photons pass them, scattered as well. So
/// of a lamp seen from a surface through frosted glass, shadow rays that start at the glass, the path's directions, and
/// photons are three techniques for one integral, which has one more direction for each rough interface:
/// rough_chain.hpp. Where no earlier place of the path is lit by photons that came through a rough interface, as of
/// frosted glass that the camera sees, the interface itself is lit by photons that met it, from either side.
///
/// Places in a medium that scatters are lit by photons, too. There is no cos θ there. A photon stands at one random
/// place of its line through the medium, and with a probability F(t), which photon_placement.hpp has, that place is
/// near enough to count for the point of the line that is t behind the boundary. So the density is
///     N π r² (p(line)/m²) n² F(t).
///
/// Wavelengths (spectrum/wavelengths.hpp). If the scene asks for them a path, its shadow rays and the photons that it
/// gathers have the same three from the beginning on; else they have one, from where an interface disperses their
/// colours. So the techniques still estimate the same: the integral over directions and wavelengths. The density of
/// wavelengths is the same of all three, and cancels in their weights.
///
/// Guiding. Where a guide chooses some of the directions from a surface (guided.hpp), the density of the BSDF in all of
/// this is that of both together.
///
/// With a record it also fills that in. Neither the radiance nor the random numbers that are drawn depend on it.
glm::vec3 trace_path(const World& world, const Scene& scene, const Ray& ray, Sampler& sampler, PathCounters& counters,
                     PathRecord* record = nullptr, const PathHelp& help = {});

}  // namespace phasetree::tracer
