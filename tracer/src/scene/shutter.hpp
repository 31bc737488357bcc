// When the shutter is open, and at which moments meanwhile the scene file is read.
#pragma once

#include <vector>

#include "phasetree/io/document.hpp"

namespace phasetree::tracer {

/// In seconds, from the document's time.
struct Shutter {
    double open = 0, close = 0;

    bool is_instant() const { return open == close; }
};

/// Moments at which what changes is read, as shares of the time in which the shutter is open: equally far apart, and
/// those of the value's own keys. Between them it is interpolated. None if the value has no keys, or the shutter is
/// open for no time. Throws SceneError if that would be too much work.
std::vector<double> moments_of(const Document&, Value, const Shutter&);
/// The document at such a moment.
Document at_moment(const Document&, const Shutter&, double moment);

}  // namespace phasetree::tracer
