// Many equal balls that shine, such as a string of fairy lights: sphere lights (sphere_light.hpp) in one entry of a
// scene file.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "lights/kinds.hpp"
#include "parameters/point_list.hpp"

namespace phasetree::tracer {

struct SphereLightsParameters {
    static constexpr KindInfo info{"spheres", "Many equal balls that shine. Each is a sphere light."};

    std::vector<glm::vec3> centres{};
    float radius = 1.0f;
    glm::vec3 radiance{1.0f};
    float intensity = 1.0f;
    bool visible_to_camera = true;

    template <class V>
    static void parameters(V&& v) {
        using P = SphereLightsParameters;
        v(&P::centres, Parameter{"centres", "m", "Their centres.", coordinate});
        v(&P::radius, Parameter{"radius", "m", "The radius of each.", extent});
        v(&P::radiance, ColourParameter{{"radiance", "", "Radiance of their surface.", limits::non_negative, true}});
        v(&P::intensity, Parameter{"intensity", "", "A factor of the radiance.", limits::non_negative, true});
        v(&P::visible_to_camera,
          Parameter{"visible_to_camera", "", "Whether the camera sees them by themselves.", limits::any, true});
    }
    std::vector<AreaLight> made() const {
        std::vector<AreaLight> lights;
        lights.reserve(centres.size());
        for (const glm::vec3& centre : centres)
            lights.emplace_back(SphereLight(centre, radius, radiance * intensity, visible_to_camera));
        return lights;
    }
};

}  // namespace phasetree::tracer
