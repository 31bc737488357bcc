// Certificates that a field keeps its sign between neighbouring samples along a ray. They are for fields of unknown
// curvature, and use the fields of which such a field is the minimum or maximum. Included by kernel.inl.
//
// A minimum is positive where both operands are. A maximum is positive between two samples if either operand is
// positive all the way between them. So a certificate is a tree of "both" and "either" over leaves, stored in postfix
// order and evaluated on a stack of masks with one bit per gap. A routine's certificate describes minus its first
// component: if it holds, that component is negative, and the ray stays in the first output's phase.
//
// With the leaves negated, and "both" and "either" exchanged, the tree certifies the opposite sign. This is valid if a
// step is positive exactly where its operands imply it. Some fields are positive where either operand is, but possibly
// elsewhere, too (either_one_way; for example, Op::corner compared with a positive number). Two negative operands then
// prove nothing, so this step never holds in a negated certificate.
//
// A leaf g is 1-Lipschitz and known at the samples. Consider a gap of length h between the values a and b. The leaf is
// positive in it
//  * if g″ ≤ K and √a + √b ≥ h √(K/2): see March::is_free_by_curvature;
//  * or if g″ ≥ −κ and the following test holds. g + κt²/2 is convex, so outside of two samples it lies above the line
//    through them. Within the gap, therefore, g lies above a line that falls from a with the slope of the previous gap,
//    and above one that rises to b with the slope of the next gap. Each slope is made steeper by κ/2 times the length
//    of both gaps together. Two lines that fall by p and rise by q leave no room for a zero if a/p + b/q ≥ h. Where
//    nothing is known, p and q are 1, which is the test whether balls cover the gap.

namespace phasetree::kernel::HWY_NAMESPACE {
namespace {

// The float with these upper 16 bits.
HWY_INLINE float float_of_upper_bits(std::uint16_t upper) {
    const std::uint32_t bits = std::uint32_t{upper} << 16;
    float x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
}

// The gaps between samples; lane i holds the gap that ends at sample i.
struct Gaps {
    Batch length, inverse;       // the length and 1/length
    Batch with_last, with_next;  // its length plus that of the previous, or the next, gap
    float rounding_error;        // the error of a field's value
};

HWY_INLINE Gaps gaps_between(const Batch& t, float rounding_error) {
    const Batch length = max(t - shifted(t, 0), Batch(1e-30f));
    return {length, Batch(1.f) / length, length + shifted(length, 0), length + shifted_back(length, 0), rounding_error};
}

// Bit i is set if the leaf, or minus the leaf if `is_negated`, is proven positive in the gap that ends at lane i. It is
// never set for the first lane, where a is 0.
HWY_INLINE std::uint32_t certified_by_leaf(const PackedCertificateStep& s, bool is_negated, const float* registers,
                                           const Gaps& gaps) {
    const float factor = float_of_upper_bits(s.factor);
    const float up = float_of_upper_bits(is_negated ? s.down : s.up),
                down = float_of_upper_bits(is_negated ? s.up : s.down);
    const Batch zero(0.f), one(1.f), unknown(1e30f);
    const Batch g =
        (load(registers + std::size_t{s.slot} * batch_size) - s.threshold) * (is_negated ? -factor : factor);
    const Batch b = g - gaps.rounding_error, a = shifted(b, 0);
    std::uint32_t free = 0;
    if (up < 1e30f) {
        const Batch missing = gaps.length * gaps.length * (0.5f * up) - a - b;
        free = ~bits(less(zero, missing)) | ~bits(less(a * b * 4.f, missing * missing));
    }
    if (down < 1e30f) {
        const Batch slope = (g - shifted(g, 0)) * gaps.inverse, error = gaps.inverse * (2 * gaps.rounding_error);
        const Batch falls = select(less(lanes(), Batch(0.5f)), unknown, error - slope), rises = error + slope;
        const Batch bend(0.5f * down);
        const Batch p = max(min(shifted(falls, 0) + gaps.with_last * bend, one), zero);
        const Batch q = max(min(shifted_back(rises, 1e30f) + gaps.with_next * bend, one), zero);
        free |= ~bits(less(a * q + b * p, gaps.length * p * q));
    } else {
        free |= ~bits(less(a + b, gaps.length));
    }
    return free & bits(less(zero, min(a, b)));
}

// Bit i is set if the first component is proven to keep its sign in the gap that ends at lane i: to be negative, as in
// the phase of the first output, or, if `is_negated`, positive, as in the other phases.
std::uint32_t certified_gaps(const Routine& routine, bool is_negated, const float* registers, const Batch& t,
                             float rounding_error) {
    const Gaps gaps = gaps_between(t, rounding_error);
    std::uint32_t stack[most_certificate_steps];
    std::uint32_t* top = stack;
    for (const PackedCertificateStep *s = routine.certificate, *end = s + routine.certificate_steps; s != end; ++s) {
        if (s->kind == PackedCertificateStep::leaf) {
            *top++ = certified_by_leaf(*s, is_negated, registers, gaps);
            continue;
        }
        --top;
        if (s->kind == PackedCertificateStep::either_one_way) {
            top[-1] = is_negated ? 0 : top[-1] | *top;
            continue;
        }
        const bool is_both = (s->kind == PackedCertificateStep::both) != is_negated;
        top[-1] = is_both ? top[-1] & *top : top[-1] | *top;
    }
    return stack[0];
}

}  // namespace
}  // namespace phasetree::kernel::HWY_NAMESPACE
