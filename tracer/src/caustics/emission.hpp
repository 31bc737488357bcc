// How photons leave the lights: from which light, where and in which direction, and how densely.
//
// A photon starts on a line. Lines are measured by area and solid angle, dG = dA cos θ dω, which is the same at every
// point of the line; where light is refracted n² dG is kept (the étendue). The density of lines is a mixture of the
// lights' own, as that of directions is (lights/lights.hpp),
//     p(line) = Σᵢ cᵢ pᵢ(line),   pᵢ = t/Ω  of an infinite light,   pᵢ = t d²/(A cos θ)  of an area light,
// with the density t of the line in the light's target (target.hpp), the light's area A, the angle θ at its surface and
// the distance d from there to the target. Of an infinite light, lines come evenly from a cap of directions of the
// solid angle Ω: the sun's disk, or a bright part of an image (lights/bright_parts.hpp), each of which is a source of
// its own. What a photon carries is what is seen along its line, whichever light proposed it. Lights that are all
// around send none, and lines that no light proposes are left to the other techniques of path.hpp.
//
// The lines of a point light all pass through it, and have no such density. They have one of directions, cᵢ t d², and
// with the intensity I of the light in place of a radiance a photon carries I/(cᵢ t d²). No other technique finds what
// interfaces bent of it before anything scattered it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "caustics/target.hpp"
#include "lights/cap.hpp"
#include "sampling/sobol.hpp"
#include "world/world.hpp"

namespace phasetree::tracer {

/// A photon that is about to start.
struct EmittedPhoton {
    Ray ray;                    ///< its origin is outside of the object, or at the light if that is nearer
    Lights::Emission emission;  ///< what is seen from the origin backwards if nothing is in the way
    glm::vec3 power;            ///< radiance of the light over p(line)
    float line_density;  ///< p(line) over the square of the refractive index at the origin; of a point, cᵢ t d²
    std::size_t light;   ///< the number of the light that proposed it: less than PhotonEmission::lights()
    std::size_t cell;    ///< of that light's target
};

class PhotonEmission {
  public:
    /// Refers to the world and the scene, which must outlive it. All lights have equal shares at first.
    PhotonEmission(const World& world, const Scene& scene);

    /// How many lights send photons, and bright parts of lights: none if nothing clear bends light.
    std::size_t lights() const { return sources_.size(); }
    /// One that flies at a share of the time in which the shutter is open. Nothing if the line leads nowhere.
    std::optional<EmittedPhoton> sample(Sampler& sampler, float time) const;
    /// As EmittedPhoton::line_density, for a line that leads from a point in this phase towards a light.
    float line_density(const glm::vec3& origin, const glm::vec3& towards_light, Phase phase) const;
    /// The same of a point light, by its number among those, for a direction from it: per steradian.
    float direction_density(std::size_t point_light, const glm::vec3& from_light) const;

    /// Chooses lights and cells of their targets in proportion to these numbers from now on: worth[light][cell].
    void learn(std::vector<std::vector<double>> worth);

  private:
    struct Source {
        std::optional<Cap> cap;  ///< of an infinite light
        std::optional<std::size_t> area,
            point;     ///< the light's number among those of its sort; one of the three is there
        double share;  ///< cᵢ
        PhotonTarget target;
    };
    /// A point of a line that is sure to be before everything that it meets of the object.
    glm::vec3 outside_of_object(const glm::vec3& point, const glm::vec3& direction) const;
    float density_of(const Source& source, const glm::vec3& origin, const glm::vec3& towards_light) const;
    /// cᵢ t d² of a point light.
    float direction_density(const Source& source, const glm::vec3& from_light) const;
    /// Where a photon starts that flies to this point of a target in this direction, and comes from this far behind it;
    /// none in an opaque phase.
    std::optional<Ray> start(const glm::vec3& target, const glm::vec3& direction, float back, float time) const;
    std::optional<EmittedPhoton> of_point_light(std::size_t number, const PhotonTarget::Aim& aim, float time) const;

    const World& world_;
    const Scene& scene_;
    glm::vec3 centre_{0};
    float radius_ = 0;                              ///< of the sphere about the object
    std::vector<Source> sources_;                   ///< caps first, then area lights in their order, then point lights
    std::size_t first_area_ = 0, first_point_ = 0;  ///< of the sources
};

}  // namespace phasetree::tracer
