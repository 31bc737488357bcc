#include "objects/cluster.hpp"

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/rounded_box.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/over.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "rays/random.hpp"

namespace phasetree::bench {

Phased cluster(int phases) {
    constexpr int parts = 96;  // a multiple of 32: every phase has at least three
    Random random(20);
    std::vector<Union> shapes(static_cast<std::size_t>(phases));
    for (int i = 0; i < parts; ++i) {
        const glm::vec3 at = random.direction() * std::cbrt(random.next());
        const float size = 0.12f + 0.14f * random.next(), angle = 360 * random.next();
        const glm::vec3 axis = random.direction();
        const Field shape = i % 2 == 0 ? Field(Sphere{size})
                                       : warped(Rotate{.axis = axis, .angle = angle},
                                                Field(RoundedBox{glm::vec3(1.6f, 2, 1.2f) * size, 0.2f * size}));
        shapes[static_cast<std::size_t>(i % phases)].of.push_back(warped(Translate{at}, shape));
    }
    Over all;
    for (std::size_t k = 0; k < shapes.size(); ++k)
        all.of.push_back(Set{Phase{static_cast<std::uint8_t>(k + 1)}, Field(std::move(shapes[k]))});
    return all;
}

}  // namespace phasetree::bench
