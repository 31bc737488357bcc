// Counts of values that a film cannot sum as they are. A sound scene produces none, so programs that write a picture
// report them.
#pragma once

#include <cstdint>

namespace phasetree::tracer {

/// The number of sample values that were changed before they were added. The change depends only on the value, so
/// neither the sums nor these counts depend on how the work was divided.
struct FilmFaults {
    std::uint64_t not_finite = 0;  ///< NaN and infinities, which count as 0
    std::uint64_t too_large = 0;   ///< values beyond the limit of a sum (2^FixedSum::limit_exponent), clamped to it

    FilmFaults& operator+=(const FilmFaults& other) {
        not_finite += other.not_finite;
        too_large += other.too_large;
        return *this;
    }
    bool operator==(const FilmFaults&) const = default;
};

}  // namespace phasetree::tracer
