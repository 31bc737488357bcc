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
// The file has three parts: the class, with the tests that prove gaps free; the search along the gaps; and what counts
// as a crossing where rounding errors determine the labels.

namespace phasetree::kernel::HWY_NAMESPACE {
namespace {

class March {
  public:
    March(const Routine& routine, const RaySegment& ray, float* registers)
        : routine_(routine),
          ray_(ray),
          registers_(registers),
          is_first_enough_(routine.first_component_steps > 0 && routine.outputs[0].phase == ray.carried),
          // Both take the distance from the phase's own component.
          uses_own_component_(is_first_enough_ || routine.uses_own_component) {}

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
    static constexpr std::uint32_t max_batches = 256;
    // The number of frames on the stack. Each lies within a gap of the frame below, which is at most about a fifth of
    // that frame's length.
    static constexpr int deepest = 24;

    // Samples the ray. If the first component is enough, only that is evaluated, and each label is either the ray's
    // phase or another_phase. `is_whole` requests all components.
    HWY_INLINE Classified sample(const Batch& t, bool is_whole = false) {
        const bool by_first = is_first_enough_ && !is_whole && routine_.first_component_steps < routine_.count;
        ++batches_;
        set_points_along(ray_.origin, ray_.direction, t, registers_);
        run(routine_, by_first ? routine_.first_component_steps : routine_.count, registers_);
        return by_first ? classify_first(routine_, registers_) : classify(routine_, uses_own_component_, registers_);
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

    // The search along the gaps.
    bool find(RayCrossing&);
    bool start(Frame&);
    bool find_phase_ahead();
    bool narrow(Frame* frames, int& depth, bool& is_aligned, RayCrossing&);
    bool search_gaps(Frame* frames, int depth, bool is_aligned, RayCrossing&);
    void pass_gaps(Frame&, int lane);
    Batch positions_around_root(const Frame&, int lane, const Sample& next) const;
    Batch positions_in_gap(const Frame&, int lane, const Sample& next) const;
    // What counts as a crossing.
    bool decide_crossing(const Sample& next, RayCrossing&);
    bool find_late_entry(RayCrossing&);

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
    // Reports the crossing in a gap across which the label changes, if the distances at its ends locate it to within a
    // resolution. Returns whether they do.
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
    bool locate_crossing(const Sample& next, int lane, RayCrossing& c) const {
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
        c.t_from = certain_.t;
        c.from = phase_;
        return false;
    }
    // Distances below this, a sixteenth of the resolution, are treated as rounding errors.
    float rounding_error() const { return ray_.resolution * (1.f / 16); }

    bool report(RayCrossing& c, float t_from, float t_to, float to) const {
        c.t_from = t_from;
        c.t_to = t_to;
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
    bool is_first_enough_;     // the first component alone determines where the ray leaves its phase
    bool uses_own_component_;  // as Routine::uses_own_component
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

// --- The search along the gaps between samples ---

// Finds the first crossing; returns whether there is one. If the ray's phase is nowhere near the start, the crossing is
// at the start and has zero length.
bool March::find(RayCrossing& result) {
    Frame frames[deepest];
    if (!start(frames[0])) return false;
    int depth = 1;           // the number of frames in use
    bool is_aligned = true;  // whether `here` is the sample before the next gap of the last frame
    if (here_.label != phase_) {
        if (!find_phase_ahead())
            return find_late_entry(result) || report(result, ray_.t_begin, ray_.t_begin, here_.label);
        is_aligned = false;
    }
    certain_ = here_;
    if (narrow(frames, depth, is_aligned, result)) return true;
    return search_gaps(frames, depth, is_aligned, result);
}

// Samples the whole segment. Sets `here` to its start, and determines the ray's phase. Returns whether any gap is in
// doubt.
HWY_INLINE bool March::start(Frame& f) {
    for (;;) {
        const bool is_bound_known = ray_.curvature[routine_.outputs[0].phase == ray_.carried ? 0 : 1] < 1e30f;
        const Batch t = ray_.on_interface && !ray_.is_monotone && !is_bound_known
                            ? spaced_from_interface(ray_.length, ray_.resolution)
                            : evenly_spaced(ray_.t_begin, ray_.length);
        const Classified c = sample(t);
        store(t, f.t);
        store(c.distance, f.distance);
        store(c.label, f.label);
        here_ = f.sample(0);
        phase_ = ray_.carried >= 0 ? ray_.carried : here_.label;
        if (is_first_enough_ && here_.label != phase_) {
            is_first_enough_ = false;  // the start is in another phase; all components are needed to find out which
            continue;
        }
        half_curvature_ = 0.5f * ray_.curvature[routine_.outputs[0].phase == phase_ ? 0 : 1];
        is_curvature_known_ = half_curvature_ < 1e30f && (routine_.outputs[0].phase != phase_ ||
                                                          routine_.output_count == 2 || uses_own_component_);
        other_half_curvature_ = 0.5f * ray_.curvature[routine_.outputs[0].phase == phase_ ? 1 : 0];
        can_locate_ = is_curvature_known_ && other_half_curvature_ < 1e30f &&
                      (is_shared(routine_) || (is_first_enough_ && routine_.first_component_decides));
        has_certificate_ = !is_curvature_known_ && routine_.certificate_steps > 0 &&
                           (routine_.outputs[0].phase == phase_ || is_shared(routine_));
        other_.label = no_label;
        find_doubt(f, t, c, here_);
        f.next = 1;  // gap 0 is empty, because `here` is the first sample
        return f.doubt != 0;
    }
}

// Rounding may have moved the start slightly across the interface on which the ray was found. Looks for the ray's phase
// in the next four resolutions, and moves `here` to where it begins. Returns whether it was found.
HWY_INLINE bool March::find_phase_ahead() {
    const Batch t = Batch(ray_.t_begin) + (lanes() + 1.f) * (ray_.resolution * (4.f / batch_size));
    const Classified c = sample(t);
    const std::uint32_t other = bits(less(c.label, Batch(phase_))) | bits(less(Batch(phase_), c.label));
    const std::uint32_t regained = ~other & ~bits(less(Batch(ray_.length), t)) & all_lanes;
    if (!regained) return false;
    alignas(64) float ahead[batch_size], distance[batch_size];
    store(t, ahead);
    store(c.distance, distance);
    const int found = __builtin_ctz(regained);
    here_ = {ahead[found], distance[found], phase_};
    return true;
}

// Passes the gaps of a frame before the given lane, which are free.
HWY_INLINE void March::pass_gaps(Frame& f, int lane) {
    const std::uint32_t passed = f.phantom & ((1u << lane) - (1u << f.next));
    phantoms_ += static_cast<std::uint32_t>(__builtin_popcount(passed));
    pass(f.sample(lane - 1));
    f.next = lane;
}

// A fast path for the usual case of search_gaps(): the label changes at the end of the first gap in doubt, and again
// within that gap, until the gap is short enough. Returns whether a crossing was found; if not, search_gaps()
// continues.
HWY_INLINE bool March::narrow(Frame* frames, int& depth, bool& is_aligned, RayCrossing& result) {
    while (is_aligned && depth < deepest) {
        Frame& f = frames[depth - 1];
        const std::uint32_t ahead = f.doubt >> f.next;
        if (!ahead) break;
        const int lane = f.next + __builtin_ctz(ahead);
        const Sample next = f.sample(lane);
        if (next.label == phase_ || !(next.t > here_.t)) break;
        if (lane > f.next) pass_gaps(f, lane);
        if (next.t - here_.t > ray_.resolution) {
            if (locate_crossing(next, lane, result)) return true;
            if (!fill(frames[depth], positions_around_root(f, lane, next), here_, next.t, true)) break;
            ++depth;
            continue;
        }
        ++f.next;
        if (decide_crossing(next, result)) return true;
        ++phantoms_;
        is_aligned = false;
    }
    return false;
}

// Goes from gap to gap: passes those that are free or no longer than the resolution, and samples the others again,
// until it finds a crossing or the segment ends. Returns whether there is a crossing.
HWY_INLINE bool March::search_gaps(Frame* frames, int depth, bool is_aligned, RayCrossing& result) {
    const float length = ray_.length, resolution = ray_.resolution;
    for (;;) {
        if (batches_ >= max_batches) return pause(result);
        if (depth == 0) {
            if (here_.t >= length) return false;
            if (!fill(frames[0], evenly_spaced(here_.t, length), here_, 3.402823466e38f)) return false;
            depth = 1;
            is_aligned = true;
        }
        Frame& f = frames[depth - 1];
        constexpr int end = static_cast<int>(batch_size);
        while (f.next < end && f.t[f.next] <= here_.t) {
            ++f.next;
            is_aligned = false;
        }
        if (is_aligned) {
            const std::uint32_t ahead = f.next < end ? f.doubt >> f.next : 0;
            const int lane = ahead ? f.next + __builtin_ctz(ahead) : end;
            if (lane > f.next) pass_gaps(f, lane);
        }
        if (f.next == end) {
            --depth;
            is_aligned = false;
            continue;
        }

        const Sample next = f.sample(f.next);
        const bool same = next.label == phase_;
        const float gap = next.t - here_.t;
        const float low = past(here_), high = before(next);
        const bool is_covered = same && (ray_.is_monotone || here_.distance + next.distance >= gap * ray_.slope ||
                                         is_free_by_curvature(here_.distance, next.distance, gap));
        const bool is_resolved = is_covered || gap <= resolution || (same && high - low <= resolution);
        if (!is_resolved) {
            // If all frames are in use, restart the search with this gap in the first frame, and discard the samples
            // ahead of the gap. The search cannot skip a gap that is in doubt.
            const int deeper = depth < deepest ? depth : 0;
            const Batch t = positions_in_gap(f, is_aligned ? f.next : -1, next);
            if (fill(frames[deeper], t, here_, next.t, !same)) {
                depth = deeper + 1;
                is_aligned = true;
                continue;
            }
        }
        ++f.next;
        if (same) {
            if (!is_covered) ++phantoms_;
            pass(next);
            is_aligned = true;
        } else if (decide_crossing(next, result)) {
            return true;
        } else {
            ++phantoms_;
            is_aligned = false;
        }
    }
}

// Where to sample in the gap from `here` to `next` if the label changes at its end. `lane` is as in positions_in_gap().
HWY_INLINE Batch March::positions_around_root(const Frame& f, int lane, const Sample& next) const {
    const bool has_before = lane >= 1, has_after = lane >= 0 && lane + 1 < static_cast<int>(batch_size);
    const Sample before = has_before ? f.sample(lane - 2) : here_, after = has_after ? f.sample(lane + 1) : next;
    const float root = predicted_root(here_, next, before, after);
    // A certificate only proves gaps between two samples of a frame. So if there is one, the first sample is at `here`:
    // gap 0, about which the certificate says nothing, is then empty.
    return gather_around(smaller(larger(root, here_.t), next.t), here_.t, next.t, 0.49f * ray_.resolution,
                         has_certificate_);
}

// Where to sample in the gap from `here` to `next`. `lane` is the lane of `next` if `here` is the sample before it in a
// frame, otherwise −1.
Batch March::positions_in_gap(const Frame& f, int lane, const Sample& next) const {
    if (next.label != phase_) return positions_around_root(f, lane, next);
    const float gap = next.t - here_.t;
    if (const float slope = (next.distance - here_.distance) / gap; slope > 0.02f) {
        // The ray leaves an interface on which it started, at a grazing angle. A single frame passes many of the gaps
        // ahead.
        return spaced_growing(here_.t, ray_.length, larger(here_.distance, 0.25f * ray_.resolution),
                              smaller(slope, 1.f));
    }
    const float low = past(here_), high = before(next);
    return evenly_spaced(smaller(low, high), high);
}

// --- What counts as a crossing where rounding errors determine the labels ---

// Decides whether the change of label at `next` is a crossing. If so, reports it and returns true; if not, advances
// `here` as far as its label is known.
//
// Labels are unreliable within the rounding error of an interface. Slivers of other phases appear between abutting
// solids, and the label flickers along a face. So a change counts only once it is decided: when s(p) exceeds the
// rounding error, or when the ray's phase has not been sampled for one and a half resolutions. Until then, the ray
// stays in its phase.
//
// The bracket goes from the last sample in the ray's phase to the first sample in the phase that follows. It is at most
// 2.75 resolutions long: a gap of one before the first sample in another phase, the one and a half, and another quarter
// to the next sample if a rounding error hides that one and a half has been reached.
bool March::decide_crossing(const Sample& next, RayCrossing& result) {
    const float resolution = ray_.resolution;
    // Records a sample in another phase. Returns whether it decides the change.
    const auto note_other = [&](const Sample& p) {
        if (other_.label == no_label) left_at_ = p.t;
        if (other_.label != p.label) other_ = p;
        return p.distance >= rounding_error() || p.t - left_at_ >= 1.5f * resolution;
    };
    const bool is_known = next.label != another_phase;
    if (is_known && note_other(next)) return report(result, certain_.t, other_.t, other_.label);
    alignas(64) float beyond[batch_size], label[batch_size], distance[batch_size];
    // Eight samples, a quarter of a resolution apart. They start after `next`, or at `next` itself if only its first
    // component was evaluated, so that its phase is known only not to be the ray's.
    const Batch t =
        min(Batch(next.t) + (lanes() + (is_known ? 1.f : 0.f)) * (resolution * (2.f / batch_size)), Batch(ray_.length));
    const Classified c = sample_whole(t);
    store(t, beyond);
    store(c.label, label);
    store(c.distance, distance);
    for (std::size_t i = 0; i < batch_size; ++i) {
        const Sample p{beyond[i], distance[i], label[i]};
        here_ = {p.t, p.distance, phase_};
        if (p.label == phase_) {
            certain_ = here_;
            other_.label = no_label;
            if (p.distance >= rounding_error()) break;
        } else if (note_other(p)) {
            return report(result, certain_.t, other_.t, other_.label);
        }
    }
    return false;
}

// Called if a ray does not start in the phase that it carries. Searches the last few resolutions before the start for a
// point in that phase; if there is one, reports the crossing there. This happens along a face where labels flicker: the
// previous cell may still have seen the ray in its phase. The search goes back no farther, because a cell's program is
// valid only in the cell and slightly beyond.
bool March::find_late_entry(RayCrossing& result) {
    const float resolution = ray_.resolution;
    alignas(64) float t[batch_size], label[batch_size];
    const auto look = [&](const Batch& where) {
        store(where, t);
        store(sample_whole(where).label, label);
    };
    constexpr float size = static_cast<float>(batch_size);
    // `in` is the last sample found in the ray's phase, and `out` the first sample after it that is not. First move
    // backwards from the start until a sample qualifies as `in`; then subdivide the interval between the two.
    Sample in{0, 0, no_label}, out{0, 0, here_.label};
    const float way_back = smaller(ray_.before, look_back_resolutions * resolution);
    if (!(way_back > 0)) return false;
    look((lanes() + 1.f) * (-way_back / size));
    for (std::size_t i = 0; i < batch_size && in.label == no_label; ++i)
        (label[i] == phase_ ? in : out) = {t[i], 0, label[i]};
    if (in.label == no_label) return false;
    while (out.t - in.t > resolution) {
        const float low = in.t, step = (out.t - low) / (size + 1);
        look(Batch(low) + (lanes() + 1.f) * step);
        if (!(t[0] > low)) break;  // no float lies in between
        for (std::size_t i = batch_size; i-- > 0 && in.t == low;) (label[i] == phase_ ? in : out) = {t[i], 0, label[i]};
    }
    return report(result, in.t, out.t, out.label);
}

}  // namespace
}  // namespace phasetree::kernel::HWY_NAMESPACE
