// Unidirectional path tracing from phase to phase (Kajiya: The Rendering Equation, SIGGRAPH 1986), with next-event
// estimation, multiple importance sampling by the power heuristic (Veach & Guibas, SIGGRAPH 1995) and Russian roulette.
#pragma once

#include "film/path_record.hpp"
#include "integrator/path_context.hpp"

namespace phasetree::tracer {

class Guide;
class PathGuideSamples;

/// Optional inputs and outputs of a path.
struct PathHelp {
    Photons photons{};
    const Guide* guide = nullptr;               ///< guides directions at surfaces (path_guiding.hpp)
    PathGuideSamples* guide_samples = nullptr;  ///< collects the light that the path finds, to train the next guide
};

/// Estimates the radiance that arrives along a ray. Without photons, the estimate is unbiased except that paths are
/// truncated after RenderSettings::max_depth surfaces and scattering events. Photon gathering adds a blur (see below).
/// The estimate is black for a ray that starts in an opaque phase.
///
/// Light through clear interfaces. A shadow ray that meets a smooth interface of two clear phases continues through it,
/// reflected or refracted at random with the probabilities of Fresnel's equations. (A path may use other probabilities;
/// see interface_choice.hpp.) The light that the shadow ray finds at its end counts as arriving at the vertex from ω,
/// the direction in which the ray started. A thin wall hardly bends it, so a lamp behind glass is found about as often
/// as an unoccluded one. Shadow rays and the path's own continuation in a direction sampled from the BSDF are thus two
/// techniques for the same integral over ω,
///     ∫ f(ω) E(ω) dω,   E: emission at the end of a chain of smooth clear interfaces, of any length from 0,
/// combined by the power heuristic of their pdfs *of ω*: that of light sampling, and that of the BSDF. A path keeps
/// these two pdfs through the chain. No light is counted twice, regardless of what it is seen through. The only light
/// that is lost is that of paths that reach max_depth within a chain; the weights do not compensate for it.
/// light_proposal.hpp determines the directions in which shadow rays start.
///
/// Thin panes. Light goes straight through a smooth pane, so no technique counts a pane that light passes as an
/// interface of a chain. A shadow ray passes it without choosing at random, even towards a point light, and the pane's
/// transmittance multiplies its light. Reflection by a pane counts like that by a mirror: shadow rays do not follow it,
/// but sampled directions and photons do.
///
/// Scattering media. A path may be scattered in a medium. Such a point is treated like a surface point: it does
/// next-event estimation and samples a direction, with the phase function instead of the BSDF. E then includes the
/// transmittance along the chain, by absorption and scattering together, for every technique.
///
/// Photons are a third technique for the same integral, for chains of at least one interface: E as found from the
/// light's end (caustics/caustics.hpp). If N photons start per pass and those within r of the surface point are
/// gathered, they find directions ω with the expected density
///     N π r² (p(line)/n_l²) n² cos θ.
/// Here p(line) is the pdf of the line along which a
/// photon leaves the light, per area perpendicular to the line and per solid angle. n_l is the index around the light
/// (p(line)/n_l² is EmittedPhoton::line_density), n is the index at the surface, and cos θ converts area across the
/// line into area of the surface. The étendue, index² · area across the line · solid angle, is the same all along a
/// chain, however its interfaces are curved. The probabilities of Fresnel's equations are the same in both directions
/// and cancel. Gathering is the one biased estimate here: it blurs within r (Georgiev et al.: Light Transport
/// Simulation with Vertex Connection and Merging, SIGGRAPH Asia 2012, has the general case). Media attenuate photons on
/// their way, but do not scatter them.
///
/// Rough interfaces and rough metal end shadow rays and chains because a path is scattered there. Photons continue from
/// them and are scattered, too. In what follows, and where chains are concerned, "rough interfaces" includes rough
/// metal. For a lamp seen from a surface through frosted glass there are therefore three techniques: shadow rays that
/// start at the glass, the path's directions, and photons. They estimate one integral, which has one more direction for
/// each rough interface (rough_chain.hpp). If no earlier vertex of the path gathers photons that came through a rough
/// interface, for example because the camera sees the frosted glass directly, the interface itself gathers the photons
/// that met it, from either side.
///
/// Points in a scattering medium gather photons, too. There is no cos θ there. A photon is stored at one random point
/// of its line through the medium. A vertex at the depth t behind the boundary, along that line, gathers the photon if
/// the stored point is close enough to the vertex. The probability of that is F(t), the coverage
/// (photon_placement.hpp). So the density is
///     N π r² (p(line)/n_l²) n² F(t).
///
/// Wavelengths (spectrum/wavelengths.hpp). If the scene requests them, a path, its shadow rays and the photons that it
/// gathers have the same three wavelengths from the start. Otherwise they carry colours until the first dispersive
/// interface, and a single wavelength from there on. So the techniques still estimate the same integral, over
/// directions and wavelengths. All three techniques have the same density of wavelengths, which cancels in their
/// weights.
///
/// Guiding. Where a guide chooses some of the directions from a surface (guided.hpp), the pdf of the mixture replaces
/// that of the BSDF in all of the above.
///
/// If `record` is given, it is filled in. Neither the radiance nor the random numbers drawn depend on it.
glm::vec3 trace_path(const World& world, const Scene& scene, const Ray& ray, Sampler& sampler, PathCounters& counters,
                     PathRecord* record = nullptr, const PathHelp& help = {});

}  // namespace phasetree::tracer
