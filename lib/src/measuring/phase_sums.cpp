#include "measuring/phase_sums.hpp"

#include <algorithm>
#include <cmath>

namespace phasetree::measuring {

namespace {

using Triple = std::array<double, 3>;

// The range of a product of two numbers from intervals, or of a square if both are the same number.
std::pair<double, double> range_of_product(double a_low, double a_high, double b_low, double b_high, bool is_square) {
    const double p = a_low * b_low, q = a_low * b_high, r = a_high * b_low, s = a_high * b_high;
    if (is_square) return {a_low <= 0 && a_high >= 0 ? 0 : std::min(p, s), std::max(p, s)};
    return {std::min({p, q, r, s}), std::max({p, q, r, s})};
}

// The range of the integrand of each moment between two corners.
template <class F>
void for_each_integrand(const Triple& low, const Triple& high, F&& f) {
    f(std::size_t{0}, 1.0, 1.0);
    for (std::size_t i = 0; i < 3; ++i) {
        f(1 + i, low[i], high[i]);
        for (std::size_t j = i; j < 3; ++j) {
            const auto [least, most] = range_of_product(low[i], high[i], low[j], high[j], i == j);
            f(product_index(i, j), least, most);
        }
    }
}

void add_to(Moments& sum, const Moments& m) {
    for (std::size_t k = 0; k < m.size(); ++k) sum[k] += m[k];
}

void extend(Triple& low, Triple& high, const Triple& to_low, const Triple& to_high) {
    for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], to_low[i]);
        high[i] = std::max(high[i], to_high[i]);
    }
}

Triple high_of(const MeasuredBox& box) {
    return {box.high(0), box.high(1), box.high(2)};
}

// The magnitudes of the moments of a box.
void add_magnitudes(Moments& sum, const MeasuredBox& box) {
    const double volume = box.volume();
    for_each_integrand(box.low, high_of(box), [&](std::size_t k, double least, double most) {
        sum[k] += volume * std::max(std::abs(least), std::abs(most));
    });
}

Moments scaled(const Moments& m, double factor) {
    Moments result;
    for (std::size_t k = 0; k < m.size(); ++k) result[k] = factor * m[k];
    return result;
}

// Estimates the moments of a phase in a box in doubt. If the box has two phases and a linear function is known, this is
// the part in which the function is negative, after it has been shifted by at most the slack, so that its mean in the
// box is that of the component. Otherwise it is the fraction of the box's moments that its sampled points suggest.
Moments estimate_in(const ExaminedBox& box, std::size_t k, const MeasuredBox& measured) {
    const PhaseInBox& p = box.phases[k];
    if (box.phases.size() != 2 || !(p.slack < std::numeric_limits<double>::infinity()))
        return scaled(measured.moments(), box.votes[k] / static_cast<double>(batch_size));
    const LinearInBox& f = p.component;
    const double at_centre = f.at_low + 0.5 * (f.change[0] + f.change[1] + f.change[2]);
    const double move = std::clamp(box.mean_component[k] - at_centre, -p.slack, p.slack);
    return part_below(f.plus(move), measured).moments;
}

}  // namespace

void PhaseSums::add(const MeasuredBox& box) {
    const Moments all = box.moments();
    add_to(low, all);
    add_to(high, all);
    add_to(estimate, all);
    add_magnitudes(magnitude, box);
    extend(inner_low, inner_high, box.low, high_of(box));
    extend(outer_low, outer_high, box.low, high_of(box));
}

void PhaseSums::add(const MeasuredBox& box, const PartOfBox& certain, const PartOfBox& possible,
                    const Moments& estimated) {
    const double doubt = std::max(0.0, possible.moments[0] - certain.moments[0]);
    // The rest of the phase lies between the two parts, so its volume is between 0 and their difference.
    for_each_integrand(possible.low, possible.high, [&](std::size_t k, double least, double most) {
        const bool is_volume = k == 0;
        low[k] += certain.moments[k] + (is_volume || doubt == 0 ? 0 : doubt * std::min(0.0, least));
        high[k] += certain.moments[k] + (doubt == 0 ? 0 : doubt * std::max(0.0, most));
    });
    add_to(estimate, estimated);
    add_magnitudes(magnitude, box);
    extend(inner_low, inner_high, certain.low, certain.high);
    extend(outer_low, outer_high, possible.low, possible.high);
}

void PhaseSums::add(const PhaseSums& o) {
    add_to(low, o.low);
    add_to(high, o.high);
    add_to(estimate, o.estimate);
    add_to(magnitude, o.magnitude);
    extend(inner_low, inner_high, o.inner_low, o.inner_high);
    extend(outer_low, outer_high, o.outer_low, o.outer_high);
    final_doubt += o.final_doubt;
}

ObjectSums::ObjectSums(PhaseSet phases) : phases_(phases), sums_(static_cast<std::size_t>(phases.size())) {
    std::uint8_t count = 0;
    for_each_phase(phases.bits, [&](int i) { index_[static_cast<std::size_t>(i)] = count++; });
}

void ObjectSums::add(const ExaminedBox& box, const MeasureContext& context) {
    const MeasuredBox measured(box.node.box, context.origin);
    ++additions_;
    if (box.only) return sums_[index_[box.only->index]].add(measured);
    for (std::size_t k = 0; k < box.phases.size(); ++k) {
        const PhaseInBox& p = box.phases[k];
        if (!(p.possible.moments[0] > 0)) continue;
        PhaseSums& sums = sums_[index_[p.phase.index]];
        sums.add(measured, p.certain, p.possible, estimate_in(box, k, measured));
        if (!box.can_be_divided) sums.final_doubt += p.doubt();
    }
}

void ObjectSums::add(const ObjectSums& o) {
    for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i].add(o.sums_[i]);
    additions_ = std::max(additions_, o.additions_) + 1;
}

}  // namespace phasetree::measuring
