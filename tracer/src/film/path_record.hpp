// Data of a path, besides its radiance, for the planes that need it.
//
// A camera ray is followed through perfectly smooth surfaces to the first one that is not: that is what one sees of the
// scene, in a mirror or behind glass. At each interface, it makes the same choice as the path. Paths are weighted as if
// interfaces had reflected with the probabilities of Fresnel's equations. So means over the samples of a pixel blend
// reflection and refraction in the proportions in which one sees them. The documentation of Open Image Denoise
// recommends this for its albedo and normal. Rousselle, Manzi & Zwicker (Robust Denoising using Feature and Color
// Information, Computer Graphics Forum 32(7), 2013) use it for the features of a filter.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "phasetree/model/phase.hpp"

namespace phasetree::tracer {

/// A surface that was met: an interface of two phases, or a mesh. Interfaces between equal refractive indices, where
/// nothing scatters, do not count.
struct RecordedSurface {
    glm::vec3 position;  ///< in the scene
    glm::vec3 normal;    ///< unit length, on the side from which it was met
    float distance;      ///< length of the path up to here
    /// The weight of the path's next direction, f |cos θ| / pdf, without the factor (η/η')² by which refraction scales
    /// radiance. Its mean over paths is the share of light that is scattered: the colour of a diffuse surface, and 1
    /// for smooth glass.
    glm::vec3 albedo;
    std::uint32_t object;           ///< the objects of phases first, then the meshes
    std::uint32_t instance;         ///< number of the copy of an object; 0 for an object that exists once
    Phase phase_from;               ///< on the side from which it was met
    std::optional<Phase> phase_to;  ///< on the other side; nullopt for a mesh
};

struct PathRecord {
    /// The part of the radiance that was scattered at most once. Smooth clear interfaces, which only reflect and
    /// refract, do not count as scattering; mirrors do.
    glm::vec3 direct{0};
    /// Everything else: the radiance without the direct part.
    glm::vec3 indirect{0};
    /// The part of each group of lights (Lights::groups). They add up to the radiance, up to rounding.
    std::vector<glm::vec3> groups;
    /// Whether the camera ray left the scene. It then saw the lights at infinity, or the background that replaces them.
    bool shows_background = false;
    /// The probability of the path's choices according to Fresnel's equations, divided by the probability with which
    /// they were actually made (integrator/interface_choice.hpp), up to the first surface that is not perfectly smooth.
    /// It is at most weight_limit, up to rounding. `behind->albedo` already includes it; no other member does. Russian
    /// roulette is not included.
    float weight = 1;
    static constexpr float weight_limit = 16;
    /// The first surface.
    std::optional<RecordedSurface> first;
    /// The first surface that is not perfectly smooth. Its albedo includes the throughput of white light up to there
    /// and its own scattering.
    std::optional<RecordedSurface> behind;
    /// The distance that the path has travelled in each phase up to there. A segment that leaves the scene does not
    /// count.
    std::vector<float> lengths;
};

}  // namespace phasetree::tracer
