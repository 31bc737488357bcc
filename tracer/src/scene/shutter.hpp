// The time in which the shutter is open, and the moments at which the scene file is read for it.
#pragma once

#include <vector>

#include "phasetree/io/document.hpp"

namespace phasetree::tracer {

/// In seconds, relative to the document's time.
struct Shutter {
    double open = 0, close = 0;

    bool is_instant() const { return open == close; }
};

/// The moments at which a changing value is read, as fractions of the time in which the shutter is open: equally spaced
/// ones, and those of the value's own keys. Between them the value is interpolated. Empty if the value has no keys, or
/// if the shutter opens only for an instant. Throws SceneError if reading would take too long.
std::vector<double> moments_of(const Document&, Value, const Shutter&);
/// The document at such a moment.
Document at_moment(const Document&, const Shutter&, double moment);

}  // namespace phasetree::tracer
