// A base colour crossed by veins: thin sheets where a warped noise passes through zero, between broad clouds that mix
// the two colours.
//
// Reference: Ebert, Musgrave, Peachey, Perlin & Worley, Texturing and Modeling, 3rd ed., 2003 (marble by turbulence).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

struct MarbleTexture {
    static constexpr KindInfo info{"marble", "A ground colour crossed by veins."};

    glm::vec3 color{0.82f, 0.80f, 0.77f};
    glm::vec3 vein{0.20f, 0.21f, 0.24f};
    float scale = 1.0f;  // distance between veins
    std::uint32_t seed = 0;

    template <class V>
    static void parameters(V&& v) {
        using P = MarbleTexture;
        v(&P::color, ColourParameter{{"color", "", "Colour of the ground.", limits::fraction, true}});
        v(&P::vein, ColourParameter{{"vein", "", "Colour of the veins.", limits::fraction, true}});
        v(&P::scale, Parameter{"scale", "m", "Mean distance between veins.", limits::positive, true});
        v(&P::seed, Parameter{"seed", "", "Seed of the pattern.", limits::non_negative, true});
    }

    glm::vec3 at(const glm::vec3& position) const;
};

}  // namespace phasetree::tracer
