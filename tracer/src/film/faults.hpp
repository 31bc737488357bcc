// Values that a film cannot sum as they are. None comes of a sound scene, so whoever writes a picture tells of them.
#pragma once

#include <cstdint>

namespace phasetree::tracer {

/// How many values of samples were changed before they were added. What they are changed to depends on the value alone,
/// so neither the sums nor these numbers depend on how the work was divided.
struct FilmFaults {
    std::uint64_t not_finite = 0;  ///< NaN and the infinities, which count as 0
    std::uint64_t too_large = 0;   ///< beyond what a sum takes of one sample (FixedSum::limit), cut to just that

    FilmFaults& operator+=(const FilmFaults& other) {
        not_finite += other.not_finite;
        too_large += other.too_large;
        return *this;
    }
    bool operator==(const FilmFaults&) const = default;
};

}  // namespace phasetree::tracer
