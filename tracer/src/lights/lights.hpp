// All lights of a scene, as seen by the integrator.
//
// Light sampling has one pdf over *directions*, a mixture of those of the lights:
//     p(ω | x) = Σᵢ cᵢ(x) pᵢ(ω | x),   Σ cᵢ ≤ 1.
// A light is chosen with the probability cᵢ, and a direction from that light's pᵢ. The sample is then what is *seen*
// along that direction without occlusion by geometry: the nearest area light or, if there is none, all infinite lights
// together (sky + sun). The radiance belongs to the direction, not to the light that proposed it, and the pdf is that
// of the whole mixture. So overlapping lights (the sun's disk in front of the sky, a lamp in front of another) are
// neither counted twice nor lost, ∫ f(ω) L(ω) dω has the unbiased estimator f L/p, and MIS with BSDF samples needs one
// pair of pdfs.
//
// cᵢ(x) is proportional to the luminance of the light at x from all directions without occlusion. That is its fluence,
// the mean luminance times the solid angle (approximate for rectangles); at a surface it is the irradiance, which
// includes the cosine. The weight of an environment is multiplied by its unevenness (diffuse_irradiance.hpp), which is
// at least a tenth, unless there are portals. Unlike emitted power, this measure can compare an environment with a lamp
// without knowing the extent of the scene, and lamps that are far away, turned away or below the surface take few
// samples or none.
//
// Many lamps, which are area lights, point lights and parts of emissive surfaces and media, are grouped into clusters
// (light_tree.hpp). A lamp's cᵢ is then that of the root above it times the probability of the path to the lamp. Σ cᵢ
// may be less than 1 because a cluster is chosen by an estimate: if none of its lamps contributes, there is no sample.
//
// Area lights hide what is behind them: rectangles from their emitting side, spheres from everywhere. No other light
// hides anything.
//
// A point light is chosen by the same rule, but is not part of the pdf. Its sample has the probability of the choice
// instead, and no direction that a path samples otherwise leads to it.
//
// Emissive surfaces and media are part of the geometry, not lights of this list. Balls around them are lamps of the
// tree that propose directions but emit nothing (emissive_part.hpp). A shadow ray, whatever proposed its direction,
// collects the emission of the media on its way and of the emissive surface that it meets before it reaches the light
// that is seen there.
//
// Portals replace some of the samples of environments: a point that sees portals moves three quarters of the
// environments' weight to the portals, in proportion to their solid angles. A portal is one more pdf in the mixture and
// emits nothing.
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
#include "lights/emissive_part.hpp"
#include "lights/kinds.hpp"
#include "lights/light_receiver.hpp"
#include "lights/light_tree.hpp"
#include "lights/portal.hpp"
#include "spectrum/light_spectrum.hpp"

namespace phasetree::tracer {

/// The source of radiance in some direction: all infinite lights together, the background that camera rays see instead
/// of them, an area light or a point light (by its number in area() or points()), or an emissive surface (by the number
/// of its group in groups()).
struct InfiniteLights {};
struct Background {};
struct OfAreaLight {
    std::uint32_t index;
};
struct OfPointLight {
    std::uint32_t index;
};
struct OfEmissiveSurface {
    std::uint32_t group;
};
using LightSource = std::variant<InfiniteLights, Background, OfAreaLight, OfPointLight, OfEmissiveSurface>;

struct LightSample {
    glm::vec3 wi;        ///< unit length, from the point towards the light
    float distance;      ///< to the light; infinity for infinite lights
    glm::vec3 radiance;  ///< radiance that arrives from there without occlusion by geometry
    float pdf;           ///< per steradian, of the whole mixture; for a point light, the probability of choosing it
    LightSource source;  ///< the light that the radiance comes from

    /// Whether the sample is of a point light. Then `radiance` is its irradiance on a surface that faces it, and no
    /// direction that is sampled otherwise leads to it.
    bool is_of_point_light() const { return std::holds_alternative<OfPointLight>(source); }
};

inline constexpr std::string_view default_group = "default";

/// A light of the list.
template <class Light>
struct ListedLight {
    Light light;
    std::size_t group;               ///< its number in Lights::groups()
    SharedLightSpectrum spectrum{};  ///< null for a light that has only a colour
};

struct ListedInfiniteLight : ListedLight<InfiniteLight> {
    DiffuseIrradiance irradiance;
};

class Lights {
  public:
    struct Emission {
        float distance;  ///< infinity for infinite lights
        glm::vec3 radiance;
        LightSource source;

        bool is_of_point_light() const { return std::holds_alternative<OfPointLight>(source); }
    };

    /// Lights belong to groups, whose shares of a picture can be recorded separately (add_to_groups). The background,
    /// and lights without a group, belong to `default_group`. If a spectrum is given, it determines the colour of the
    /// light, with the same brightness.
    void add(InfiniteLight light, std::string_view group = default_group, SharedLightSpectrum spectrum = {});
    void add(AreaLight light, std::string_view group = default_group, SharedLightSpectrum spectrum = {});
    void add(AnyPointLight light, std::string_view group = default_group, SharedLightSpectrum spectrum = {});
    void add(const EmissivePart& part);
    /// A portal has no group because it emits nothing.
    void add(const Portal& portal) { portals_.push_back(portal); }
    /// Clusters the lamps if there are more than LightTree::most_roots. Call it after adding all lights. Adding another
    /// lamp dissolves the clusters; each sample then evaluates all lamps.
    void cluster_lamps();
    /// Sets what camera rays see instead of the infinite lights.
    void set_background(const std::optional<glm::vec3>& radiance);
    /// Whether camera rays that meet nothing see no light.
    bool is_background_black() const { return background_ ? *background_ == glm::vec3(0.0f) : infinite_.empty(); }

    /// Returns the number of a group in groups(), and adds the group if the name is new.
    std::size_t group_of(std::string_view name);
    /// The names of the groups, default_group first.
    const std::vector<std::string>& groups() const { return groups_; }
    /// Converts light that a path found in `direction` to a colour and adds it to the group of its light. `found` is in
    /// wavelengths, or in red, green and blue. Light from infinite lights of several groups is split in proportion to
    /// their radiances in that direction; up to rounding, the shares add up to the colour of the whole. `groups` is as
    /// long as groups().
    void add_to_groups(const glm::vec3& found, const Wavelengths* wavelengths, const LightSource& source,
                       const glm::vec3& direction, std::span<glm::vec3> groups) const;

    /// Whether there are no lights; emissive parts do not count.
    bool empty() const { return infinite_.empty() && area_.empty() && points_.empty(); }
    /// The spectra of all lights; null for one without.
    std::vector<SharedLightSpectrum> spectra() const;
    std::span<const ListedInfiniteLight> infinite() const { return infinite_; }
    std::span<const ListedLight<AreaLight>> area() const { return area_; }
    std::span<const ListedLight<AnyPointLight>> points() const { return points_; }
    std::span<const EmissivePart> emissive_parts() const { return emissive_parts_; }

    /// Samples a direction; `u` is in [0, 1)². u.x chooses the light. Its remainder, rescaled to [0, 1), is the x of
    /// the light's own sampling, so that points stratified in the square are stratified for each light. Returns nullopt
    /// if no light reaches the point, if the chosen cluster contributes nothing there, or if rounding misses the light.
    /// As in all functions below, the radiance is that at the wavelengths, if given.
    std::optional<LightSample> sample(const LightReceiver& at, glm::vec2 u,
                                      const Wavelengths* wavelengths = nullptr) const;

    /// What a ray sees that meets geometry at that distance, or infinity: the nearest area light in front of the
    /// geometry or, if the ray meets nothing, the infinite lights. Camera rays pass through lights that are not visible
    /// to the camera.
    std::optional<Emission> seen(const glm::vec3& origin, const glm::vec3& direction, float geometry, bool camera_ray,
                                 const Wavelengths* wavelengths = nullptr) const;

    /// Calls use(number) for each lamp of one kind, area lights or emissive parts, that a ray may meet before a
    /// distance, and for some others. The direction has unit length. Without clusters, visits all lamps of the kind, in
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

    /// The luminance of the brightest ball around an emissive part that a ray meets: an estimate of the radiance
    /// without occlusion. 0 if it meets none.
    float emissive_luminance(const glm::vec3& origin, const glm::vec3& direction) const;

    /// The radiant intensity of a point light, by its number in points(), in a direction away from it.
    glm::vec3 intensity(std::size_t index, const glm::vec3& away, const Wavelengths* wavelengths = nullptr) const;

    /// The distance at which light that travels from an origin in a unit direction is stopped by an area light, which
    /// hides the origin from the other side. nullopt if there is none before the distance `far`. The light `own` is
    /// ignored because the light starts there.
    std::optional<float> area_light_in_the_way(const glm::vec3& origin, const glm::vec3& direction, float far,
                                               const LightSource& own) const;

    /// The pdf of sample() per steradian.
    float pdf(const LightReceiver& at, const glm::vec3& direction) const;

    /// The probability with which sample() chooses this point light, by its number in points().
    float point_light_probability(const LightReceiver& at, std::size_t index) const;

    /// The direction to the brightest light that has a centre, among those whose centre is on the normal's side of p;
    /// nullopt if there is none. Approximate with clusters, because only the brighter member of each is followed.
    std::optional<glm::vec3> towards_brightest(const glm::vec3& p, const glm::vec3& normal) const;

  private:
    /// The number of weights: of infinite lights, of the roots of the tree, and of portals, in this order.
    std::size_t weight_count() const { return infinite_.size() + tree_.roots().size() + portals_.size(); }
    std::size_t first_portal() const { return infinite_.size() + tree_.roots().size(); }
    /// Computes the weights of the choice, which are not normalised, and returns their sum.
    float weigh(const LightReceiver& at, std::span<float> weights) const;
    void move_weight_to_portals(const glm::vec3& p, std::span<float> weights) const;
    /// The light of a lamp or a cluster at the receiver.
    float received_from(const LightNode& node, const LightReceiver& at) const;
    /// The direction from p to the centre of a lamp or a cluster.
    glm::vec3 direction_to(const LightNode& node, const glm::vec3& p) const;
    /// The result of a choice: one of the weights and, below a root, a lamp.
    struct Chosen {
        std::size_t weight;
        std::optional<LightNode> lamp{};
    };
    /// Adds the pdfs of all lights except the chosen one in a direction to `density`, and calls hit(number, distance)
    /// for each area light that the direction meets.
    template <class Hit>
    float with_others(float density, const std::optional<Chosen>& chosen, const LightReceiver& at,
                      const glm::vec3& direction, std::span<const float> weights, float total, const Hit& hit) const;
    Emission emission_of(std::uint32_t area_light, float distance, const Wavelengths* wavelengths) const;
    glm::vec3 infinite_radiance(const glm::vec3& direction, const Wavelengths* wavelengths) const;

    std::vector<ListedInfiniteLight> infinite_;
    std::vector<ListedLight<AreaLight>> area_;
    std::vector<ListedLight<AnyPointLight>> points_;
    std::vector<EmissivePart> emissive_parts_;
    LightTree tree_;  ///< of the area and point lights, and of emissive parts
    std::vector<Portal> portals_;
    std::vector<std::string> groups_{std::string(default_group)};
    std::optional<glm::vec3> background_;
};

}  // namespace phasetree::tracer
