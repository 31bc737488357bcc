// A range of sample numbers of a pixel.
#pragma once

namespace phasetree::tracer {

/// Samples [first, last).
struct SampleRange {
    int first = 0, last = 0;

    int size() const { return last - first; }
    bool operator==(const SampleRange&) const = default;
};

}  // namespace phasetree::tracer
