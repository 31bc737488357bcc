#include "shading/texture/speckle.hpp"

#include <algorithm>
#include <glm/common.hpp>

#include "sampling/hash.hpp"
#include "shading/texture/noise.hpp"

namespace phasetree::tracer {

glm::vec3 SpeckleTexture::at(const glm::vec3& position) const {
    const glm::vec3 p = position / grain;
    const Cell cell = cellular_noise(p, seed);
    const float which = hash_to_unit(hash(cell.id, 11u));
    const float brightness = hash_to_unit(hash(cell.id, 12u));
    const float mineral = hash_to_unit(hash(cell.id, 13u));

    glm::vec3 result = glm::mix(color, other, which) * (1.0f + contrast * (0.9f * brightness - 0.45f));
    if (mineral < 0.06f) {
        result *= 1.0f - 0.75f * contrast;  // dark minerals
    } else if (mineral > 0.92f) {
        result = glm::mix(result, glm::vec3{0.85f, 0.83f, 0.78f}, 0.6f * contrast);  // clear quartz
    }
    // Gaps between grains are dark.
    result *= glm::mix(1.0f, glm::smoothstep(0.0f, 0.22f, cell.next - cell.nearest), 0.7f * contrast);
    // Broad, faint variations of tone, like those of sand.
    result *= 1.0f + 0.12f * contrast * fractal_noise(0.06f * p, 3, hash(seed, 14u));
    return glm::clamp(result, 0.0f, 1.0f);
}

}  // namespace phasetree::tracer
