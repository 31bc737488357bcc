// Solid wood: annual rings around an axis, with fibres and pores along it.
//
// In each ring, pale early wood darkens slowly into late wood and ends sharply at the next spring. Rings differ in
// width and strength, wander along the trunk and are not quite round. Fibres are noise stretched along the axis; pores
// are short dark vessels, most of them in the early wood. Turned or carved shapes cut these structures at an angle and
// show the figure of real wood: end grain across the axis, lines and cathedral arches along it.
//
// The colours are those of bare wood. Varnish (coated_diffuse.hpp) darkens and saturates them.
//
// Reference: Ebert et al., Texturing and Modeling, 3rd ed., 2003 (Peachey's and Perlin's wood); Liu, Dong, Hašan &
// Marschner, Simulating the Structure and Texture of Solid Wood, SIGGRAPH Asia 2016 (growth rings, fibres, pores).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

struct WoodTexture {
    static constexpr KindInfo info{"wood", "Solid wood: annual rings around an axis, with fibres and pores along it."};

    glm::vec3 light{0.42f, 0.24f, 0.115f};  // early wood
    glm::vec3 dark{0.15f, 0.068f, 0.03f};   // late wood
    float ring_spacing = 0.1f;              // mean width of a ring
    glm::vec3 axis{0.0f, 0.0f, 1.0f};       // along the trunk; any length except zero
    glm::vec3 pith{0.0f};                   // a point on the trunk's axis; boards are cut next to it
    std::uint32_t seed = 0;

    template <class V>
    static void parameters(V&& v) {
        using P = WoodTexture;
        v(&P::light, ColourParameter{{"light", "", "Colour of the early wood.", limits::fraction, true}});
        v(&P::dark, ColourParameter{{"dark", "", "Colour of the late wood.", limits::fraction, true}});
        v(&P::ring_spacing, Parameter{"ring_spacing", "m", "Mean width of a ring.", limits::positive, true});
        v(&P::axis, DirectionParameter{{"axis", "", "Direction of the trunk, of any length.", limits::any, true}});
        v(&P::pith, Parameter{"pith", "m", "A point on the axis of the trunk.", limits::any, true});
        v(&P::seed, Parameter{"seed", "", "Seed of the pattern.", limits::non_negative, true});
    }

    glm::vec3 at(const glm::vec3& position) const;
};

}  // namespace phasetree::tracer
