#pragma once

#include <cstddef>
#include <functional>

#include "phasetree/measuring/node_effects.hpp"
#include "phasetree/trace/tracer.hpp"

namespace phasetree::measuring {

struct SameLabels {
    Verdict verdict = Verdict::undecided;
    std::optional<LabelChange> change{};  ///< if it is refuted; `with` is the label of the first object
};

/// Whether two objects have the same label at every point. `traceable` is that of the first object. At most this many
/// boxes are examined; `is_stopped` is polled.
SameLabels same_labels(const Phased& first, const Phased& second, const TraceableObject& traceable,
                       std::size_t max_boxes, const std::function<bool()>& is_stopped);

}  // namespace phasetree::measuring
