// The search along the gaps between samples (March). Included by kernel.inl.

namespace phasetree::kernel::HWY_NAMESPACE {
namespace {

// Finds the first crossing; returns whether there is one. If the ray's phase is nowhere near the start, the crossing is
// at the start and has zero length.
bool March::find(RayCrossing& result) {
    Frame frames[deepest];
    if (!start(frames[0])) return false;
    int depth = 1;           // the number of frames in use
    bool is_aligned = true;  // whether `here` is the sample before the next gap of the last frame
    if (here_.label != phase_) {
        if (!find_phase_ahead())
            return is_entered_late(result) || report(result, ray_.t_begin, ray_.t_begin, here_.label);
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
        is_curvature_known_ = half_curvature_ < 1e30f &&
                              (routine_.outputs[0].phase != phase_ || routine_.output_count == 2 || is_by_own_);
        other_half_curvature_ = 0.5f * ray_.curvature[routine_.outputs[0].phase == phase_ ? 1 : 0];
        can_locate_ = is_curvature_known_ && other_half_curvature_ < 1e30f &&
                      (is_shared(routine_) || (is_first_enough_ && routine_.is_by_first));
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
            if (is_located(next, lane, result)) return true;
            if (!fill(frames[depth], positions_around_root(f, lane, next), here_, next.t, true)) break;
            ++depth;
            continue;
        }
        ++f.next;
        if (is_crossing(next, result)) return true;
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
        if (batches_ >= most_batches) return pause(result);
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
        } else if (is_crossing(next, result)) {
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

}  // namespace
}  // namespace phasetree::kernel::HWY_NAMESPACE
