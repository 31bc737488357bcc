// Colours controlled by a field of the tree: sand that is dark near water, edges that are worn. A ramp maps the field's
// value to colours or other textures. The value is a distance, negative inside the field's solid; for the field `merge`
// of an object, it is the distance to the nearest of some of its phases.
#pragma once

#include <glm/vec3.hpp>

#include "phasetree/io/kind.hpp"
#include "shading/texture/field_value.hpp"
#include "shading/texture/ramp_of_textures.hpp"
#include "shading/texture/texture_point.hpp"
#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

struct FieldTexture {
    static constexpr KindInfo info{"field",
                                   "A colour or texture that depends on a field, such as the distance to other phases: "
                                   "sand that is dark where it is wet."};

    Field of{};
    TextureRamp ramp{};
    FieldValue value{};  // set once the field is prepared

    template <class V>
    static void parameters(V&& v) {
        using P = FieldTexture;
        v(&P::of, Parameter{"of", "", "The field, or the name of a shape."});
        v(&P::ramp,
          RampParameter{{"ramp", "m",
                         "Values of the field and the colour or texture at each, with interpolation in between.",
                         limits::fraction}});
    }
    void prepare() { value = FieldValue(of); }

    glm::vec3 at(const TexturePoint& p) const { return color_at(ramp, value.at(p.position), p, nullptr); }
    glm::vec3 at(const TexturePoint& p, const Wavelengths& wavelengths) const {
        return color_at(ramp, value.at(p.position), p, &wavelengths);
    }
};

}  // namespace phasetree::tracer
