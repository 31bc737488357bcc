// Chooses the resolution at which an object can be traced. A coordinate has an error of half a unit in the last place,
// at most 6·10⁻⁸ of the largest coordinate. A field's value has an error of a few such units of the coordinates on
// which it depends.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "phasetree/trace/tracer.hpp"
#include "phasetree/tree/unbounded.hpp"

namespace phasetree {

namespace {

// The finest resolution, as a fraction of the farthest coordinate or of the diagonal, whichever is larger: two to four
// units in the last place. At finer ones, there are no floats to sample.
constexpr float finest = 2.5e-7f;
// The chosen resolution, as fractions of the farthest coordinate and of the diagonal; the larger product is used. At
// this resolution, the rounding errors of values are invisible.
constexpr float of_farthest = 1e-6f, of_diagonal = 2e-6f;
// The coarsest resolution, as a fraction of the diagonal. A coarser one would miss much of the object.
constexpr float coarsest = 0.01f;
// Warn if the resolution that floats force on an object is coarser than this fraction of the diagonal. This happens
// only far from the origin.
constexpr float poor = 1e-3f;

}  // namespace

TraceableObject prepare_to_trace(const Phased& object, float wanted) {
    const Bounds b = phasetree::bounds(object);
    if (b.empty()) throw ModelError("the object is empty");
    if (!b.finite()) throw UnboundedError(unbounded_parts(object));
    const float farthest = std::max({std::abs(b.low.x), std::abs(b.low.y), std::abs(b.low.z), std::abs(b.high.x),
                                     std::abs(b.high.y), std::abs(b.high.z)});
    const float size = b.diagonal();
    if (!(farthest < 1e15f) || !(size > 1e-15f))
        throw ModelError("the object's size or position is beyond what 32-bit floats can trace (10⁻¹⁵ to 10¹⁵)");
    const float least = finest * std::max(farthest, size), most = std::max(coarsest * size, least);
    if (least > size / 8)
        throw ModelError(
            fmt::format("the object has size {:.3g} and extends up to {:.3g} from the origin, where 32-bit coordinates "
                        "are up to {:.2g} apart; move it to the origin",
                        size, farthest, 0.5f * least));
    const float chosen = wanted > 0 ? wanted : std::max(of_diagonal * size, of_farthest * farthest);
    TraceableObject result;
    result.resolution = std::clamp(chosen, least, most);
    result.bounds = b.inflated(8 * result.resolution);
    if (wanted > 0 && result.resolution != wanted)
        result.warning = fmt::format(
            "the resolution {:.3g} is {} an object of size {:.3g} that extends up to {:.3g} from the origin; {:.3g} is "
            "used instead",
            wanted, wanted < least ? "finer than 32-bit coordinates allow for" : "too coarse for", size, farthest,
            result.resolution);
    else if (wanted > 0 ? least > poor * size : chosen > poor * size)
        result.warning = fmt::format(
            "the object has size {:.3g} and extends up to {:.3g} from the origin, where 32-bit coordinates are coarse; "
            "details smaller than {:.2g} may be missed; move it closer to the origin",
            size, farthest, result.resolution);
    return result;
}

}  // namespace phasetree
