// The numbers of some of a pixel's samples.
#pragma once

namespace phasetree::tracer {

/// Samples [first, last).
struct SampleRange {
    int first = 0, last = 0;

    int size() const { return last - first; }
    bool operator==(const SampleRange&) const = default;
};

}  // namespace phasetree::tracer
