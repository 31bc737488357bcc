// Photon emission: from which light, point and direction photons start, and with which density.
//
// A photon starts on a line. Lines are measured by area and solid angle, dG = dA cos θ dω, which is the same at every
// point of the line. Refraction preserves n² dG (the étendue). The densities of infinite lights and area lights
// together form one mixture, with the share cᵢ of each source. Each other kind of source has a mixture of its own.
//
// *Infinite lights and area lights:*
//     p(line) = Σᵢ cᵢ pᵢ(line),   pᵢ = t/Ω  of an infinite light,   pᵢ = q/(A cos θ)  of an area light.
// Lines of an infinite light are sampled uniformly from a cap of directions with the solid angle Ω. Such a cap is the
// sun's disk, or a bright part of an image (lights/bright_parts.hpp), and each is a source. t is the density, per area
// across the line, with which the light's target chooses the line among parallel ones (target.hpp). For an area light,
// A is its area, θ the angle at its surface, and q the pdf per steradian of the line's direction as seen from there
// (aim.hpp). A photon carries the radiance seen along its line, whichever light proposed the line. If a lamp inside the
// sphere around the object is seen, p(line) is that of this lamp alone, because photons from behind the lamp end at it.
// The rest of an environment emits no photons. Lines that no source proposes are left to the other techniques of
// path.hpp.
//
// *Balls around parts of emissive surfaces:* pᵢ = q/(π r²), with the ball's radius r. p(line) is the sum of cᵢ pᵢ over
// those balls that would start a photon on this line at this same point (emissive_surface_lines.hpp).
//
// *Balls around parts of emissive media:* a point in the ball (points_in_ball.hpp) and a direction choose a line. The
// photon starts on the straight segment of that line that contains the point and is in the medium. The segment ends
// where the light leaves the medium. It begins where the line enters the medium, or at the opaque surface or lamp that
// hides the rest. The photon carries all emission along the segment. Any point of the segment gives the same segment,
// so pᵢ = q ∫ v, with the pdf q of the direction per steradian (directions.hpp), the density v of points per volume,
// and the integral along the part of the segment inside the ball. The sum is over all balls that the segment meets.
//
// *Point lights:* all lines of a point light pass through it, so they have no density by area. They have the density of
// directions cᵢ q, and a photon carries the light's intensity over that. No other technique finds light of a point
// light that was refracted by smooth interfaces before its first scattering.
#pragma once

#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "caustics/aim.hpp"
#include "caustics/discrete_distribution.hpp"
#include "caustics/points_in_ball.hpp"
#include "caustics/target.hpp"
#include "lights/cap.hpp"
#include "sampling/sobol.hpp"
#include "world/world.hpp"

namespace phasetree::tracer {

/// An emitted photon.
struct EmittedPhoton {
    /// Starts where its line enters the sphere around the object, or at its light if that is farther along the line, or
    /// on the emissive surface, or in the emissive medium.
    Ray ray;
    /// The light that is seen from the ray's origin against its direction, ignoring occluders; for an emissive medium,
    /// that seen from where the photon leaves the medium.
    Lights::Emission emission;
    glm::vec3 power;     ///< radiance of the light divided by p(line); for a point light, intensity divided by cᵢ q
    float line_density;  ///< p(line) divided by the squared refractive index at the origin; for a point light, cᵢ q
    std::size_t source;  ///< number of the source that proposed it, less than PhotonEmission::sources()
    std::size_t bin;     ///< the bin of the source that chose its direction
    /// Whether an emissive medium sends it. The power then already includes the attenuation by that medium up to the
    /// photon's first boundary, and nothing can hide the light from the origin.
    bool is_of_medium = false;
};

class PhotonEmission {
  public:
    /// Refers to the world and the scene, which must outlive it. Initially all sources have equal shares.
    PhotonEmission(const World& world, const Scene& scene);

    /// The number of sources that emit photons: lights, bright parts of lights, and parts of emissive surfaces and
    /// media. It is 0 if no clear phase refracts light and nothing is of metal, or if the object has no finite bounds.
    std::size_t sources() const { return sources_.size(); }
    /// The number of bins among which a source chooses the directions of its photons.
    std::size_t bins(std::size_t source) const;
    /// Samples a photon at a time given as a share of the shutter interval, in wavelengths or, if they are null, in
    /// red, green and blue. nullopt if no photon can start on the sampled line.
    std::optional<EmittedPhoton> sample(Sampler& sampler, float time, const Wavelengths* wavelengths = nullptr) const;
    /// See EmittedPhoton::line_density; for a line that leads from a point in this phase towards a light.
    float line_density(const glm::vec3& origin, const glm::vec3& towards_light, Phase phase) const;
    /// As above, for a line that leads to an emissive surface. `known_free` is the distance from the surface, against
    /// towards_light, over which the line is known to be free.
    float line_density(const Surface& emissive, const glm::vec3& towards_light, float known_free) const;
    /// As above, for a straight segment of a line in an emissive medium: from the boundary where its light leaves, back
    /// towards where it comes from, over `length`, which may be infinite. The phase is the medium's.
    float line_density_in_medium(const glm::vec3& boundary, const glm::vec3& towards_light, Phase phase,
                                 float length) const;
    /// As above, for a point light, by its number in Lights::points(), and a direction from it: per steradian.
    float direction_density(std::size_t point_light, const glm::vec3& from_light) const;

    /// Makes the probabilities of sources and bins nearly proportional to worth[source][bin]; a tenth of the photons
    /// stays spread evenly. Does nothing if all are 0.
    void learn(std::vector<std::vector<double>> worth);

  private:
    struct CapSource {
        Cap cap;  ///< part of an infinite light
        PhotonTarget aim;
    };
    /// A light with a position, by its number among the lights of its kind.
    struct AreaSource {
        std::size_t number;
        PhotonAim aim;
    };
    struct PointSource {
        std::size_t number;
        PhotonAim aim;
    };
    /// A part of an emissive surface.
    struct EmissiveSurfaceSource {
        BoundingSphere ball;
        PhotonDirections aim;
    };
    /// A part of an emissive medium: `points` chooses a point of the line, and `aim` its direction. Only the bins of
    /// `aim` are learned.
    struct EmissiveMediumSource {
        PointsInBall points;
        PhotonDirections aim;
    };
    using Source = std::variant<CapSource, AreaSource, PointSource, EmissiveSurfaceSource, EmissiveMediumSource>;

    /// The line of a photon, before its light is known.
    struct Line {
        glm::vec3 through;  ///< a point of the line
        glm::vec3 direction;
        float back;  ///< from that point to the light; infinity for an infinite light
        std::size_t bin;
    };
    std::optional<Line> sampled_line(const CapSource&, Sampler&) const;
    std::optional<Line> sampled_line(const AreaSource&, Sampler&) const;
    std::optional<Line> sampled_line(const PointSource&, Sampler&) const;
    std::optional<Line> sampled_line(const EmissiveSurfaceSource&, Sampler&) const;
    std::optional<Line> sampled_line(const EmissiveMediumSource&, Sampler&) const;
    /// The number of the source that proposed the line, and the arguments of sample().
    struct Start {
        std::size_t source;
        float time;
        const Wavelengths* wavelengths;
        Sampler& sampler;
    };
    /// The photon that starts on a line. nullopt if no photon can start there.
    std::optional<EmittedPhoton> photon_on(const Line& line, const CapSource&, const Start& start) const {
        return photon_of_visible_light(line, start);
    }
    std::optional<EmittedPhoton> photon_on(const Line& line, const AreaSource&, const Start& start) const {
        return photon_of_visible_light(line, start);
    }
    std::optional<EmittedPhoton> photon_on(const Line&, const PointSource&, const Start&) const;
    std::optional<EmittedPhoton> photon_on(const Line&, const EmissiveSurfaceSource&, const Start&) const;
    std::optional<EmittedPhoton> photon_on(const Line&, const EmissiveMediumSource&, const Start&) const;
    /// As above, with the light that is seen backwards along the line, whichever source proposed the line.
    std::optional<EmittedPhoton> photon_of_visible_light(const Line&, const Start&) const;

    /// Makes the probabilities of points of a ball proportional to the brightness of media there, except for a tenth,
    /// which stays uniform. Evaluates this many points per bin, at most 8.
    void prefer_bright_points(PointsInBall& points, std::size_t points_per_bin) const;
    /// The luminance per unit length that a medium emits at a point.
    double brightness_at(const glm::vec3& place, float time) const;
    /// A point of a line that is certain to be in front of everything that the line meets of the object.
    glm::vec3 outside_of_object(const glm::vec3& point, const glm::vec3& direction) const;
    /// Where a photon starts on a line; nullopt in an opaque phase.
    std::optional<Ray> ray_on(const Line&, float time) const;

    float share(std::size_t source) const { return static_cast<float>(choice_.probability(source)); }
    float density(const CapSource&, const glm::vec3& origin, const glm::vec3& towards_light) const;
    /// The density with which a lamp emits photons on a line, and the distance to the lamp; infinity if the line misses
    /// it.
    struct LampOnLine {
        float density, distance;
    };
    LampOnLine lamp_on_line(const AreaSource&, const glm::vec3& origin, const glm::vec3& towards_light) const;

    const World& world_;
    const Scene& scene_;
    glm::vec3 centre_{0};
    float radius_ = 0;  ///< of the sphere around the object
    /// First those of infinite lights, then area lights in their order, then point lights, then parts of emissive
    /// surfaces and media, in the order of Lights::emissive_parts().
    std::vector<Source> sources_;
    std::size_t first_area_ = 0, first_point_ = 0, first_emissive_ = 0;
    DiscreteDistribution choice_{1};  ///< of a source: cᵢ
};

}  // namespace phasetree::tracer
