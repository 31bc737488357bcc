// The camera as a scene file says it.
#pragma once

#include <optional>
#include <string>

#include "camera/thin_lens.hpp"
#include "parameters/world_limits.hpp"
#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

std::vector<std::string_view> names_of_filters();

struct CameraParameters : ThinLensParameters {
    static constexpr KindInfo info{"camera", "A thin lens: a pinhole, if its radius is 0."};

    std::optional<glm::vec3> focus_at{};
    std::string filter_name = "blackman_harris";

    template <class V>
    static void parameters(V&& v) {
        using P = CameraParameters;
        v(&P::position, Parameter{"position", "m", "Where it is.", coordinate});
        v(&P::look_at, Parameter{"look_at", "m", "A point in the middle of the image.", coordinate});
        v(&P::up, Parameter{"up", "", "A direction that is up in the image; +y, or +x, if it looks along that.",
                            limits::any, true});
        v(&P::vertical_fov_degrees,
          Parameter{"fov", "degrees", "Angle between the upper and the lower edge of the image.",
                    Limits{.low = 0, .high = 180, .low_open = true, .high_open = true}, true});
        v(&P::lens_radius, Parameter{"lens_radius", "m", "Radius of the lens; what is out of focus blurs by it.",
                                     Limits{.low = 0, .high = farthest}, true});
        v(&P::focus_distance,
          Parameter{"focus_distance", "m", "Distance of the plane of focus; without it, the plane is at look_at.",
                    limits::positive, true});
        v(&P::focus_at,
          Parameter{"focus_at", "m", "In place of the distance: a point of the plane of focus.", coordinate, true});
        v(&P::filter_name,
          ChoiceParameter{{"filter", "", "How samples are spread about the middle of a pixel.", limits::any, true},
                          names_of_filters});
    }
    // Throws ParameterError.
    ThinLensParameters made() const;
};

}  // namespace phasetree::tracer
