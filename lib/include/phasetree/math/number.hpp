#pragma once

#include <cmath>

/// The functions that every number type of the project provides, here for `float`.
///
/// An equation is written once, as a template over its number type T. T is `float` (the reference evaluator), `Batch`
/// (SIMD, eight points at once), `Dual` (value and gradient) or `Recorded` (emits instructions). Where a
/// branch would stand, `select` chooses. All four give the same value bit for bit, because they do the same IEEE
/// operations in the same order; hence also our own min and max, whose result for equal or unordered arguments is
/// fixed. `Enclosure` gives what the value can be in a box.
namespace phasetree {

[[gnu::always_inline]] inline bool less(float a, float b) {
    return a < b;
}
[[gnu::always_inline]] inline float select(bool condition, float yes, float no) {
    return condition ? yes : no;
}

/// As the SSE instructions do it: the second operand if the comparison is false.
[[gnu::always_inline]] inline float min(float a, float b) {
    return a < b ? a : b;
}
[[gnu::always_inline]] inline float max(float a, float b) {
    return a > b ? a : b;
}
[[gnu::always_inline]] inline float abs(float a) {
    return std::fabs(a);
}
[[gnu::always_inline]] inline float sqrt(float a) {
    return std::sqrt(a);
}
[[gnu::always_inline]] inline float floor(float a) {
    return std::floor(a);
}

/// Rounded down, as a number without derivatives: of dual numbers a float.
template <class T>
T whole_part(const T& a) {
    return floor(a);
}

/// a·b + c, rounded once or twice, as the processor does it faster. Only for what is the same either way, such as whole
/// numbers below 2²⁴.
template <class T>
T multiply_add(const T& a, float b, const T& c) {
    return a * b + c;
}

/// table[index] for a whole index within the table; see clamp() for one that may be NaN.
[[gnu::always_inline]] inline float lookup(const float* table, float index) {
    return table[static_cast<int>(index)];
}

/// A NaN becomes `low`, because comparisons with it are false.
template <class T>
T clamp(const T& x, const T& low, const T& high) {
    return min(max(x, low), high);
}

/// Smooth union of two 1-Lipschitz fields with blending radius r (paper, Section 9.3, after Dekkers et al. 2004):
///     s(a, b) = min(a, b) − r/6 · max(1 − |b − a|/r, 0)³
/// 1-Lipschitz, and never more than r/6 below the plain minimum.
template <class T>
T smooth_min(const T& a, const T& b, float r) {
    const T d = max(1.f - abs(b - a) * (1.f / r), T(0.f));
    return min(a, b) - d * d * d * (r / 6.f);
}

template <class T>
T smooth_max(const T& a, const T& b, float r) {
    return -smooth_min(-a, -b, r);
}

/// A field above a discontinuity (lib/README.md): max(b, min(f, D − b)) for a bound {f ≤ 0} ⊂ {b ≤ 0}. It has the sign
/// of f, is b where b ≥ D/2, and 1-Lipschitz if f is so where b < D/2, whatever f does elsewhere.
template <class T>
T guarded(const T& bound, const T& f, float far) {
    return max(bound, min(f, far - bound));
}

/// A field f and a bound b that is farther from zero far away: max(f, b), where {f ≤ 0} ⊂ {b ≤ 0}. So f alone has the
/// sign, and near the surface it will do.
template <class T>
T far_bound(const T& f, const T& bound) {
    return max(f, bound);
}
/// The same inside: min(f, b), where {f ≥ 0} ⊂ {b ≥ 0}.
template <class T>
T far_bound_inside(const T& f, const T& bound) {
    return min(f, bound);
}

/// The contribution of a skeleton at the distance d to a blob: (1 − (d/R)²)³, zero beyond R (Wyvill et al., "Data
/// Structure for Soft Objects", 1986, with the square for their cubic).
template <class T>
T falloff(const T& d, float reach) {
    const T x = max(d, T(0.f)) * (1.f / reach);
    const T y = max(1.f - x * x, T(0.f));
    return y * y * y;
}
/// sup of |derivative| of falloff times R: at x² = 1/5, 6x(1 − x²)².
inline constexpr float steepest_falloff = 1.7172838f;

/// Signed distances a and b along orthogonal directions, each exact, give that of the intersection: for a profile and
/// the slab of an extrusion, or for the two sides of a rectangle. Its gradient is a combination of theirs whose
/// weights' squares sum to 1 at most; so it is no steeper than the steeper of the two. Its sign is that of max(a, b).
template <class T>
T corner(const T& a, const T& b) {
    const T zero(0.f);
    const T past_a = max(a, zero), past_b = max(b, zero);
    return sqrt(past_a * past_a + past_b * past_b) + min(max(a, b), zero);
}

/// Of three.
template <class T>
T corner(const T& a, const T& b, const T& c) {
    const T zero(0.f);
    const T past_a = max(a, zero), past_b = max(b, zero), past_c = max(c, zero);
    return sqrt(past_a * past_a + past_b * past_b + past_c * past_c) + min(max(a, max(b, c)), zero);
}

/// select(), where both and their slopes agree on the seam: for who wants to know (Enclosure).
template <class Condition, class T>
T select_smoothly(const Condition& condition, const T& yes, const T& no) {
    return select(condition, yes, no);
}

/// The same of functions that give the two: a number type that knows which one it is asks only that.
template <class Condition, class Yes, class No>
[[gnu::always_inline]] inline auto choose_smoothly(const Condition& condition, const Yes& yes, const No& no) {
    return select_smoothly(condition, yes(), no());
}
template <class Yes, class No>
[[gnu::always_inline]] inline auto choose_smoothly(bool condition, const Yes& yes, const No& no) {
    return condition ? yes() : no();
}

/// What else f is, where that is certain: for who wants to know. `other(certainly)` gives whether and what, asking
/// certainly(comparison).
template <class T, class Other>
T also_known_as(const T& f, const Other&) {
    return f;
}

template <class T>
struct SineCosine {
    T sine, cosine;
};

/// Sine and cosine together, for |x| up to 10⁴ within 2 ulp of 1. Our own, because a library's differ between scalar
/// and SIMD. Cody and Waite's reduction to |r| ≤ π/4, then the Taylor polynomials shortened by Chebyshev economisation.
template <class T>
SineCosine<T> sine_cosine(const T& x) {
    const T k = floor(x * 0.636619772367581343f + 0.5f);
    // π/2 in three parts of few bits, so that k times the first two is exact.
    const T r = ((x - k * 1.5703125f) - k * 4.837512969970703125e-4f) - k * 7.549789948768648e-8f;
    const T z = r * r;
    const T s = r + r * z * (-1.6666654611e-1f + z * (8.3321608736e-3f + z * -1.9515295891e-4f));
    const T c =
        (1.f - z * 0.5f) + z * z * (4.166664568298827e-2f + z * (-1.388731625493765e-3f + z * 2.443315711809948e-5f));
    const T quadrant = k - floor(k * 0.25f) * 4.f;
    const T half = quadrant * 0.5f;
    const auto is_odd = less(T(0.25f), half - floor(half));
    const T sine = select(is_odd, c, s);
    const T cosine = select(is_odd, s, c);
    // sine is negative in quadrants 2 and 3, cosine in 1 and 2.
    return {select(less(T(1.5f), quadrant), -sine, sine), select(less(abs(quadrant - 1.5f), T(1.f)), -cosine, cosine)};
}

/// The sine alone, for |x| up to 10⁴ within 2 ulp of 1, at half the price: reduced to |r| ≤ π/2, where a polynomial
/// through the Chebyshev nodes of (sin √z/√z − 1)/z is within 3·10⁻⁸.
template <class T>
T sine(const T& x) {
    const T k = floor(x * 0.318309886183790672f + 0.5f);
    const T r = ((x - k * 3.140625f) - k * 9.67502593994140625e-4f) - k * 1.5099579897537296e-7f;
    const T z = r * r;
    const T s =
        r + r * z * (-1.66666659635e-1f + z * (8.33324210802e-3f + z * (-1.9822735835e-4f + z * 2.63474455579e-6f)));
    const T half = k * 0.5f;
    return s * (1.f - (half - floor(half)) * 4.f);  // minus at odd multiples of π
}

}  // namespace phasetree
