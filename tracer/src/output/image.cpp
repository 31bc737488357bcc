#include "output/image.hpp"

#include <algorithm>
#include <cmath>

namespace phasetree::tracer {

std::size_t count_non_finite(const Image& image) {
    const auto broken = [](const glm::vec3& p) {
        return !(std::isfinite(p.r) && std::isfinite(p.g) && std::isfinite(p.b));
    };
    return static_cast<std::size_t>(std::count_if(image.pixels.begin(), image.pixels.end(), broken));
}

}  // namespace phasetree::tracer
