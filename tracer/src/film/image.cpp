#include "film/image.hpp"

#include <algorithm>
#include <cmath>

namespace phasetree::tracer {

std::size_t count_non_finite(const Image& image) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::vec3& p = image.pixels[i];
        const bool finite =
            std::isfinite(p.r) && std::isfinite(p.g) && std::isfinite(p.b) &&
            std::ranges::all_of(image.further, [&](const Channel& c) { return std::isfinite(c.values[i]); });
        count += finite ? 0 : 1;
    }
    return count;
}

}  // namespace phasetree::tracer
