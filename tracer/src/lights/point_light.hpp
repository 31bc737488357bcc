// A point light with the same radiant intensity I in all directions.
//
// A surface that faces it at the distance d receives the irradiance E = I/d². Because it has no extent, only rays aimed
// at it find it, and no camera sees it.
#pragma once

#include <glm/glm.hpp>

#include "image/luminance.hpp"
#include "lights/check.hpp"
#include "lights/emission_bounds.hpp"
#include "parameters/world_limits.hpp"
#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

class PointLight {
  public:
    PointLight(const glm::vec3& position, const glm::vec3& intensity) : position_(position), intensity_(intensity) {
        check_point(position, "the point light's position");
        check_colour(intensity, "the point light's intensity");
    }

    /// See PointLightKind.
    const glm::vec3& position() const { return position_; }
    glm::vec3 intensity(const glm::vec3& /*away*/) const { return intensity_; }
    EmissionBounds emission_bounds() const {
        return {{position_, 0.0f}, static_cast<double>(luminance(intensity_)), {}};
    }

  private:
    glm::vec3 position_;
    glm::vec3 intensity_;
};

inline constexpr Parameter intensity_of_a_point{"intensity", "",
                                                "Radiant intensity, in the unit of radiance times m²: a surface that "
                                                "faces the light at distance d receives the irradiance intensity/d².",
                                                limits::non_negative, true};
inline constexpr ColourParameter colour_of_a_point{
    {"color", "", "Factor applied to the intensity.", limits::non_negative, true}};

// Parameters in a scene file.
struct PointLightParameters {
    static constexpr KindInfo info{"point",
                                   "A point that emits equally in all directions. It is never visible, and its light "
                                   "passes through glass or water only with \"caustics\", which use photons; without "
                                   "them, objects behind stay dark. A small sphere light has neither limitation."};

    glm::vec3 position{0.0f};
    glm::vec3 color{1.0f};
    float intensity = 1.0f;

    template <class V>
    static void parameters(V&& v) {
        using P = PointLightParameters;
        v(&P::position, Parameter{"position", "m", "Position of the light.", coordinate});
        v(&P::color, colour_of_a_point);
        v(&P::intensity, intensity_of_a_point);
    }
    PointLight made() const { return PointLight(position, color * intensity); }
};

}  // namespace phasetree::tracer
