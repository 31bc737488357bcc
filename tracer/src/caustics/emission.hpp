// How photons leave the lights: from which light, where and in which direction, and how densely.
//
// A photon starts on a line. Lines are measured by area and solid angle, dG = dA cos θ dω, which is the same at every
// point of the line; where light is refracted n² dG is kept (the étendue). The densities of infinite
// lights and area lights together are one mixture, with the share cᵢ of each source; those of each other kind of source
// are a mixture by themselves.
//
// *Infinite lights and area lights:*
//     p(line) = Σᵢ cᵢ pᵢ(line),   pᵢ = t/Ω  of an infinite light,   pᵢ = q/(A cos θ)  of an area light.
// Of an infinite light lines come evenly from a cap of directions of the solid angle Ω: the sun's disk, or a bright
// part of an image (lights/bright_parts.hpp), each of which is a source. t is the density, per area across, with which
// the light's target chooses the line among parallel ones (target.hpp). Of an area light, A is its area, θ the angle at
// its surface, and q the density per steradian of the line's direction as seen from there (aim.hpp). A photon carries
// what is seen along its line, whichever light proposed it. If that is a lamp within the sphere about the object,
// p(line) is of that lamp alone, because the photons of what is behind it end at it. The rest of a light that comes
// from all around sends no photons. Lines that nothing proposes are left to the other techniques of path.hpp.
//
// *Balls around parts of surfaces that glow:* pᵢ = q/(π r²), with the ball's radius r. The sum is over those balls that
// would start a photon on this line at this same place (glowing_lines.hpp).
//
// *Balls around parts of media that shine:* a place in the ball (places.hpp) and a direction choose a line, and the
// place chooses the straight piece of it that is in the medium. The piece ends where the light leaves the medium. It
// begins where the line enters the medium, or at the opaque surface or lamp that hides the rest. The photon carries all
// that the medium sends along the piece. Any place on the piece would have chosen it, so pᵢ = q ∫ v, with the density q
// of the direction per steradian (directions.hpp), the density v of places per volume, and the integral along the part
// of the piece that is in the ball. The sum is over all balls that the piece meets.
//
// *Point lights:* all lines of one pass through it, and have no density by area. They have one of directions, cᵢ q, and
// a photon carries the light's intensity over that. No other technique finds light of it that smooth interfaces bent
// before anything scattered it.
#pragma once

#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "caustics/aim.hpp"
#include "caustics/cell_choice.hpp"
#include "caustics/places.hpp"
#include "caustics/target.hpp"
#include "lights/cap.hpp"
#include "sampling/sobol.hpp"
#include "world/world.hpp"

namespace phasetree::tracer {

/// A photon that is about to start.
struct EmittedPhoton {
    /// It starts where its line enters the sphere about the object, or at its light if that is farther along the line,
    /// or on the surface that glows, or in the medium that shines.
    Ray ray;
    /// What is seen from the origin backwards if nothing is in the way; of a medium that shines, from where the photon
    /// leaves it.
    Lights::Emission emission;
    glm::vec3 power;     ///< radiance of the light over p(line); of a point light, intensity over cᵢ q
    float line_density;  ///< p(line) over the square of the refractive index at the origin; of a point, cᵢ q
    std::size_t source;  ///< the number of the source that proposed it: less than PhotonEmission::sources()
    std::size_t cell;    ///< that cell of the source in which it is aimed
    /// Whether a medium that shines sends it. Then the power already includes what that medium takes away up to the
    /// photon's first boundary, and nothing can hide the light from the origin.
    bool is_of_medium = false;
};

class PhotonEmission {
  public:
    /// Refers to the world and the scene, which must outlive it. All sources have equal shares at first.
    PhotonEmission(const World& world, const Scene& scene);

    /// How many sources send photons: lights, bright parts of lights, and parts of surfaces that glow and of media that
    /// shine. There are none if no clear phase bends light and nothing is of metal, or if the object has no
    /// finite bounds.
    std::size_t sources() const { return sources_.size(); }
    /// In how many cells a source aims its photons.
    std::size_t cells(std::size_t source) const;
    /// Samples a photon that flies at a share of the time in which the shutter is open, of light of wavelengths or,
    /// without any, of red, green and blue. Nothing if its line leads nowhere.
    std::optional<EmittedPhoton> sample(Sampler& sampler, float time, const Wavelengths* wavelengths = nullptr) const;
    /// As EmittedPhoton::line_density, for a line that leads from a point in this phase towards a light.
    float line_density(const glm::vec3& origin, const glm::vec3& towards_light, Phase phase) const;
    /// The same of a line that leads to a surface that glows. `known_free` is the distance from the surface, against
    /// towards_light, over which the line is known to be free.
    float line_density(const Surface& glowing, const glm::vec3& towards_light, float known_free) const;
    /// The same of a straight piece of a line in a medium that shines, from the boundary where its light comes out,
    /// back against that light over `length`, which may be infinite. The phase is the medium's.
    float line_density_in_medium(const glm::vec3& boundary, const glm::vec3& against_light, Phase phase,
                                 float length) const;
    /// The same of a point light, by its number in Lights::points(), for a direction from it: per steradian.
    float direction_density(std::size_t point_light, const glm::vec3& from_light) const;

    /// From now on sources and cells are chosen nearly in proportion to these numbers, worth[source][cell]; a tenth of
    /// the photons stays spread evenly. If all are 0 nothing changes.
    void learn(std::vector<std::vector<double>> worth);

  private:
    struct OfCap {
        Cap cap;  ///< of an infinite light
        PhotonTarget aim;
    };
    /// Of lights with a place, by the light's number among those of its sort.
    struct OfArea {
        std::size_t number;
        PhotonAim aim;
    };
    struct OfPoint {
        std::size_t number;
        PhotonAim aim;
    };
    /// Of a part of a surface that glows.
    struct OfGlowing {
        BoundingSphere ball;
        PhotonDirections aim;
    };
    /// Of a part of a medium that shines: `places` chooses a point of the line, and `aim` its direction. Only the cells
    /// of `aim` are learnt.
    struct OfShining {
        PhotonPlaces places;
        PhotonDirections aim;
    };
    using Source = std::variant<OfCap, OfArea, OfPoint, OfGlowing, OfShining>;

    /// Where photons fly, before it is known what sends them.
    struct Line {
        glm::vec3 through;  ///< a point of the line
        glm::vec3 direction;
        float back;  ///< from that point to the light; infinity of an infinite light
        std::size_t cell;
    };
    std::optional<Line> sampled_line(const OfCap&, Sampler&) const;
    std::optional<Line> sampled_line(const OfArea&, Sampler&) const;
    std::optional<Line> sampled_line(const OfPoint&, Sampler&) const;
    std::optional<Line> sampled_line(const OfGlowing&, Sampler&) const;
    std::optional<Line> sampled_line(const OfShining&, Sampler&) const;
    /// What a photon is that starts on a line: the number of the source that proposed the line, and as sample() has it.
    struct Start {
        std::size_t source;
        float time;
        const Wavelengths* wavelengths;
        Sampler& sampler;
    };
    /// The photon that starts on a line. Nothing if no photon can start there.
    std::optional<EmittedPhoton> photon_on(const Line& line, const OfCap&, const Start& start) const {
        return photon_of_seen(line, start);
    }
    std::optional<EmittedPhoton> photon_on(const Line& line, const OfArea&, const Start& start) const {
        return photon_of_seen(line, start);
    }
    std::optional<EmittedPhoton> photon_on(const Line&, const OfPoint&, const Start&) const;
    std::optional<EmittedPhoton> photon_on(const Line&, const OfGlowing&, const Start&) const;
    std::optional<EmittedPhoton> photon_on(const Line&, const OfShining&, const Start&) const;
    /// The same, of whatever light is seen along the line.
    std::optional<EmittedPhoton> photon_of_seen(const Line&, const Start&) const;

    /// From now on places of a ball are chosen in proportion to how brightly media shine there, but for a tenth, which
    /// stays even. This many places of each cell are asked, at most 8.
    void prefer_bright_places(PhotonPlaces& places, std::size_t asked_a_cell) const;
    /// The luminance per unit of length that a medium sends at a place.
    double brightness_at(const glm::vec3& place, float time) const;
    /// A point of a line that is sure to be before everything that it meets of the object.
    glm::vec3 outside_of_object(const glm::vec3& point, const glm::vec3& direction) const;
    /// Where a photon starts on a line; none in an opaque phase.
    std::optional<Ray> ray_on(const Line&, float time) const;

    float share(std::size_t source) const { return static_cast<float>(choice_.probability(source)); }
    float density(const OfCap&, const glm::vec3& origin, const glm::vec3& towards_light) const;
    /// How densely a lamp's lines are on this one, and how far it is; infinity if it is not there.
    struct LampOnLine {
        float density, distance;
    };
    LampOnLine met(const OfArea&, const glm::vec3& origin, const glm::vec3& towards_light) const;

    const World& world_;
    const Scene& scene_;
    glm::vec3 centre_{0};
    float radius_ = 0;  ///< of the sphere about the object
    /// First those of infinite lights, then area lights in their order, then point lights, then parts of what glows or
    /// shines, in the order of Lights::glowing().
    std::vector<Source> sources_;
    std::size_t first_area_ = 0, first_point_ = 0, first_glowing_ = 0;
    CellChoice choice_{1};  ///< of a source: cᵢ
};

}  // namespace phasetree::tracer
