// Two colours in alternating cubes, which show as squares on any plane parallel to two axes.
#pragma once

#include <glm/vec3.hpp>

#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

struct CheckerTexture {
    static constexpr KindInfo info{
        "checker", "Cubes of two alternating colours, which appear as squares on planes along the axes."};

    glm::vec3 even{0.8f};
    glm::vec3 odd{0.2f};
    float size = 1.0f;       // edge of a cube
    glm::vec3 origin{0.0f};  // a corner of an even cube; a checkered plane should pass between corners

    template <class V>
    static void parameters(V&& v) {
        using P = CheckerTexture;
        v(&P::even, ColourParameter{{"even", "", "Colour of the even cubes.", limits::fraction, true}});
        v(&P::odd, ColourParameter{{"odd", "", "Colour of the odd cubes.", limits::fraction, true}});
        v(&P::size, Parameter{"size", "m", "Length of the edge of a cube.", limits::positive, true});
        v(&P::origin,
          Parameter{"origin", "m", "A corner of an even cube. Axis-aligned surfaces should not pass through corners.",
                    limits::any, true});
    }

    glm::vec3 at(const glm::vec3& position) const;
};

}  // namespace phasetree::tracer
