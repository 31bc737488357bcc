// The box is mapped to the unit cube, which consists of six tetrahedra with a common diagonal. A plane cuts each of
// them into tetrahedra, whose moments are polynomials of their vertices.
//
// Rounding errors, in units of 2⁻⁵³: In the unit cube, all coordinates are in [0, 1]. Errors of the linear function and
// of vertices on the plane move the plane by less than 60 units, which changes no moment by more than 100. There are at
// most 18 tetrahedra. Each determinant has six terms of at most 1, with at most eight roundings each, so the error of a
// volume is less than 10, that of a moment less than 25, and that of the sum of the moments less than 500. The map to
// the box measures coordinates from the box's low corner. |low| + size is at most three times the largest absolute
// coordinate, so the error of a second moment is at most 9 · 600 units, relative to the box's volume times the largest
// absolute value of the integrand, as in part_below(); and 5400 · 2⁻⁵³ < 10⁻¹².
#include "measuring/cut_box.hpp"

#include <algorithm>
#include <cmath>

namespace phasetree::measuring {

namespace {

using Point = std::array<double, 3>;

// The part of the unit cube below the plane.
struct UnitPart {
    Moments moments{};
    Point low{1, 1, 1}, high{0, 0, 0};
    bool is_empty = true;

    void extend(const Point& p) {
        is_empty = false;
        for (std::size_t i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], p[i]);
            high[i] = std::max(high[i], p[i]);
        }
    }
    // Adds the moments of a tetrahedron, multiplied by `sign`.
    void add(const Point& a, const Point& b, const Point& c, const Point& d, double sign = 1) {
        Point u{}, v{}, w{}, sum{};
        for (std::size_t i = 0; i < 3; ++i) {
            u[i] = b[i] - a[i];
            v[i] = c[i] - a[i];
            w[i] = d[i] - a[i];
            sum[i] = (a[i] + b[i]) + (c[i] + d[i]);
        }
        const double det = u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
                           u[2] * (v[0] * w[1] - v[1] * w[0]);
        const double volume = sign * std::abs(det) / 6;
        moments[0] += volume;
        for (std::size_t i = 0; i < 3; ++i) {
            moments[1 + i] += volume / 4 * sum[i];
            for (std::size_t j = i; j < 3; ++j)
                moments[product_index(i, j)] +=
                    volume / 20 * ((a[i] * a[j] + b[i] * b[j]) + (c[i] * c[j] + d[i] * d[j]) + sum[i] * sum[j]);
        }
    }
};

struct Corner {
    Point p;
    double f;
};

// The point at which the linear function is zero, between a corner below the plane and one that is not.
Point zero_between(const Corner& below, const Corner& above) {
    const double t = below.f / (below.f - above.f);
    Point p{};
    for (std::size_t i = 0; i < 3; ++i) p[i] = below.p[i] + t * (above.p[i] - below.p[i]);
    return p;
}

void add_below(UnitPart& part, std::array<Corner, 4> c) {
    std::sort(c.begin(), c.end(), [](const Corner& a, const Corner& b) { return a.f < b.f; });
    const auto below =
        static_cast<std::size_t>(std::count_if(c.begin(), c.end(), [](const Corner& k) { return k.f < 0; }));
    for (std::size_t i = 0; i < below; ++i) part.extend(c[i].p);
    if (below == 0) return;
    if (below == 4) return part.add(c[0].p, c[1].p, c[2].p, c[3].p);
    std::array<std::array<Point, 4>, 4> zero{};
    for (std::size_t i = 0; i < below; ++i)
        for (std::size_t j = below; j < 4; ++j) part.extend(zero[i][j] = zero_between(c[i], c[j]));
    if (below == 1) return part.add(c[0].p, zero[0][1], zero[0][2], zero[0][3]);
    if (below == 3) {
        part.add(c[0].p, c[1].p, c[2].p, c[3].p);
        return part.add(zero[0][3], zero[1][3], zero[2][3], c[3].p, -1);
    }
    part.add(c[0].p, zero[0][2], zero[0][3], zero[1][3]);
    part.add(c[0].p, zero[0][2], zero[1][2], zero[1][3]);
    part.add(c[0].p, c[1].p, zero[1][2], zero[1][3]);
}

UnitPart part_of_cube(const LinearInBox& f) {
    static constexpr std::size_t orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    UnitPart part;
    for (const auto& order : orders) {
        std::array<Corner, 4> corners{};
        Corner at{{0, 0, 0}, f.at_low};
        corners[0] = at;
        for (std::size_t k = 0; k < 3; ++k) {
            at.p[order[k]] = 1;
            corners[k + 1] = at;
        }
        for (Corner& c : corners)
            c.f = f.at_low + ((c.p[0] * f.change[0] + c.p[1] * f.change[1]) + c.p[2] * f.change[2]);
        add_below(part, corners);
    }
    return part;
}

// The moments of a part of a box from those in the unit cube.
Moments in_box(const Moments& unit, const MeasuredBox& box) {
    const double volume = box.volume();
    Moments m{};
    m[0] = volume * unit[0];
    for (std::size_t i = 0; i < 3; ++i) {
        m[1 + i] = volume * (box.low[i] * unit[0] + box.size[i] * unit[1 + i]);
        for (std::size_t j = i; j < 3; ++j)
            m[product_index(i, j)] =
                volume * ((box.low[i] * box.low[j] * unit[0] + box.size[i] * box.size[j] * unit[product_index(i, j)]) +
                          (box.low[i] * box.size[j] * unit[1 + j] + box.low[j] * box.size[i] * unit[1 + i]));
    }
    return m;
}

}  // namespace

Moments MeasuredBox::moments() const {
    static constexpr Moments cube{1, 0.5, 0.5, 0.5, 1.0 / 3, 1.0 / 3, 1.0 / 3, 0.25, 0.25, 0.25};
    return in_box(cube, *this);
}

PartOfBox::PartOfBox(const MeasuredBox& box) : moments(box.moments()), low(box.low) {
    for (std::size_t i = 0; i < 3; ++i) high[i] = box.high(i);
}

PartOfBox part_below(const LinearInBox& f, const MeasuredBox& box) {
    double least = f.at_low, largest = f.at_low;
    for (const double d : f.change) {
        least += std::min(d, 0.0);
        largest += std::max(d, 0.0);
    }
    if (largest < 0) return PartOfBox(box);
    PartOfBox result;
    if (!(least < 0)) return result;
    const UnitPart unit = part_of_cube(f);
    if (unit.is_empty) return result;
    result.moments = in_box(unit.moments, box);
    for (std::size_t i = 0; i < 3; ++i) {
        result.low[i] = box.low[i] + unit.low[i] * box.size[i];
        result.high[i] = box.low[i] + unit.high[i] * box.size[i];
    }
    return result;
}

}  // namespace phasetree::measuring
