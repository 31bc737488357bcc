#pragma once

#include <vector>

#include "measuring/divide.hpp"

namespace phasetree::measuring {

/// The moments of a phase in a set of boxes: lower and upper bounds, an estimate, and the magnitudes of what was added,
/// which bound the rounding errors. Also its extent: `inner` is the extent of what it certainly contains, `outer` of
/// what it may contain. A box is *in doubt* if it is not known to be in one phase only; the *doubt* of a phase is the
/// volume that may or may not belong to it.
struct PhaseSums {
    Moments low{}, high{}, estimate{}, magnitude{};
    std::array<double, 3> inner_low, inner_high, outer_low, outer_high;
    double final_doubt = 0;  ///< the doubt in boxes whose division would not help

    PhaseSums() {
        inner_low.fill(std::numeric_limits<double>::infinity());
        outer_low = inner_low;
        inner_high.fill(-std::numeric_limits<double>::infinity());
        outer_high = inner_high;
    }
    double doubt() const { return high[0] - low[0]; }

    /// Adds a box that is entirely in the phase.
    void add(const MeasuredBox&);
    /// Adds a box in doubt. The phase contains at least `certain` and at most `possible` of it. The moments of the part
    /// in the phase are approximately `estimated`.
    void add(const MeasuredBox&, const PartOfBox& certain, const PartOfBox& possible, const Moments& estimated);
    void add(const PhaseSums&);
};

/// The sums of all phases of an object in a set of boxes.
class ObjectSums {
  public:
    explicit ObjectSums(PhaseSet phases);

    PhaseSet phases() const { return phases_; }
    const PhaseSums& operator[](Phase p) const { return sums_[index_[p.index]]; }
    /// Adds a box without dividing it further.
    void add(const ExaminedBox&, const MeasureContext&);
    void add(const ObjectSums&);
    /// The largest number of additions in which any single term has taken part.
    std::size_t additions() const { return additions_; }

  private:
    PhaseSet phases_;
    std::array<std::uint8_t, Phase::capacity> index_{};
    std::vector<PhaseSums> sums_;
    std::size_t additions_ = 0;
};

}  // namespace phasetree::measuring
