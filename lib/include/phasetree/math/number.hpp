// The functions that every number type provides, here for `float`.
//
// Each equation is written once, as a template over its number type T:
//
//     float      the reference evaluator
//     Batch      SIMD, eight points at once
//     Dual       value and gradient
//     Recorded   emits instructions
//     Precise    double precision
//     Sourced    which node a value comes from
//     Traced     emits GLSL
//     Enclosure  the range of the values in a box
//
// `select` replaces branches. The first four types give identical values, bit for bit, because they do the same IEEE
// operations in the same order. This is also why min and max are defined here: their results for equal or unordered
// arguments are fixed.
#pragma once

#include <cmath>

namespace phasetree {

[[gnu::always_inline]] inline bool less(float a, float b) {
    return a < b;
}
[[gnu::always_inline]] inline float select(bool condition, float yes, float no) {
    return condition ? yes : no;
}

/// Returns the second operand if the comparison is false, like the SSE instructions.
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

/// floor(a) as a number without derivatives (for a Dual, a float).
template <class T>
T whole_part(const T& a) {
    return floor(a);
}

/// a·b + c, rounded once or twice, whichever is faster on the processor. Use it only where both give the same result,
/// for example for integers below 2²⁴.
template <class T>
T multiply_add(const T& a, float b, const T& c) {
    return a * b + c;
}

/// table[index] for an integer index within the table. For an index that may be NaN, see clamp().
[[gnu::always_inline]] inline float lookup(const float* table, float index) {
    return table[static_cast<int>(index)];
}

/// x clamped to [low, high]. NaN becomes `low`, because comparisons with NaN are false.
template <class T>
T clamp(const T& x, const T& low, const T& high) {
    return min(max(x, low), high);
}

/// Smooth union of two 1-Lipschitz fields with blending radius r (Galin et al., Section 9.3, after Dekkers et al.
/// 2004):
///     s(a, b) = min(a, b) − r/6 · max(1 − |b − a|/r, 0)³
/// The result is 1-Lipschitz, and at most r/6 below the plain minimum.
template <class T>
T smooth_min(const T& a, const T& b, float r) {
    const T d = max(1.f - abs(b - a) * (1.f / r), T(0.f));
    return min(a, b) - d * d * d * (r / 6.f);
}

template <class T>
T smooth_max(const T& a, const T& b, float r) {
    return -smooth_min(-a, -b, r);
}

/// A field f that is guarded against its discontinuities (lib/README.md): max(b, min(f, D − b)) for a bound b with {f ≤
/// 0} ⊂ {b ≤ 0}, where D is `far`. It has the sign of f, equals b where b ≥ D/2, and is 1-Lipschitz if f is 1-Lipschitz
/// where b < D/2, whatever f does elsewhere.
template <class T>
T guarded(const T& bound, const T& f, float far) {
    return max(bound, min(f, far - bound));
}

/// A field f with a bound b for far points: max(f, b), where {f ≤ 0} ⊂ {b ≤ 0} and b exceeds f far away. f alone
/// determines the sign, so b can be omitted near the surface.
template <class T>
T far_bound(const T& f, const T& bound) {
    return max(f, bound);
}
/// A field f with a bound b for points far inside: min(f, b), where {f ≥ 0} ⊂ {b ≥ 0}.
template <class T>
T far_bound_inside(const T& f, const T& bound) {
    return min(f, bound);
}

/// The part of solid a where b is not the nearer solid: max(a, (a − b)/2). It is negative where a is negative and less
/// than b. Its slope is at most the larger of theirs. If both are infinite, the result is a, because max() returns its
/// second operand if the first is NaN.
template <class T>
T nearer(const T& a, const T& b) {
    return max((a - b) * 0.5f, a);
}

/// The contribution of a skeleton at distance d to a blob of radius R: (1 − (d/R)²)³, and zero beyond R (after Wyvill
/// et al., "Data Structure for Soft Objects", 1986, with a different polynomial).
template <class T>
T falloff(const T& d, float radius) {
    const T x = max(d, T(0.f)) * (1.f / radius);
    const T y = max(1.f - x * x, T(0.f));
    return y * y * y;
}
/// The maximum slope of falloff() times R: 6x(1 − x²)² at x² = 1/5.
inline constexpr float steepest_falloff = 1.7172838f;

/// The exact signed distance to an intersection of two solids, from their exact signed distances a and b, which must
/// vary along orthogonal directions. Examples are a profile and the slab of an extrusion, or the two sides of a
/// rectangle. The gradient combines theirs with weights whose squares sum to at most 1, so the result is no steeper
/// than the steeper of the two. Its sign is that of max(a, b).
template <class T>
T corner(const T& a, const T& b) {
    const T zero(0.f);
    const T past_a = max(a, zero), past_b = max(b, zero);
    return sqrt(past_a * past_a + past_b * past_b) + min(max(a, b), zero);
}

/// The exact signed distance to an intersection of three solids whose distances vary along orthogonal directions.
template <class T>
T corner(const T& a, const T& b, const T& c) {
    const T zero(0.f);
    const T past_a = max(a, zero), past_b = max(b, zero), past_c = max(c, zero);
    return sqrt(past_a * past_a + past_b * past_b + past_c * past_c) + min(max(a, max(b, c)), zero);
}

/// Like select(), but the caller guarantees that both operands and their slopes agree where the condition changes.
/// Number types that bound derivatives (Enclosure) use this.
template <class Condition, class T>
T select_smoothly(const Condition& condition, const T& yes, const T& no) {
    return select(condition, yes, no);
}

/// Like select_smoothly(), with functions that return the operands. If the condition is known, only one of them is
/// called.
template <class Condition, class Yes, class No>
[[gnu::always_inline]] inline auto choose_smoothly(const Condition& condition, const Yes& yes, const No& no) {
    return select_smoothly(condition, yes(), no());
}
template <class Yes, class No>
[[gnu::always_inline]] inline auto choose_smoothly(bool condition, const Yes& yes, const No& no) {
    return condition ? yes() : no();
}

/// Return f. Number types that bound values in a box (Enclosure) may instead return a second expression that equals f
/// under a condition, if the condition is true throughout the box. They call `other` with a function certainly(c),
/// which returns whether the comparison c holds throughout the box. `other` returns a pair: whether the condition holds
/// throughout the box, and the expression to use instead of f in that case.
template <class T, class Other>
T also_known_as(const T& f, const Other&) {
    return f;
}

template <class T>
struct SineCosine {
    T sine, cosine;
};

/// The sine and cosine of x in radians, for |x| up to 10⁴. The error is at most 2 ulp of 1. Computed here because
/// library functions differ between scalar and SIMD code. Uses Cody and Waite's reduction to |r| ≤ π/4, then Taylor
/// polynomials shortened by Chebyshev economisation.
template <class T>
SineCosine<T> sine_cosine(const T& x) {
    const T k = floor(x * 0.636619772367581343f + 0.5f);
    // π/2 is split into three parts with few bits, so that k times each of the first two is exact.
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
    // The sine is negative in quadrants 2 and 3, the cosine in 1 and 2.
    return {select(less(T(1.5f), quadrant), -sine, sine), select(less(abs(quadrant - 1.5f), T(1.f)), -cosine, cosine)};
}

/// The sine alone, with the same range and error at half the cost. x is reduced to |r| ≤ π/2. There a polynomial that
/// interpolates (sin √z/√z − 1)/z at Chebyshev nodes has an error of at most 3·10⁻⁸.
template <class T>
T sine(const T& x) {
    const T k = floor(x * 0.318309886183790672f + 0.5f);
    const T r = ((x - k * 3.140625f) - k * 9.67502593994140625e-4f) - k * 1.5099579897537296e-7f;
    const T z = r * r;
    const T s =
        r + r * z * (-1.66666659635e-1f + z * (8.33324210802e-3f + z * (-1.9822735835e-4f + z * 2.63474455579e-6f)));
    const T half = k * 0.5f;
    return s * (1.f - (half - floor(half)) * 4.f);  // the sign changes at odd multiples of π
}

}  // namespace phasetree
