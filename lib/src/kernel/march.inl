// Multiphase sphere tracing with a batch of points *along a single ray*. Included by kernel.inl.
//
// The search holds a sample `here`, which is certainly in the ray's phase, and a stack of frames of eight samples ahead
// of it. Each frame lies within a gap of the frame below it. Two neighbouring samples in the ray's phase prove the gap
// between them free of interfaces if their radii together cover it; one comparison tests a whole frame. The first gap
// in doubt is sampled again, at eight points inside it (sample_positions.inl):
//  - evenly spaced; or
//  - if the label differs at its end, gathered around the position where the distances predict the interface; or
//  - if the ray starts on an interface, spaced geometrically from there.
// A gap no longer than the resolution is the crossing if the labels at its ends differ; otherwise it is passed.
//
// A hit is a change of label, never merely a small distance. Phantom zeros, where components vanish without a change of
// label, cost samples but never cause hits.
//
// This file defines the class. Its search along the gaps is in search.inl; decide.inl decides what counts as a
// crossing.

namespace phasetree::kernel::HWY_NAMESPACE {
namespace {

class March {
  public:
    March(const Routine& routine, const RaySegment& ray, float* registers)
        : routine_(routine),
          ray_(ray),
          registers_(registers),
          is_first_enough_(routine.leading > 0 && routine.outputs[0].phase == ray.carried),
          is_by_own_(is_first_enough_ || routine.is_by_own) {}  // both take the distance from the phase's own component

    // Searches for the first crossing and counts the work. Returns whether there is one.
    bool search(RayCrossing& crossing) {
        const bool hit = find(crossing);
        crossing.length = ray_.length;
        crossing.batches = batches_;
        crossing.phantoms = phantoms_;
        return hit;
    }

  private:
    static constexpr float no_label = -1;
    // The search pauses after this many batches: most rays that need more creep along an interface (trace/creep.hpp).
    static constexpr std::uint32_t most_batches = 256;
    // The number of frames on the stack. Each lies within a gap of the frame below, which is at most about a fifth of
    // that frame's length.
    static constexpr int deepest = 24;

    // Samples the ray. If the first component is enough, only that is evaluated, and each label is either the ray's
    // phase or another_phase. `is_whole` requests all components.
    HWY_INLINE Classified sample(const Batch& t, bool is_whole = false) {
        const bool by_first = is_first_enough_ && !is_whole && routine_.leading < routine_.count;
        ++batches_;
        set_points_along(ray_.origin, ray_.direction, t, registers_);
        run(routine_, by_first ? routine_.leading : routine_.count, registers_);
        return by_first ? classify_first(routine_, registers_) : classify(routine_, is_by_own_, registers_);
    }
    HWY_INLINE Classified sample_whole(const Batch& t) { return sample(t, true); }

    // Samples a frame after the sample `before`, and finds its gaps in doubt. Returns false, leaving the frame
    // unchanged, if no sample lies strictly between `before` and `end`, because no float does.
    bool fill(Frame& f, const Batch& t, const Sample& before, float end, bool is_whole = false) {
        const Classified c = sample(t, is_whole);
        if (!(bits(less(Batch(before.t), t)) & bits(less(t, Batch(end))))) return false;
        store(t, f.t);
        store(c.distance, f.distance);
        store(c.label, f.label);
        find_doubt(f, t, c, before);
        return true;
    }
    // Finds the gaps of a frame that are in doubt. The tests run in order of cost: radii that cover the gap, the
    // curvature of the distance (as in is_free_by_curvature(), for all gaps at once), and the sign certificate.
    HWY_INLINE void find_doubt(Frame& f, const Batch& t, const Classified& c, const Sample& before) const {
        f.before = {before.t, before.distance, phase_};
        f.next = 0;
        const std::uint32_t other = bits(less(c.label, Batch(phase_))) | bits(less(Batch(phase_), c.label));
        const std::uint32_t differs = (other | (other << 1)) & all_lanes;  // at one of the gap's ends
        f.doubt = differs;
        f.phantom = 0;
        if (ray_.is_monotone) return;  // equal labels at both ends mean that the label does not change between them
        const Batch gap = t - shifted(t, before.t), covered = c.distance + shifted(c.distance, before.distance);
        std::uint32_t open = bits(less(covered, gap * ray_.slope));
        const std::uint32_t is_long = bits(less(Batch(ray_.resolution), gap));
        if (is_curvature_known_ && (open & is_long)) {
            const Batch margin(rounding_error()), zero(0.f), half_curvature(half_curvature_);
            const Batch b = max(c.distance - margin, zero),
                        a = shifted(b, larger(before.distance - rounding_error(), 0.f));
            const Batch missing = gap * gap * half_curvature - a - b;
            open &= bits(less(zero, missing)) & bits(less(a * b * 4.f, missing * missing));
        }
        if (has_certificate_ && (open & is_long))
            open &= ~certified_gaps(routine_, phase_ != routine_.outputs[0].phase, registers_, t, rounding_error());
        f.doubt |= open & is_long;
        f.phantom = open & ~is_long & ~differs;
    }

    // In search.inl.
    bool find(RayCrossing&);
    bool start(Frame&);
    bool find_phase_ahead();
    bool narrow(Frame* frames, int& depth, bool& is_aligned, RayCrossing&);
    bool search_gaps(Frame* frames, int depth, bool is_aligned, RayCrossing&);
    void pass_gaps(Frame&, int lane);
    Batch positions_around_root(const Frame&, int lane, const Sample& next) const;
    Batch positions_in_gap(const Frame&, int lane, const Sample& next) const;
    // In decide.inl.
    bool is_crossing(const Sample& next, RayCrossing&);
    bool is_entered_late(RayCrossing&);

    // Whether the distances at a gap's ends and the curvature bound prove the gap free. Between the ends, s lies above
    // its chord minus a parabola. That stays above zero if √a + √b ≥ gap·√(curvature/2); squared twice, a + b + 2√(ab)
    // ≥ gap²·curvature/2.
    bool is_free_by_curvature(float distance_here, float distance_next, float gap) const {
        if (!is_curvature_known_) return false;
        const float a = larger(distance_here - rounding_error(), 0.f),
                    b = larger(distance_next - rounding_error(), 0.f);
        const float missing = gap * gap * half_curvature_ - a - b;
        return missing <= 0 || 4 * a * b >= missing * missing;
    }
    // Whether the distances at the ends of a gap across which the label changes locate the change to within a
    // resolution. If so, reports it.
    //
    // Let g be s at `here` and −s at `next`, a and b the distances, h the gap, and −2k′ ≤ g″ ≤ 2k. Then
    //     a − (a + b)t/h − k t(h − t) ≤ g(t) ≤ a − (a + b)t/h + k′t(h − t).
    // The left side is convex, so it lies above its tangent at the chord's zero r; the right side is concave, so it
    // lies below its tangent there. So the label is that of `here` up to r − e. Here e is k r(h − r), the distance of
    // the left side below the chord, divided by the slope of its tangent, (a + b)/h + k(h − 2r). From r + e′ on, the
    // label is another one: that of `next`, unless a third component vanishes on the way there.
    //
    // In the code, r is `to_root`, h is `gap`, k and k′ are `k` and `other`, r(h − r) is `bend`, and h(h − 2r) is
    // `turn`. Both e and e′, including the rounding error, must be at most `half_bracket`. `next` is a lane of the last
    // batch of samples.
    bool is_located(const Sample& next, int lane, RayCrossing& c) const {
        if (!can_locate_ || next.label == another_phase) return false;
        const auto value = [&](const OutputSlot& o) {
            return o.sign * registers_[std::size_t{o.slot} * batch_size + static_cast<std::size_t>(lane)];
        };
        const bool is_one = is_shared(routine_);
        const float a = here_.distance, b = is_one ? next.distance : value(routine_.outputs[0]);
        const float gap = next.t - here_.t, sum = a + b;
        if (!(smaller(a, b) >= rounding_error())) return false;
        const float to_root = gap * (a / sum), half_bracket = 0.49f * ray_.resolution;
        const float bend = to_root * (gap - to_root), turn = gap * (gap - 2 * to_root);
        const float k = half_curvature_, other = other_half_curvature_;
        if (!((k * bend + rounding_error()) * gap <= half_bracket * (sum + k * turn))) return false;
        if (!((other * bend + rounding_error()) * gap <= half_bracket * (sum - other * turn))) return false;
        for (std::size_t i = 1; !is_one && i < routine_.output_count; ++i) {
            const OutputSlot& third = routine_.outputs[i];
            if (third.phase != next.label && !(value(third) >= gap - to_root + rounding_error())) return false;
        }
        return report(c, larger(here_.t + to_root - half_bracket, here_.t),
                      smaller(here_.t + to_root + half_bracket, next.t), next.label);
    }
    // Leaves the search unfinished. It can resume from the last sample that is certainly in the ray's phase.
    bool pause(RayCrossing& c) const {
        c.is_unfinished = true;
        c.t_in = certain_.t;
        c.from = phase_;
        return false;
    }
    // Distances below this, a sixteenth of the resolution, are treated as rounding errors.
    float rounding_error() const { return ray_.resolution * (1.f / 16); }

    bool report(RayCrossing& c, float t_in, float t_out, float to) const {
        c.t_in = t_in;
        c.t_out = t_out;
        c.from = phase_;
        c.to = to;
        return true;
    }
    // A sample proves that the label is constant between before(p) and past(p).
    float past(const Sample& p) const { return p.t + larger(p.distance, 0.f) / ray_.slope; }
    float before(const Sample& p) const { return p.t - larger(p.distance, 0.f) / ray_.slope; }
    void pass(const Sample& p) {
        here_ = certain_ = p;
        other_.label = no_label;
    }

    const Routine& routine_;
    const RaySegment& ray_;
    float* registers_;
    bool is_first_enough_;  // the first component alone determines where the ray leaves its phase
    bool is_by_own_;        // as Routine::is_by_own
    std::uint32_t batches_ = 0, phantoms_ = 0;
    float phase_ = 0;
    float half_curvature_ = 0;        // half the curvature bound of the distance in the ray's phase
    float other_half_curvature_ = 0;  // the same in the other phase, if can_locate_
    bool is_curvature_known_ = false;
    bool can_locate_ = false;       // one value determines where the label changes, and its curvature is known on both
                                    // sides
    bool has_certificate_ = false;  // where the curvature is unknown, a sign certificate may prove gaps free
    Sample here_{};                 // the ray is in its phase up to here
    Sample certain_{};              // the last sample whose own label is the ray's phase; usually equal to here_
    Sample other_{};                // the first sample after certain_ with the most recent other label
    float left_at_ = 0;             // the first sample after certain_ with any other label
};

}  // namespace
}  // namespace phasetree::kernel::HWY_NAMESPACE
