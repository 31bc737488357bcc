// Pictures to be written, for the tests of what writes them.
#pragma once

#include <array>
#include <random>

#include "film/image.hpp"
#include "output/write.hpp"

namespace phasetree::tracer::test {

inline const Metadata metadata{"/some/where/hourglass.json", 128, 18446744073709551615u};
inline constexpr std::array<const char*, 4> names{"a.exr", "a.png", "a.jpg", "a.tif"};

inline Image noise(int width, int height) {
    Image image{width, height, {}};
    std::mt19937 random(1);
    std::uniform_real_distribution<float> value(0.0f, 2.0f);
    for (int i = 0; i < width * height; ++i) image.pixels.emplace_back(value(random), value(random), value(random));
    return image;
}

inline Image flat(int width, int height, glm::vec3 color) {
    return {width, height, std::vector<glm::vec3>(static_cast<std::size_t>(width) * height, color)};
}

}  // namespace phasetree::tracer::test
