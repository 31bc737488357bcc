/// Whether a field keeps its sign between neighbouring samples along a ray, where its own curvature is not known: by
/// the fields that it is the minimum or maximum of. Included by kernel.inl.
///
/// A minimum is positive where both operands are; a maximum is, for one, between two samples between which one of its
/// operands is. So a certificate is a tree of such choices, in the order of a stack, over leaves; what is passed around
/// is a mask of gaps. The same certificate, with signs and choices turned, is that of the other side; but for a step
/// that implies what it stands for and is not implied by it.
///
/// A leaf g, 1-Lipschitz, is known at the samples. It is positive in a gap of length h between a and b
///  * if g″ ≤ K and √a + √b ≥ h √(K/2): see March::is_bridged;
///  * or if g″ ≥ −κ. Then g + κt²/2 is convex and lies, outside two samples, above the line through them: within the
///    gap g is above a line that falls from a, by the slope before it, and above one that rises to b, by the slope
///    behind it; each taken steeper by κ/2 times the distance from that slope's far end to the gap's. Two lines that
///    fall by p and rise by q leave no place for a zero if a/p + b/q ≥ h. Where nothing is known p and q are 1, and
///    that is what balls cover.

namespace phasetree::HWY_NAMESPACE {
namespace {

HWY_INLINE float float_of_half(std::uint16_t upper) {
    const std::uint32_t bits = std::uint32_t{upper} << 16;
    float x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
}

/// What a certificate needs to know of the samples' places: for each the gap before it.
struct Gaps {
    Batch length, inverse;
    Batch with_last, with_next;  ///< its length and that of the gap before it, or behind it
    float rounding;              ///< of a field's value
};

HWY_INLINE Gaps gaps_between(const Batch& t, float rounding) {
    const Batch length = max(t - shifted(t, 0), Batch(1e-30f));
    return {length, Batch(1.f) / length, length + shifted(length, 0), length + shifted_back(length, 0), rounding};
}

/// Bit i: the leaf is positive in the gap that ends at lane i; never for the first, where a is 0.
HWY_INLINE std::uint32_t proven_by_leaf(const PackedCertificateStep& s, bool is_turned, const float* registers,
                                        const Gaps& gaps) {
    const float factor = float_of_half(s.factor);
    const float up = float_of_half(is_turned ? s.down : s.up), down = float_of_half(is_turned ? s.up : s.down);
    const Batch zero(0.f), one(1.f), unknown(1e30f);
    const Batch g = (load(registers + std::size_t{s.slot} * batch_size) - s.threshold) * (is_turned ? -factor : factor);
    const Batch b = g - gaps.rounding, a = shifted(b, 0);
    std::uint32_t free = 0;
    if (up < 1e30f) {
        const Batch missing = gaps.length * gaps.length * (0.5f * up) - a - b;
        free = ~bits(less(zero, missing)) | ~bits(less(a * b * 4.f, missing * missing));
    }
    if (down < 1e30f) {
        const Batch slope = (g - shifted(g, 0)) * gaps.inverse, error = gaps.inverse * (2 * gaps.rounding);
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

/// Bit i: the first component keeps its sign in the gap that ends at lane i, which is that of a ray in the first phase;
/// or, turned, in the other.
std::uint32_t proven(const Routine& routine, bool is_turned, const float* registers, const Batch& t, float rounding) {
    const Gaps gaps = gaps_between(t, rounding);
    std::uint32_t stack[most_certificate_steps];
    std::uint32_t* top = stack;
    for (const PackedCertificateStep *s = routine.certificate, *end = s + routine.certificate_steps; s != end; ++s) {
        if (s->kind == PackedCertificateStep::leaf) {
            *top++ = proven_by_leaf(*s, is_turned, registers, gaps);
            continue;
        }
        --top;
        if (s->kind == PackedCertificateStep::either_one_way) {
            top[-1] = is_turned ? 0 : top[-1] | *top;
            continue;
        }
        const bool is_both = (s->kind == PackedCertificateStep::both) != is_turned;
        top[-1] = is_both ? top[-1] & *top : top[-1] | *top;
    }
    return stack[0];
}

}  // namespace
}  // namespace phasetree::HWY_NAMESPACE
