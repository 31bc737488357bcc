#include "objects/packing.hpp"

#include <cmath>

#include "rays/random.hpp"

namespace phasetree::bench {

BallList packing(std::size_t balls) {
    const int side = static_cast<int>(std::lround(std::cbrt(static_cast<double>(balls))));
    const float spacing = 1 / static_cast<float>(side);
    Random random(39);
    BallList list;
    for (int z = 0; z < side; ++z)
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                // In braces, the numbers are drawn in this order by every compiler.
                const glm::vec3 moved{random.next(), random.next(), random.next()};
                list.centres.push_back(spacing * (glm::vec3(x, y, z) + 0.3f + 0.4f * moved));
                list.radii.push_back(spacing * (0.3f + 0.2f * random.next()));
                list.phases.push_back(static_cast<std::uint8_t>(4 * random.next()));
            }
    return list;
}

}  // namespace phasetree::bench
