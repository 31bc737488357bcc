// Grains, such as sand: cells of cellular noise, each with its own colour and brightness, and darker gaps between them.
// Some grains are of a dark mineral and some are nearly white.
//
// Reference: Worley, A Cellular Texture Basis Function, SIGGRAPH 1996.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

struct SpeckleTexture {
    static constexpr KindInfo info{"speckle", "Grains, as of sand, each with its own colour and brightness."};

    glm::vec3 color{0.58f, 0.42f, 0.24f};
    glm::vec3 other{0.70f, 0.57f, 0.39f};  // grains mix the two colours
    float grain = 0.01f;                   // mean distance between grains
    float contrast = 0.5f;                 // 0: all grains are equal; 1: very mixed
    std::uint32_t seed = 0;

    template <class V>
    static void parameters(V&& v) {
        using P = SpeckleTexture;
        v(&P::color, ColourParameter{{"color", "", "One colour of the grains.", limits::fraction, true}});
        v(&P::other,
          ColourParameter{{"other", "", "The other colour; each grain is a mixture of both.", limits::fraction, true}});
        v(&P::grain, Parameter{"grain", "m", "Mean distance between grains.", limits::positive, true});
        v(&P::contrast,
          Parameter{"contrast", "", "Variation of the grains, from none at 0 to strong at 1.", limits::fraction, true});
        v(&P::seed, Parameter{"seed", "", "Seed of the pattern.", limits::non_negative, true});
    }

    glm::vec3 at(const glm::vec3& position) const;
};

}  // namespace phasetree::tracer
