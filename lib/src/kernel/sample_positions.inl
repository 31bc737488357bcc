// Chooses the positions along a ray to sample, eight at a time. Included by kernel.inl.

namespace phasetree::kernel::HWY_NAMESPACE {
namespace {

// A sample: its distance along the ray, and s(p) and the phase there.
struct Sample {
    float t, distance, label;
};

HWY_INLINE float smaller(float a, float b) {
    return a < b ? a : b;
}
HWY_INLINE float larger(float a, float b) {
    return a > b ? a : b;
}
HWY_INLINE std::uint32_t bits_of(float x) {
    std::uint32_t u;
    std::memcpy(&u, &x, sizeof u);
    return u;
}
HWY_INLINE float float_of(std::uint32_t u) {
    float x;
    std::memcpy(&x, &u, sizeof x);
    return x;
}

constexpr float last_lane = batch_size - 1;
constexpr std::uint32_t all_lanes = (1u << batch_size) - 1;  // a mask with the bits of all lanes

// The positions t, limited to `high`, with the last one moved to `high`.
HWY_INLINE Batch ending_at(const Batch& t, float high) {
    return select(less(lanes(), Batch(last_lane)), min(t, Batch(high)), Batch(high));
}

// Eight positions in equal steps, the first at `low` and the last at `high`.
HWY_INLINE Batch evenly_spaced(float low, float high) {
    return ending_at(Batch(low) + lanes() * ((high - low) * (1 / last_lane)), high);
}

// The step with which geometric() goes from a to b in this many steps; 0 if b is no larger than a. The number of steps
// is a template parameter, because dividing by a variable is slow.
template <std::uint32_t steps>
HWY_INLINE std::uint32_t geometric_step(float a, float b) {
    return (bits_of(larger(a, b)) - bits_of(a)) / steps;
}

// Eight positions for a ray that starts on an interface, at 0: 0 itself, `smallest`, and then in equal ratios up to
// `high`.
HWY_INLINE Batch spaced_from_interface(float high, float smallest) {
    const std::uint32_t step = geometric_step<batch_size - 2>(smallest, high);
    const Batch t = geometric(lanes() - 1.f, bits_of(smallest), step);
    return ending_at(select(less(lanes(), Batch(0.5f)), Batch(0.f), t), high);
}

// Eight positions after `low`, up to `high`, for a ray that leaves an interface. Its distance from the interface is s
// at `low`, and is expected to grow by `slope` per unit of length. Two neighbouring samples prove a step d between them
// free if d ≤ s + (s + slope·d), where s is the distance at the first. Steps are a tenth shorter, in case the distance
// does not grow linearly. Each step multiplies s by the same factor, so the positions are a geometric sum.
HWY_INLINE Batch spaced_growing(float low, float high, float s, float slope) {
    const float growth = 1.8f / (1.f - 0.9f * slope);
    float factor = 1.f + slope * growth;
    // The factor raised to the lane number + 1, by binary exponentiation.
    Batch power(factor), number = lanes();
    for (float bit = 1; bit < batch_size; bit *= 2, factor *= factor) {
        const Batch half = floor(number * 0.5f);
        power = select(less(Batch(0.5f), number - half * 2.f), power * factor, power);
        number = half;
    }
    return min(Batch(low) + (power - 1.f) * (s / slope), Batch(high));
}

// Four positions on each side of `root` in the gap from `low` to `high`. Their distances from `root` grow in equal
// ratios, from `smallest` to 0.6 of the way to the gap's end. With `has_low`, the first position is `low` itself,
// followed by three others on its side.
HWY_INLINE Batch gather_around(float root, float low, float high, float smallest, bool has_low) {
    constexpr float half = batch_size / 2;
    const std::uint32_t a = bits_of(smallest);
    constexpr std::uint32_t steps = batch_size / 2 - 1;
    const float far_below = 0.6f * (root - low), far_above = 0.6f * (high - root);
    const std::uint32_t below =
        has_low ? geometric_step<steps - 1>(smallest, far_below) : geometric_step<steps>(smallest, far_below);
    const std::uint32_t above = geometric_step<steps>(smallest, far_above);
    const Batch before = max(Batch(root) - geometric((half - 1) - lanes(), a, below), Batch(low));
    const Batch after = min(Batch(root) + geometric(lanes() - half, a, above), Batch(high));
    const Batch t = select(less(lanes(), Batch(half)), before, after);
    return has_low ? select(less(lanes(), Batch(0.5f)), Batch(low), t) : t;
}

// Predicts where the label changes between `here` and `next` by linear interpolation of the distances. Two more
// samples, `before` and `after` the gap, correct for curvature; each is used only if its label equals that of the
// adjacent end of the gap.
HWY_INLINE float predicted_root(const Sample& here, const Sample& next, const Sample& before, const Sample& after) {
    const float gap = next.t - here.t, sum = here.distance + next.distance;
    if (!(sum > 0)) return here.t + 0.5f * gap;
    // The divisions do not depend on each other, so none waits for another.
    const float per_gap = 1 / gap, inverse_steepness = gap / sum;
    const float slope = -sum * per_gap;  // the distance is negative beyond the change
    const float root = here.t + here.distance * inverse_steepness;
    // The second divided difference estimates the curvature of the distance.
    float curvature = 0;
    int known = 0;
    if (before.label == here.label && before.t < here.t) {
        const float per_both = 1 / (next.t - before.t);
        curvature += (slope - (here.distance - before.distance) / (here.t - before.t)) * per_both;
        ++known;
    }
    if (after.label == next.label && after.t > next.t) {
        const float per_both = 1 / (after.t - here.t);
        curvature += ((next.distance - after.distance) / (after.t - next.t) - slope) * per_both;
        ++known;
    }
    if (known == 0) return root;
    const float there = curvature * (known == 2 ? 0.5f : 1.f) * (root - here.t) * (root - next.t);
    const float correction = there * inverse_steepness;
    return (correction < 0 ? -correction : correction) < 0.25f * gap ? root + correction : root;
}

}  // namespace
}  // namespace phasetree::kernel::HWY_NAMESPACE
