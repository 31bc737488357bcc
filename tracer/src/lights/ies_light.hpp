// A luminaire as a point light: a photometric file describes its distribution (ies_profile.hpp), and its greatest
// radiant intensity is I.
//
// The direction that the file calls straight down points towards the target. For a luminaire that points straight down,
// the file's 0° plane is towards +x, and angles around the vertical increase anticlockwise as seen from above. For
// other directions, the luminaire is rotated from there around y first.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <utility>

#include "lights/ies_profile.hpp"
#include "lights/point_light.hpp"

namespace phasetree::tracer {

class IesLight {
  public:
    /// `turn_degrees` is a rotation around its axis, anticlockwise as seen from behind.
    IesLight(const glm::vec3& position, const glm::vec3& target, float turn_degrees,
             std::shared_ptr<const IesProfile> profile, const glm::vec3& intensity);

    /// See PointLightKind.
    const glm::vec3& position() const { return position_; }
    glm::vec3 intensity(const glm::vec3& away) const;
    /// It may emit in all directions.
    EmissionBounds emission_bounds() const {
        return {{position_, 0.0f}, static_cast<double>(luminance(intensity_)), {}};
    }

  private:
    glm::vec3 position_;
    glm::vec3 intensity_;
    glm::dvec3 down_, first_, second_;  ///< the file's straight down, and its 0° and 90° planes
    std::shared_ptr<const IesProfile> profile_;
};

// Parameters in a scene file.
struct IesLightParameters {
    static constexpr KindInfo info{
        "ies", "A point light with the angular distribution of an IES photometric file (LM-63, type C)."};

    std::filesystem::path file{};
    glm::vec3 position{0.0f};
    glm::vec3 target{0.0f};
    float turn_degrees = 0.0f;
    glm::vec3 color{1.0f};
    float intensity = 1.0f;

    template <class V>
    static void parameters(V&& v) {
        using P = IesLightParameters;
        v(&P::file, Parameter{"file", "", "Photometric file of at most 1 MiB."});
        v(&P::position, Parameter{"position", "m", "Position of the light.", coordinate});
        v(&P::target,
          Parameter{"target", "m", "Point towards which the file's downward direction points.", coordinate});
        v(&P::turn_degrees, Parameter{"turn", "degrees",
                                      "Rotation about the direction towards `target`, anticlockwise as seen from "
                                      "behind the light. At 0, the 0° plane of a light that points down faces +x.",
                                      limits::any, true});
        v(&P::color, colour_of_a_point);
        v(&P::intensity,
          Parameter{"intensity", "",
                    "Radiant intensity in the direction where the file has the most candelas; see the point light.",
                    limits::non_negative, true});
    }
    /// Checks the parameters without reading the file. Throws ParameterError.
    void check() const;
    IesLight made() const;
};

}  // namespace phasetree::tracer
