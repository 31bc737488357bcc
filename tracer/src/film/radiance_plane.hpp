// The picture: the mean radiance of a pixel's samples. It is summed in double precision, in which millions of samples
// lose nothing that a float has.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <string_view>

#include "film/contract.hpp"

namespace phasetree::tracer {

struct RadiancePlane {
    using Sum = glm::dvec3;
    static constexpr std::array<std::string_view, 3> channels{"R", "G", "B"};

    static void add(Sum& sum, const FilmSample& sample) { sum += glm::dvec3(sample.radiance); }
    static std::array<float, 3> resolve(const Sum& sum, int samples) {
        const glm::vec3 mean(sum / static_cast<double>(samples));
        return {mean.r, mean.g, mean.b};
    }
};

}  // namespace phasetree::tracer
