// All lights of a scene, as the integrator sees them.
//
// Sampling is one density over *directions*, a mixture of the lights' own:
//     p(ω | x) = Σᵢ cᵢ(x) pᵢ(ω | x),   Σ cᵢ ≤ 1.
// A light is chosen with cᵢ, a direction from that light's pᵢ, and the sample is then what is *seen* along that
// direction if no geometry is in the way: the nearest area light, or, if there is none, all infinite lights together
// (sky + sun). The radiance belongs to the direction, not to the light that proposed it, and the density is the whole
// mixture's. So overlapping lights (the sun's disk in front of the sky, a lamp in front of another) are neither counted
// twice nor lost, ∫ f(ω) L(ω) dω has the unbiased estimator f L/p, and BSDF samples combine with light samples by one
// pair of densities.
//
// cᵢ(x) is proportional to the luminance the light sends through x from all directions if nothing is in the way (its
// fluence, the mean luminance times the solid angle; of a rectangle, roughly); at a surface, to the luminance that it
// receives, with the cosine. Of light from all around the share counts by which it is uneven, a tenth at
// least (unevenness(), in diffuse_irradiance.hpp), unless there are portals. Unlike emitted power this needs no extent
// of the scene to compare an environment with a lamp, and lamps that are far away, turned away or below the surface
// take few samples or none.
//
// Many lamps, which are area lights, point lights and parts of surfaces that glow, are in clusters (light_tree.hpp). A
// lamp's cᵢ is then that of the root above it times the probability of the path to the lamp. Σ cᵢ may be less than 1,
// since a cluster is chosen by an estimate: if none of its lamps gives light, there is no sample.
//
// Area lights hide what is behind them, rectangles from their emitting side, spheres from everywhere. No other light
// hides anything.
//
// A point light is chosen by the same rule, but it is no part of the density. Its sample has the probability of the
// choice instead, and no direction that a path samples otherwise leads to it.
//
// Surfaces that glow, and media that shine, are part of the geometry, and no light of this list. Balls around them are
// lamps of the tree that propose directions and emit nothing (glowing_part.hpp): a shadow ray in a direction, whoever
// proposed it, brings what the media on its way send, and the glowing surface that it meets before it gets to the light
// that is seen there.
//
// Portals are sampled instead of some samples of lights that are all around: a point that sees portals moves three
// quarters of those lights' weight to the portals, in proportion to their solid angles. A portal is one more density in
// the mixture and emits nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lights/diffuse_irradiance.hpp"
#include "lights/glowing_part.hpp"
#include "lights/kinds.hpp"
#include "lights/light_receiver.hpp"
#include "lights/light_tree.hpp"
#include "lights/portal.hpp"
#include "spectrum/light_spectrum.hpp"

namespace phasetree::tracer {

/// What shines in some direction: all infinite lights together, what camera rays see instead of them, an area light or
/// a point light, by its number in area() or points(), or a surface that glows, by its group's number in groups().
struct InfiniteLights {};
struct Background {};
struct OfAreaLight {
    std::uint32_t index;
};
struct OfPointLight {
    std::uint32_t index;
};
struct OfGlowingSurface {
    std::uint32_t group;
};
using LightSource = std::variant<InfiniteLights, Background, OfAreaLight, OfPointLight, OfGlowingSurface>;

struct LightSample {
    glm::vec3 wi;        ///< unit, from the point towards the light
    float distance;      ///< to the light; infinity for infinite lights
    glm::vec3 radiance;  ///< the radiance that arrives from there if no geometry is in between
    float pdf;           ///< per steradian, of the whole mixture; of a point light, the probability that it was chosen
    LightSource source;  ///< the light that the radiance comes from

    /// Whether it is of a point light. Then `radiance` is its irradiance on a surface that faces it, and no
    /// direction that is sampled otherwise leads to it.
    bool is_of_point_light() const { return std::holds_alternative<OfPointLight>(source); }
};

inline constexpr std::string_view default_group = "default";

class Lights {
  public:
    struct Emission {
        float distance;  ///< infinity for infinite lights
        glm::vec3 radiance;
        LightSource source;

        bool is_of_point_light() const { return std::holds_alternative<OfPointLight>(source); }
    };

    /// Lights belong to groups, whose shares of a picture can be recorded separately (add_to_groups). The background
    /// and lights that name no group are of the group `default_group`.
    /// What a light sends is in its own colour or, with a spectrum, in that, and as bright.
    void add(InfiniteLight light, std::string_view group = default_group, SharedLightSpectrum spectrum = {});
    void add(AreaLight light, std::string_view group = default_group, SharedLightSpectrum spectrum = {});
    void add(AnyPointLight light, std::string_view group = default_group, SharedLightSpectrum spectrum = {});
    void add(const GlowingPart& part);
    /// A portal is of no group: it has no light of its own.
    void add(const Portal& portal) { portals_.push_back(portal); }
    /// To be called once all lights are there. It clusters the lamps, if there are more than LightTree::most_roots.
    /// Adding another lamp dissolves the clusters, and then all lamps are asked for each sample.
    void cluster_lamps();
    /// What camera rays see instead of the infinite lights.
    void set_background(const std::optional<glm::vec3>& radiance);
    /// Whether camera rays that meet nothing see no light.
    bool is_background_black() const { return background_ ? *background_ == glm::vec3(0.0f) : infinite_.empty(); }

    /// The number in groups() of a group, which is added if there is none of this name.
    std::size_t group_of(std::string_view name);
    /// The names of the groups, default_group first.
    const std::vector<std::string>& groups() const { return groups_; }
    /// Adds what a path found of a light that was seen in the direction, as a colour, to that light's group: of light
    /// of wavelengths or of red, green and blue. What came of infinite lights in several groups is shared out as they
    /// shine in that direction; it then adds up to the colour of all but for rounding. `groups` is as long as groups().
    void add_to_groups(const glm::vec3& found, const Wavelengths* wavelengths, const LightSource& source,
                       const glm::vec3& direction, std::span<glm::vec3> groups) const;

    /// Whether there are none, glowing parts left aside.
    bool empty() const { return infinite_.empty() && area_.empty() && points_.empty(); }
    /// Those of all lights; null for one without.
    std::vector<SharedLightSpectrum> spectra() const;
    std::span<const InfiniteLight> infinite() const { return infinite_; }
    std::span<const AreaLight> area() const { return area_; }
    std::span<const AnyPointLight> points() const { return points_; }
    std::span<const GlowingPart> glowing() const { return glowing_; }

    /// `u` in [0, 1)². Its x chooses the light, and what is left of it, stretched to [0, 1) again, is the x that the
    /// light's own sampling gets: points that are stratified in the square are so for each light. Nothing if no light
    /// reaches the place, if the cluster that is chosen gives nothing there, or if rounding misses the light.
    /// Its radiance is that at the wavelengths, if there are any, as in all that follows.
    std::optional<LightSample> sample(const LightReceiver& at, glm::vec2 u,
                                      const Wavelengths* wavelengths = nullptr) const;

    /// What a ray sees that meets geometry at that distance, infinity for none: the nearest area light before it or, if
    /// nothing is in the way, the infinite lights. Camera rays pass through lights that are not visible to the camera.
    std::optional<Emission> seen(const glm::vec3& origin, const glm::vec3& direction, float geometry, bool camera_ray,
                                 const Wavelengths* wavelengths = nullptr) const;

    /// Calls use(number) for each lamp of one kind, area lights or parts of what glows, that a ray from the origin in a
    /// unit direction may meet before a distance, and for some others. Without clusters all of the kind come, in their
    /// order.
    template <class Use>
    void for_each_lamp_near(LightNode::Kind kind, const glm::vec3& origin, const glm::vec3& direction, const Use& use,
                            float before = std::numeric_limits<float>::infinity()) const {
        tree_.for_each_maybe_hit(
            origin, direction, [before] { return before; },
            [&](const LightNode& lamp) {
                if (lamp.kind == kind) use(lamp.number);
            });
    }

    /// The nearest area light that a ray meets before geometry at that distance.
    std::optional<Emission> area_light_seen(const glm::vec3& origin, const glm::vec3& direction, float geometry,
                                            bool camera_ray, const Wavelengths* wavelengths = nullptr) const;

    /// The luminance of the brightest ball around a part of what glows that a ray meets: an estimate of what comes from
    /// there if nothing is in the way. 0 if it meets none.
    float glowing_luminance(const glm::vec3& origin, const glm::vec3& direction) const;

    /// What the point light of this number in points() sends in a direction away from it: its radiant intensity.
    glm::vec3 intensity(std::size_t index, const glm::vec3& away, const Wavelengths* wavelengths = nullptr) const;

    /// How far light on its way from an origin in a unit direction gets before an area light takes it: one that hides
    /// the origin from who looks back. Nothing if there is none before the distance `far`. The light that comes from
    /// `own` starts there, so that one is left out.
    std::optional<float> area_light_in_the_way(const glm::vec3& origin, const glm::vec3& direction, float far,
                                               const LightSource& own) const;

    /// The density of sample() there, per steradian.
    float pdf(const LightReceiver& at, const glm::vec3& direction) const;

    /// The probability with which sample() chooses the point light of this number in points().
    float point_light_probability(const LightReceiver& at, std::size_t index) const;

    /// The direction to the brightest light that has a middle, of those whose middle is on the normal's side of p;
    /// nothing if there is none. Of clusters only the brighter member is followed, so with clusters it is approximate.
    std::optional<glm::vec3> towards_brightest(const glm::vec3& p, const glm::vec3& normal) const;

  private:
    /// How many weights there are: of infinite lights, of the roots of the tree, and of portals, in this order.
    std::size_t weight_count() const { return infinite_.size() + tree_.roots().size() + portals_.size(); }
    std::size_t first_portal() const { return infinite_.size() + tree_.roots().size(); }
    /// Fills in the weights in the choice, which are not normalised, and returns their sum.
    float weigh(const LightReceiver& at, std::span<float> weights) const;
    void move_weight_to_portals(const glm::vec3& p, std::span<float> weights) const;
    /// What a lamp or a cluster gives.
    float received_from(const LightNode& node, const LightReceiver& at) const;
    /// Towards the middle of a lamp or a cluster, as seen from p.
    glm::vec3 direction_to(const LightNode& node, const glm::vec3& p) const;
    /// What was chosen: one of the weights, and below a root a lamp.
    struct Chosen {
        std::size_t weight;
        std::optional<LightNode> lamp{};
    };
    /// Adds to a density what all lights but the chosen one propose in a direction, and calls hit(number, distance) for
    /// each area light that is met there.
    template <class Hit>
    float with_others(float density, const std::optional<Chosen>& chosen, const LightReceiver& at,
                      const glm::vec3& direction, std::span<const float> weights, float total, const Hit& hit) const;
    Emission emission_of(std::uint32_t area_light, float distance, const Wavelengths* wavelengths) const;
    glm::vec3 radiance_of_infinite(std::size_t index, const glm::vec3& direction, const Wavelengths* wavelengths) const;
    glm::vec3 infinite_radiance(const glm::vec3& direction, const Wavelengths* wavelengths) const;

    std::vector<InfiniteLight> infinite_;
    std::vector<DiffuseIrradiance> irradiance_;  ///< of each infinite light
    std::vector<AreaLight> area_;
    std::vector<AnyPointLight> points_;
    std::vector<GlowingPart> glowing_;
    LightTree tree_;  ///< of the area and point lights, and of what glows
    std::vector<Portal> portals_;
    std::vector<std::string> groups_{std::string(default_group)};
    std::vector<std::size_t> infinite_group_, area_group_, point_group_;                   ///< the group of each light
    std::vector<SharedLightSpectrum> infinite_spectrum_, area_spectrum_, point_spectrum_;  ///< of each light
    std::optional<glm::vec3> background_;
};

}  // namespace phasetree::tracer
