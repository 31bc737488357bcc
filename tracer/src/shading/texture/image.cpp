#include "shading/texture/image.hpp"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>

namespace phasetree::tracer {

glm::vec3 ImageTexture::at(const TexturePoint& point) const {
    const glm::vec3 p = (point.position - origin) / size;
    const glm::vec3 n(std::abs(point.normal.x), std::abs(point.normal.y), std::abs(point.normal.z));
    const float least = (1.0f - blend) * std::max({n.x, n.y, n.z});
    glm::vec3 sum(0.0f);
    float weights = 0.0f;
    const auto add = [&](float cosine, const glm::vec2& uv) {
        // At blend 0, the greatest of the three still has a weight.
        const float weight = std::max(cosine - least, 0.0f) + (cosine >= std::max({n.x, n.y, n.z}) ? 1e-6f : 0.0f);
        if (!(weight > 0.0f)) return;
        sum += weight * image->at({uv.x, uv.y * image->aspect()});
        weights += weight;
    };
    add(n.x, {p.y, p.z});
    add(n.y, {p.x, p.z});
    add(n.z, {p.x, p.y});
    return weights > 0.0f ? sum / weights : image->at({0.0f, 0.0f});
}

}  // namespace phasetree::tracer
