// Many equal emissive balls, such as a string of fairy lights: sphere lights (sphere_light.hpp) in one entry of a scene
// file.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "lights/kinds.hpp"
#include "parameters/point_list.hpp"

namespace phasetree::tracer {

struct SphereLightsParameters : SphereEmissionParameters {
    static constexpr KindInfo info{"spheres", "Many equal sphere lights."};

    std::vector<glm::vec3> centres{};

    template <class V>
    static void parameters(V&& v) {
        v(&SphereLightsParameters::centres, Parameter{"centres", "m", "Centres of the spheres.", coordinate});
        SphereEmissionParameters::parameters(v);
    }
    std::vector<AreaLight> made() const {
        std::vector<AreaLight> lights;
        lights.reserve(centres.size());
        for (const glm::vec3& centre : centres) lights.emplace_back(made_at(centre));
        return lights;
    }
};

}  // namespace phasetree::tracer
