// The places along a ray that are sampled, eight at a time. Included by kernel.inl.

namespace phasetree::kernel::HWY_NAMESPACE {
namespace {

// A sample: its distance along the ray, s(p) there, and the phase there.
struct Place {
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

// The places t, none of them beyond `high`, and the last one at `high`.
HWY_INLINE Batch ending_at(const Batch& t, float high) {
    return select(less(lanes(), Batch(last_lane)), min(t, Batch(high)), Batch(high));
}

// Eight places in equal steps, the first at `low` and the last at `high`.
HWY_INLINE Batch spread_evenly(float low, float high) {
    return ending_at(Batch(low) + lanes() * ((high - low) * (1 / last_lane)), high);
}

// The step of geometric() that leads from a to b in so many steps. The number of steps is a constant, because divisions
// take long.
template <std::uint32_t steps>
HWY_INLINE std::uint32_t geometric_step(float a, float b) {
    return (bits_of(larger(a, b)) - bits_of(a)) / steps;
}

// Places that are spread from an interface at 0: 0 itself, `smallest`, and on in equal ratios up to `high`.
HWY_INLINE Batch spread_from_interface(float high, float smallest) {
    const std::uint32_t step = geometric_step<batch_size - 2>(smallest, high);
    const Batch t = geometric(lanes() - 1.f, bits_of(smallest), step);
    return ending_at(select(less(lanes(), Batch(0.5f)), Batch(0.f), t), high);
}

// Places from `low` on, in steps that the distance from an interface is expected to cover. It is s at `low` and grows
// by `slope` for each unit of length. The balls at both ends cover a step d if d ≤ s + (s + slope·d); steps are a tenth
// shorter, in case the distance does not grow linearly. From step to step s grows by the same factor, so the ends of
// the steps are a geometric sum.
HWY_INLINE Batch spread_growing(float low, float high, float s, float slope) {
    const float growth = 1.8f / (1.f - 0.9f * slope);
    float factor = 1.f + slope * growth;
    // The factor to the power of the lane's number + 1, by the bits of the number.
    Batch power(factor), number = lanes();
    for (float bit = 1; bit < batch_size; bit *= 2, factor *= factor) {
        const Batch half = floor(number * 0.5f);
        power = select(less(Batch(0.5f), number - half * 2.f), power * factor, power);
        number = half;
    }
    return min(Batch(low) + (power - 1.f) * (s / slope), Batch(high));
}

// Places on both sides of `root`, at offsets in equal ratios, from `smallest` to 0.6 of the way to the gap's ends. With
// `has_low` the first place is `low` itself.
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

// Predicts where the label changes between two places, from the distances at both, and from those at one place before
// and one after if their labels are the same as at the end next to them.
HWY_INLINE float predicted_root(const Place& here, const Place& next, const Place& before, const Place& after) {
    const float gap = next.t - here.t, sum = here.distance + next.distance;
    if (!(sum > 0)) return here.t + 0.5f * gap;
    // The divisions are independent of each other, so that none waits for another.
    const float per_gap = 1 / gap, per_slope = gap / sum;
    const float slope = -sum * per_gap;  // the distance counts as negative behind the change
    const float root = here.t + here.distance * per_slope;
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
    const float correction = there * per_slope;
    return (correction < 0 ? -correction : correction) < 0.25f * gap ? root + correction : root;
}

}  // namespace
}  // namespace phasetree::kernel::HWY_NAMESPACE
