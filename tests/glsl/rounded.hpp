#pragma once

/// A number type for error analysis: a value, and a bound on how far a computation in 32 bits may be from it (running
/// error analysis; Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., 2002, Section 3.3). An equation
/// that is evaluated over it gives the tolerance of its own result at this point. Each operation adds its own rounding:
/// half a unit in the last place for sums, differences and products; what GLSL ES 3.00 allows, two and a half units,
/// for quotients, and five for roots. Where a comparison is a matter of rounding, either operand may be chosen.

#include <algorithm>
#include <cmath>

#include "phasetree/math/number.hpp"
#include "phasetree/math/vec3.hpp"

namespace phasetree::tests {

struct Rounded {
    double value = 0, error = 0;
    double added = 0;  ///< of a sum: the size of the constants in it

    Rounded() = default;
    explicit Rounded(float v) : value(v) {}
    Rounded(double v, double e) : value(v), error(e) {}
};

inline constexpr double unit_roundoff = 0x1p-24, smallest = 0x1p-126;

/// A result, with the error of its operands and this many half units of its own. Sums and products that are whole
/// numbers are exact, as hashes need it. Others are not, even where 32 bits hold them.
inline Rounded rounded(double value, double error, double half_units = 1) {
    if (half_units == 1 && error == 0 && std::floor(value) == value && std::abs(value) <= 0x1p24) return {value, 0};
    return {value, error + half_units * (unit_roundoff * (std::abs(value) + error) + smallest)};
}
/// Whatever both may be.
inline Rounded either(const Rounded& a, const Rounded& b) {
    const double low = std::min(a.value - a.error, b.value - b.error);
    const double high = std::max(a.value + a.error, b.value + b.error);
    return {0.5 * (low + high), 0.5 * (high - low)};
}

inline Rounded operator-(const Rounded& a) {
    Rounded result = a;
    result.value = -a.value;
    return result;
}
/// Compilers of shaders may make x + (a − b) of (x + a) − b, where a and b are constants; then a − b is rounded, to
/// half a unit of them at most. Constants are known by their error of 0; whole numbers, of which hashes are made, do
/// not matter.
inline Rounded sum_of(const Rounded& a, const Rounded& b, double value) {
    const auto constant = [](const Rounded& r) {
        return r.error == 0 && std::floor(r.value) != r.value ? std::abs(r.value) : 0;
    };
    const double joined = (constant(b) > 0 ? a.added : 0) + (constant(a) > 0 ? b.added : 0);
    const double added = a.added + b.added + std::max(constant(a), constant(b));
    Rounded sum = rounded(value, a.error + b.error + (joined > 0 ? unit_roundoff * added : 0));
    sum.added = added;
    return sum;
}
inline Rounded operator+(const Rounded& a, const Rounded& b) {
    return sum_of(a, b, a.value + b.value);
}
inline Rounded operator-(const Rounded& a, const Rounded& b) {
    return sum_of(a, b, a.value - b.value);
}
inline Rounded operator*(const Rounded& a, const Rounded& b) {
    // Likewise x k + c k may be made of (x + c) k, each of whose products is rounded.
    const double added =
        (b.error == 0 ? a.added * std::abs(b.value) : 0) + (a.error == 0 ? b.added * std::abs(a.value) : 0);
    const double value = a.value * b.value;
    const double distributed = added > 0 ? unit_roundoff * (2 * added + std::abs(value)) : 0;
    Rounded product =
        rounded(value, std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error + distributed);
    product.added = added;
    return product;
}
inline Rounded operator/(const Rounded& a, const Rounded& b) {
    const double least = std::abs(b.value) - b.error;
    if (!(least > 0)) return {0, INFINITY};
    const double value = a.value / b.value;
    return rounded(value, (a.error + std::abs(value) * b.error) / least, 6);
}
inline Rounded operator+(const Rounded& a, float b) {
    return a + Rounded(b);
}
inline Rounded operator-(const Rounded& a, float b) {
    return a - Rounded(b);
}
inline Rounded operator*(const Rounded& a, float b) {
    return a * Rounded(b);
}
inline Rounded operator/(const Rounded& a, float b) {
    return a / Rounded(b);
}
inline Rounded operator+(float a, const Rounded& b) {
    return Rounded(a) + b;
}
inline Rounded operator-(float a, const Rounded& b) {
    return Rounded(a) - b;
}
inline Rounded operator*(float a, const Rounded& b) {
    return Rounded(a) * b;
}

/// Whether a comparison is true: certainly, certainly not, or as rounding has it.
struct RoundedCondition {
    bool may_be_true, may_be_false;
};
inline RoundedCondition less(const Rounded& a, const Rounded& b) {
    const double error = a.error + b.error;
    return {a.value - b.value < error, a.value - b.value >= -error};
}
inline Rounded select(const RoundedCondition& c, const Rounded& yes, const Rounded& no) {
    return c.may_be_true && c.may_be_false ? either(yes, no) : c.may_be_true ? yes : no;
}
/// The bounds of a minimum are the minima of the bounds.
inline Rounded min(const Rounded& a, const Rounded& b) {
    const double low = std::min(a.value - a.error, b.value - b.error);
    const double high = std::min(a.value + a.error, b.value + b.error);
    return {0.5 * (low + high), 0.5 * (high - low)};
}
inline Rounded max(const Rounded& a, const Rounded& b) {
    return -min(-a, -b);
}
inline Rounded abs(const Rounded& a) {
    return {std::abs(a.value), a.error};
}
inline Rounded sqrt(const Rounded& a) {
    const double low = std::sqrt(std::max(a.value - a.error, 0.0)), high = std::sqrt(std::max(a.value + a.error, 0.0));
    return rounded(0.5 * (low + high), 0.5 * (high - low), 10);
}
inline Rounded floor(const Rounded& a) {
    const double low = std::floor(a.value - a.error), high = std::floor(a.value + a.error);
    return {0.5 * (low + high), 0.5 * (high - low)};
}
/// Products with whole numbers that are rounded once or twice alike: those of hashes are exact.
inline Rounded multiply_add(const Rounded& a, float b, const Rounded& c) {
    return {a.value * static_cast<double>(b) + c.value, a.error * std::abs(static_cast<double>(b)) + c.error};
}
inline Rounded lookup(const float* table, const Rounded& index) {
    const auto low = static_cast<std::ptrdiff_t>(index.value - index.error),
               high = static_cast<std::ptrdiff_t>(index.value + index.error);
    Rounded result(table[low]);
    if (high > low) result = either(result, Rounded(table[high]));
    return high > low + 1 ? Rounded(0, INFINITY) : result;
}
/// A shader has no search, so the loop over everything is what is compared.
template <class Search, class Equation, class Otherwise>
Rounded found_equation(const Vec3<Rounded>& p, const Search&, const Equation&, const Otherwise& otherwise) {
    return otherwise(p);
}
template <std::size_t count, class Search, class Equation, class Otherwise>
Rounded gathered_equation(const Vec3<Rounded>& p, const Search&, const Equation&, const Otherwise& otherwise) {
    return otherwise(p);
}

}  // namespace phasetree::tests
