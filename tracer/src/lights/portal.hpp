// A rectangle through which infinite lights enter, such as a window: directions are sampled through it instead of over
// the whole sphere. It emits and hides nothing; it only changes the noise of a picture.
//
// From a point on its inner side, directions are uniform in the solid angle that it subtends (rectangle_light.hpp),
// with exactly that pdf. From its other side it does not exist.
//
// Reference: Bitterli, Novák & Jarosz, Portal-Masked Environment Map Sampling, EGSR 2015. This is the simple form,
// without the image's own distribution.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "lights/rectangle_light.hpp"

namespace phasetree::tracer {

class Portal {
  public:
    /// The rectangle's emitting side is the inner one.
    explicit Portal(const RectangleLight& opening) : opening_(opening) {}

    /// Approximate, in steradians; 0 where the portal does not exist.
    double approximate_solid_angle(const glm::vec3& p) const { return opening_.approximate_solid_angle(p); }
    /// A direction through it; called only where the solid angle is not 0.
    DirectionSample sample(const glm::vec3& p, const glm::vec2& u) const { return opening_.sample(p, u); }
    /// The pdf of sample(); 0 for a direction that does not lead through it.
    float pdf(const glm::vec3& p, const glm::vec3& direction) const {
        const std::optional<float> distance = opening_.intersect(p, direction);
        return distance ? opening_.pdf_at(p, direction, *distance) : 0.0f;
    }

  private:
    RectangleLight opening_;
};

// Parameters in a scene file.
struct PortalParameters {
    static constexpr KindInfo info{"portal",
                                   "An opening, such as a window of a room, through which lights at infinity are "
                                   "sampled. It reduces noise and emits no light."};

    glm::vec3 centre{0.0f};
    glm::vec3 target{0.0f};
    float width = 1.0f;
    float height = 1.0f;

    template <class V>
    static void parameters(V&& v) {
        using P = PortalParameters;
        v(&P::centre, Parameter{"centre", "m", "Its centre.", coordinate});
        v(&P::target,
          Parameter{"target", "m", "A point inside the room, straight in front of the portal.", coordinate});
        v(&P::width,
          Parameter{"width", "m", "Length of the horizontal edge; along x if the portal faces up or down.", extent});
        v(&P::height, Parameter{"height", "m", "Length of the other edge.", extent});
    }
    Portal made() const {
        if (!(glm::length(target - centre) > 0))
            throw ParameterError("target", "\"target\" must differ from the portal's centre");
        return Portal(RectangleLight::facing(centre, target, width, height, glm::vec3(0.0f), false));
    }
};

}  // namespace phasetree::tracer
