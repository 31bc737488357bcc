// What one path tells of itself beside its radiance, for the planes that ask for it.
//
// A camera ray is followed from the camera, by the path's own choices at each interface, through what is smooth, to the
// first surface that is not: that is what one sees of the scene, in a mirror or behind glass. Paths have weights, with
// which they count as if interfaces reflected by Fresnel's odds. So means over the samples of a pixel are blends of
// what is reflected and what is refracted, as much of each as one sees. So the documentation of Open Image Denoise
// recommends it for its albedo and normal, and so Rousselle, Manzi & Zwicker (Robust Denoising using Feature and Color
// Information, Computer Graphics Forum 32(7), 2013) have it for the features of a filter.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "phasetree/model/phase.hpp"

namespace phasetree::tracer {

/// A surface that was met: an interface of two phases, or a mesh. Interfaces between equal refractive indices, where
/// nothing scatters, are none.
struct RecordedSurface {
    glm::vec3 position;  ///< in the scene
    glm::vec3 normal;    ///< of unit length, on the side from which it was met
    float distance;      ///< the length of the path from its start to here
    /// What the path's next direction weighs, f |cos θ| / pdf, without the change of radiance that refraction makes by
    /// (η/η')²: the mean over paths is the share of light that is scattered on. It is the colour of what is diffuse
    /// and 1 of smooth glass.
    glm::vec3 albedo;
    std::uint32_t object;          ///< the objects of phases come first, then the meshes
    std::uint32_t instance;        ///< the number of the copy of an object; 0 of one that is there once
    Phase left;                    ///< the phase on the side from which it was met
    std::optional<Phase> entered;  ///< the one behind; none behind a mesh
};

struct PathRecord {
    /// The part of the radiance that was scattered once at most, where smooth clear interfaces, which only reflect and
    /// refract, do not count; what a mirror shows has been scattered by it.
    glm::vec3 direct{0};
    /// Everything else: the radiance without the direct part.
    glm::vec3 indirect{0};
    /// The part of each group of lights (Lights::groups). They add up to the radiance, but for the rounding of sums.
    std::vector<glm::vec3> groups;
    /// Whether the camera ray left the scene and saw the lights at infinity, or the background in their place.
    bool shows_background = false;
    /// How often the path would go where it does if each interface reflected by Fresnel's odds, over how often it does
    /// (integrator/interface_choice.hpp), up to the first surface that is not perfectly smooth; at most weight_limit,
    /// but for rounding. `behind->albedo` has it in it already, nothing else here has. Roulette is no part of it.
    float weight = 1;
    static constexpr float weight_limit = 16;
    /// The first surface.
    std::optional<RecordedSurface> first;
    /// The first surface that is not perfectly smooth. Its albedo is what is left of white light on the way there and
    /// by its own scattering.
    std::optional<RecordedSurface> behind;
    /// How far the path has travelled in each phase up to there; what it travels when it then leaves the scene does
    /// not count.
    std::vector<float> lengths;
};

}  // namespace phasetree::tracer
