// Convex bounds of trees.

#include "phasetree/carving/carve.hpp"

#include <algorithm>

#include "api/tree_data.hpp"
#include "phasetree/building/options.hpp"
#include "phasetree/math/float_mode.hpp"

namespace phasetree::embree::api {

namespace {

CarveOptions checked(const PhasetreeCarveOptions* given) {
    PhasetreeCarveOptions o;
    phasetreeInitCarveOptions(&o);
    if (given) o = *given;
    if (o.maxPlanes < 6 || o.maxPlanes > PHASETREE_MAX_PLANES)
        throw invalid("options->maxPlanes is {}; it must be 6 … {}", o.maxPlanes, PHASETREE_MAX_PLANES);
    if (!(o.tolerance > 0 && o.tolerance <= 1))
        throw invalid("options->tolerance is {}; it must be more than 0 and at most 1", o.tolerance);
    CarveOptions options;
    options.max_planes = static_cast<int>(o.maxPlanes);
    options.tolerance = static_cast<double>(o.tolerance);
    options.max_evaluations = o.maxEvaluations;
    if (o.cancelled) options.cancelled = [o] { return o.cancelled(o.cancelledUserPtr); };
    return options;
}

// Rounds outward, by more than rounding the normal can move the plane within the box.
PhasetreePlane rounded(const HalfSpace& plane, const Bounds& box) {
    double farthest = std::abs(plane.offset);
    for (int i = 0; i < 8; ++i) farthest = std::max(farthest, glm::length(glm::dvec3(box.corner(i))));
    const glm::vec3 n(plane.normal);
    return {{n.x, n.y, n.z}, static_cast<float>(plane.offset + 4e-7 * farthest)};
}

CarvedBounds carved(const Phased& object, PhaseSet of, const CarveOptions& options) {
    try {
        return carve(object, of, options);
    } catch (const CarvingCancelled&) {
        throw BuildCancelled();  // all cancellations raise the same error
    }
}

}  // namespace

}  // namespace phasetree::embree::api

using namespace phasetree;
using namespace phasetree::embree::api;

PhasetreeError phasetreeCarveTree(PhasetreeTree tree, PhasetreePhaseSet phase_bits,
                                  const PhasetreeCarveOptions* options, PhasetreePlane* planes,
                                  unsigned int* plane_count, PhasetreeCarvedBounds* bounds) {
    return guarded_call(__func__, [&] {
        const TreeData& data = data_of(tree);
        const CarveOptions with = checked(options);
        if (planes) require(plane_count, "planeCount");
        const PhaseSet of{phases(data.tree.object).bits & phase_bits & ~std::uint64_t{1}};
        if (of.empty()) throw invalid("the tree contains none of the phases");
        const FlushSubnormals flush;
        const CarvedBounds c = carved(data.tree.object, of, with);
        if (planes) {
            std::transform(c.planes.begin(), c.planes.end(), planes,
                           [&](const HalfSpace& plane) { return rounded(plane, c.box); });
        }
        if (plane_count) *plane_count = static_cast<unsigned>(c.planes.size());
        if (bounds) {
            const auto &low = c.box.low, &high = c.box.high;
            *bounds = {RTCBounds{low.x, low.y, low.z, 0, high.x, high.y, high.z, 0}, static_cast<float>(c.volume),
                       static_cast<float>(c.area), c.evaluations, c.is_within_tolerance};
        }
    });
}
