#include "objects/outer.hpp"

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/difference.hpp"
#include "phasetree/nodes/fields/merge.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"

namespace phasetree::bench {

Phased outer(const Phased& object) {
    // The merged vacuum is without end; a box about the object makes what is left of it bounded.
    const Bounds box = bounds(object);
    const Field about = warped(Translate{box.centre()}, Field(Box{box.extent() * 1.01f + 0.01f * box.diagonal()}));
    return Set{Phase{1}, Difference{.from = about, .subtract = {Merge{object, PhaseSet::of(vacuum)}}}};
}

}  // namespace phasetree::bench
