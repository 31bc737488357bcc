#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "enclosure/field_in_box.hpp"
#include "phasetree/math/value_noise.hpp"

namespace phasetree::enclosure {

namespace detail {

/// The ranges of the first and second derivatives of lattice::fade over a part of [0, 1].
struct FadeRange {
    Interval first, second;

    FadeRange(double low, double high) : first(hull(at(slope(low)), at(slope(high)))) {
        constexpr double most_curved = 0.21132486540518713, curvature = 5.773502691896258;  // (3 − √3)/6, 10/√3
        second = hull(at(bend(low)), at(bend(high)));
        if (low < 0.5 && high > 0.5) first.high = 1.875;
        if (low < most_curved && high > most_curved) second.high = curvature;
        if (low < 1 - most_curved && high > 1 - most_curved) second.low = -curvature;
    }
    static double slope(double t) { return 30 * t * t * (1 - t) * (1 - t); }
    static double bend(double t) { return 60 * t * (1 - t) * (1 - 2 * t); }

  private:
    static Interval at(double v) { return {v, v}; }
};

/// The values at a lattice cell's corners; bit i of a corner's index is set if it is the upper corner along axis i.
template <std::size_t dimensions>
using Corners = std::array<double, std::size_t{1} << dimensions>;

/// Bounds value noise and its derivatives in a region that touches few cells of the lattice, from the values at the
/// corners of these cells. Between the corners, noise is a product of one-dimensional blends,
///     ∂f/∂xᵢ = F′ᵢ · E[Δᵢw],   ∂²f/∂xᵢ² = F″ᵢ · E[Δᵢw],   ∂²f/∂xᵢ∂xⱼ = F′ᵢ F′ⱼ · E[ΔᵢΔⱼw],
/// where E denotes means of differences Δ of the corners' values. So these lie between the smallest and the largest of
/// the differences.
template <std::size_t dimensions>
class NoiseInBox {
  public:
    /// Regions that touch more than eight cells, or four along an axis, count as large: they get bounds that hold
    /// everywhere.
    explicit NoiseInBox(const Region& at) : at_(at) {
        for (std::size_t i = 0; i < dimensions; ++i) {
            low_[i] = std::floor(at.centre[i] - at.half_extents[i]);
            const double cells = std::floor(at.centre[i] + at.half_extents[i]) - low_[i] + 1;
            if (!(cells <= 4)) is_large_ = true;
            count_[i] = is_large_ ? 1 : static_cast<std::size_t>(cells);
            all_ *= count_[i];
        }
        is_large_ = is_large_ || all_ > 8;
    }

    /// `corners(cell)` returns the values at the corners of a lattice cell.
    template <class F>
    FieldInBox operator()(F&& corners) const {
        FieldInBox f;
        std::array<double, dimensions> centre;
        for (std::size_t i = 0; i < dimensions; ++i) centre[i] = std::floor(at_.centre[i]);
        at_centre(corners(centre), centre, f);
        if (is_large_) {
            // F′ is at most 15/8, and |F″| at most 10/√3 (FadeRange). Corners are in [−1, 1], so a first difference is
            // at most 2, and a second difference at most 4. The curvature is the largest row sum (Gershgorin), as
            // below.
            f.values = {-1, 1};
            for (std::size_t i = 0; i < dimensions; ++i) f.gradients[i] = within(3.75);
            f.curvature = within(2 * 5.7735027 + 4 * 3.515625 * (dimensions - 1));
            return f;
        }
        Derivatives d;
        std::array<double, dimensions> cell = low_;
        for (std::size_t n = 0; n < all_; ++n) {
            std::size_t rest = n;
            for (std::size_t i = 0; i < dimensions; ++i) {
                cell[i] = low_[i] + static_cast<double>(rest % count_[i]);
                rest /= count_[i];
            }
            add(corners(cell), cell, n == 0, d);
        }
        f.values = d.value;
        f.curvature = {Interval::most, -Interval::most};
        for (std::size_t i = 0; i < dimensions; ++i) {
            double change = 0, mixed = 0;
            for (std::size_t j = 0; j < dimensions; ++j) {
                const double most = d.second[i][j].magnitude();
                change += most * at_.half_extents[j];
                if (j != i) mixed += most;
            }
            f.gradients[i] = {std::max(d.first[i].low, f.gradient[i] - change),
                              std::min(d.first[i].high, f.gradient[i] + change)};
            // The eigenvalues of the matrix of second derivatives lie within Gershgorin's circles.
            f.curvature.low = std::min(f.curvature.low, d.second[i][i].low - mixed);
            f.curvature.high = std::max(f.curvature.high, d.second[i][i].high + mixed);
        }
        return f;
    }

  private:
    struct Derivatives {
        Interval value;
        std::array<Interval, dimensions> first;
        std::array<std::array<Interval, dimensions>, dimensions> second;
    };

    void at_centre(const Corners<dimensions>& w, const std::array<double, dimensions>& cell, FieldInBox& f) const {
        std::array<double, dimensions> t, share;
        for (std::size_t i = 0; i < dimensions; ++i) {
            t[i] = at_.centre[i] - cell[i];
            share[i] = lattice::fade(t[i]);
        }
        for (std::size_t corner = 0; corner < w.size(); ++corner) {
            double weight = 1;
            for (std::size_t i = 0; i < dimensions; ++i) weight *= is_upper(corner, i) ? share[i] : 1 - share[i];
            f.value += weight * w[corner];
            for (std::size_t i = 0; i < dimensions; ++i) {
                double others = FadeRange::slope(t[i]);
                for (std::size_t j = 0; j < dimensions; ++j)
                    if (j != i) others *= is_upper(corner, j) ? share[j] : 1 - share[j];
                f.gradient[i] += is_upper(corner, i) ? others * w[corner] : -others * w[corner];
            }
        }
    }

    void add(const Corners<dimensions>& w, const std::array<double, dimensions>& cell, bool is_first,
             Derivatives& d) const {
        const auto join = [&](Interval& all, const Interval& here) { all = is_first ? here : hull(all, here); };
        Interval values{w[0], w[0]};
        for (const double v : w) values = hull(values, {v, v});
        join(d.value, values);
        std::array<std::optional<FadeRange>, dimensions> fade;
        for (std::size_t i = 0; i < dimensions; ++i)
            fade[i].emplace(std::clamp(at_.centre[i] - at_.half_extents[i] - cell[i], 0.0, 1.0),
                            std::clamp(at_.centre[i] + at_.half_extents[i] - cell[i], 0.0, 1.0));
        for (std::size_t i = 0; i < dimensions; ++i) {
            const Interval steps = of_differences(w, std::size_t{1} << i, 0);
            join(d.first[i], fade[i]->first * steps);
            join(d.second[i][i], fade[i]->second * steps);
            for (std::size_t j = 0; j < i; ++j) {
                const Interval twists = of_differences(w, std::size_t{1} << i, std::size_t{1} << j);
                join(d.second[i][j], fade[i]->first * fade[j]->first * twists);
                d.second[j][i] = d.second[i][j];
            }
        }
    }

    static bool is_upper(std::size_t corner, std::size_t axis) { return (corner >> axis & 1) != 0; }

    /// The range of the corners' differences along one axis; with `other`, of the second differences along both axes.
    static Interval of_differences(const Corners<dimensions>& w, std::size_t axis, std::size_t other) {
        Interval all{Interval::most, -Interval::most};
        for (std::size_t corner = 0; corner < w.size(); ++corner) {
            if ((corner & (axis | other)) != 0) continue;
            double step = w[corner | axis] - w[corner];
            if (other != 0) step = w[corner | axis | other] - w[corner | other] - step;
            all = hull(all, {step, step});
        }
        return all;
    }

    const Region& at_;
    std::array<double, dimensions> low_{};
    std::array<std::size_t, dimensions> count_{};
    std::size_t all_ = 1;
    bool is_large_ = false;
};

/// The two lattice points of a cell along an axis, modulo 289.
inline std::array<float, 2> ends(double cell) {
    const auto c = lattice::coordinate(static_cast<float>(cell));
    return {c.low, c.high};
}

}  // namespace detail

inline Enclosure value_noise(const Vec3<Enclosure>& p) {
    using lattice::hashed, lattice::hashed_on;
    const Region at(p);
    const FieldInBox f = detail::NoiseInBox<3>(at)([](const std::array<double, 3>& cell) {
        const auto x = detail::ends(cell[0]), y = detail::ends(cell[1]), z = detail::ends(cell[2]);
        detail::Corners<3> w;
        for (std::size_t i = 0; i < 2; ++i) {
            const float slice = hashed_on(x[i]);
            for (std::size_t j = 0; j < 2; ++j) {
                const float row = hashed_on(slice + y[j]);
                for (std::size_t k = 0; k < 2; ++k)
                    w[i + 2 * j + 4 * k] = static_cast<double>(lattice::centred(hashed(row + z[k])));
            }
        }
        return w;
    });
    return enclose(f, at);
}

inline Enclosure value_noise(const Enclosure& x, const Enclosure& y, float which) {
    using lattice::hashed, lattice::hashed_on;
    const Vec3<Enclosure> p{x, y, Enclosure(0.f)};
    const Region at(p);
    const float plane = hashed_on(lattice::wrapped(which));
    const FieldInBox f = detail::NoiseInBox<2>(at)([&](const std::array<double, 2>& cell) {
        const auto cx = detail::ends(cell[0]), cy = detail::ends(cell[1]);
        detail::Corners<2> w;
        for (std::size_t i = 0; i < 2; ++i) {
            const float row = hashed_on(plane + cx[i]);
            for (std::size_t j = 0; j < 2; ++j)
                w[i + 2 * j] = static_cast<double>(lattice::centred(hashed(row + cy[j])));
        }
        return w;
    });
    return enclose(f, at);
}

}  // namespace phasetree::enclosure
