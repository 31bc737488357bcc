/// Multiphase sphere tracing with a batch of points *along the one ray*. Included by kernel.inl.
///
/// We hold a place `here` that is certainly in the ray's phase, and frames of eight samples ahead of it, the last
/// frame lying in a gap of the one before. Two neighbours of the ray's phase whose radii together cover the gap between
/// them prove the gap free; that is one comparison for a whole frame. The first gap in doubt is sampled again, eight
/// points inside it: evenly; or, where the label differs at its end, gathered around the place where the distances
/// predict the interface; or, where the ray starts on an interface, spread out geometrically from there. A gap no
/// longer than the resolution is either the crossing or, with equal labels, passed.
///
/// Where samples are taken: places.inl.
///
/// A hit is a change of label, never a small distance: phantom zeros, where components vanish without a change, cost
/// samples but are never hits.

namespace phasetree::HWY_NAMESPACE {
namespace {

/// Eight samples in rising order, and the place that the frame starts from.
struct alignas(64) Frame {
    float t[batch_size];
    float distance[batch_size];  ///< s(p): the label is the same within this radius
    float label[batch_size];
    Place from;
    std::uint32_t doubt;    ///< bit i: the gap that ends at lane i is not proven free
    std::uint32_t phantom;  ///< bit i: it is free only because it is no longer than the resolution
    int next;               ///< the first lane that is not passed yet

    Frame() {}  // unset on purpose: most rays use one or two
    Place place(int lane) const { return lane < 0 ? from : Place{t[lane], distance[lane], label[lane]}; }
};

/// A piece of a ray: origin + t·direction, from ≤ t ≤ length.
struct RaySegment {
    float origin[3];
    float direction[3];
    float length;
    float from;
    float behind;  ///< how far before 0 the ray has come from
    float resolution;
    float slope;         ///< bounds what a component changes by for each unit along the ray
    float curvature[2];  ///< as Visit has it
    float carried;       ///< the phase that the ray is in; negative: the label at its start
    bool is_monotone;    ///< there is one component, and it only grows or only falls along the ray
    bool on_interface;   ///< the ray most likely starts on one: a hint where to look first
};

class March {
  public:
    March(const Routine& routine, const RaySegment& ray, float* registers)
        : routine_(routine),
          ray_(ray),
          registers_(registers),
          is_alone_(routine.leading > 0 && routine.outputs[0].phase == ray.carried),
          is_by_own_(is_alone_ || routine.is_by_own) {}  // both tell the distance in the same way

    bool search(RayCrossing& crossing) {
        const bool hit = find(crossing);
        crossing.length = ray_.length;
        crossing.batches = batches_;
        crossing.phantoms = phantoms_;
        return hit;
    }

  private:
    static constexpr float none = -1;  ///< no label
    /// After so many the search pauses: most rays that take so many creep along an interface (trace/creep.hpp).
    static constexpr std::uint32_t most_batches = 256;

    /// By the first component alone, if that is enough, labels are the ray's phase or another_phase.
    HWY_INLINE Classified sample(const Batch& t, bool is_whole = false) {
        const bool is_alone = is_alone_ && !is_whole && routine_.leading < routine_.count;
        ++batches_;
        place_along(ray_.origin, ray_.direction, t, registers_);
        run(routine_, is_alone ? routine_.leading : routine_.count, registers_);
        return is_alone ? classify_first(routine_, registers_) : classify(routine_, is_by_own_, registers_);
    }
    HWY_INLINE Classified sample_whole(const Batch& t) { return sample(t, true); }

    /// Samples a frame, and finds out which of its gaps are in doubt; the first one is from `from`. False, and nothing
    /// done, if no sample is strictly between `from` and `to`: no float lies there.
    bool fill(Frame& f, const Batch& t, const Place& from, float to, bool is_whole = false) {
        const Classified c = sample(t, is_whole);
        if (!(bits(less(Batch(from.t), t)) & bits(less(t, Batch(to))))) return false;
        store(t, f.t);
        store(c.distance, f.distance);
        store(c.label, f.label);
        judge(f, t, c, from);
        return true;
    }
    HWY_INLINE void judge(Frame& f, const Batch& t, const Classified& c, const Place& from) const {
        f.from = {from.t, from.distance, phase_};
        f.next = 0;
        const std::uint32_t other = bits(less(c.label, Batch(phase_))) | bits(less(Batch(phase_), c.label));
        const std::uint32_t differs = (other | (other << 1)) & all_lanes;  // at one of the gap's ends
        f.doubt = differs;
        f.phantom = 0;
        if (ray_.is_monotone) return;  // between two places of one label it stays
        const Batch gap = t - shifted(t, from.t), covered = c.distance + shifted(c.distance, from.distance);
        std::uint32_t open = bits(less(covered, gap * ray_.slope));
        const std::uint32_t is_long = bits(less(Batch(ray_.resolution), gap));
        if (is_curvature_known_ && (open & is_long)) {
            const Batch margin(rounding()), zero(0.f), half_curvature(half_curvature_);
            const Batch b = max(c.distance - margin, zero), a = shifted(b, larger(from.distance - rounding(), 0.f));
            const Batch missing = gap * gap * half_curvature - a - b;
            open &= bits(less(zero, missing)) & bits(less(a * b * 4.f, missing * missing));
        }
        if (is_provable_ && (open & is_long))
            open &= ~proven(routine_, phase_ != routine_.outputs[0].phase, registers_, t, rounding());
        f.doubt |= open & is_long;
        f.phantom = open & ~is_long & ~differs;
    }

    bool find(RayCrossing&);
    /// Whether a change of label at `next` is one, and then where; if not, goes on to where that is known.
    bool is_crossing(const Place& next, RayCrossing&);
    /// Whether a ray that starts within rounding of where it crossed came in a little before, and then where.
    bool is_entered_late(RayCrossing&);
    Batch narrowing(const Frame&, int lane, const Place& next) const;
    Batch look_ahead(const Frame&, int lane, const Place& next) const;

    /// Whether the distances at a gap's ends prove it free by how much s bends. Between them s is above the chord less
    /// a parabola, and that stays above zero if √a + √b ≥ gap·√(curvature/2); squared twice, a + b + 2√(ab) ≥
    /// gap²·curvature/2.
    bool is_bridged(float from, float to, float gap) const {
        if (!is_curvature_known_) return false;
        const float a = larger(from - rounding(), 0.f), b = larger(to - rounding(), 0.f);
        const float missing = gap * gap * half_curvature_ - a - b;
        return missing <= 0 || 4 * a * b >= missing * missing;
    }
    /// Whether the distances at a gap's ends, between which the label changes, tell where within a resolution; and then
    /// that. With g = s at `here` and −s at `next`, the distances a and b, the gap h, and g″ between −2k′ and 2k,
    ///     a − (a + b)t/h − k t(h − t) ≤ g(t) ≤ a − (a + b)t/h + k′t(h − t),
    /// and what is convex on the left is above its tangent at the chord's zero r, what is concave on the right below.
    /// So the label is that of `here` up to r − e, with e the left's k r(h − r) over its tangent's slope, (a + b)/h +
    /// k(h − 2r); and from r + e′ on it is another: that of `next`, if no third component vanishes on the way there.
    /// `next` is a lane of what was sampled last.
    bool is_pinned(const Place& next, int lane, RayCrossing& c) const {
        if (!is_pinnable_ || next.label == another_phase) return false;
        const auto value = [&](const OutputSlot& o) {
            return o.sign * registers_[std::size_t{o.slot} * batch_size + static_cast<std::size_t>(lane)];
        };
        const bool is_one = is_shared(routine_);
        const float a = here_.distance, b = is_one ? next.distance : value(routine_.outputs[0]);
        const float gap = next.t - here_.t, sum = a + b;
        if (!(smaller(a, b) >= rounding())) return false;
        const float root = gap * (a / sum), reach = 0.49f * ray_.resolution;
        const float bend = root * (gap - root), turn = gap * (gap - 2 * root);
        const float k = half_curvature_, other = other_half_curvature_;
        if (!((k * bend + rounding()) * gap <= reach * (sum + k * turn))) return false;
        if (!((other * bend + rounding()) * gap <= reach * (sum - other * turn))) return false;
        for (std::size_t i = 1; !is_one && i < routine_.output_count; ++i) {
            const OutputSlot& third = routine_.outputs[i];
            if (third.phase != next.label && !(value(third) >= gap - root + rounding())) return false;
        }
        return report(c, larger(here_.t + root - reach, here_.t), smaller(here_.t + root + reach, next.t), next.label);
    }
    /// To be gone on with from the last place that is certainly in the ray's phase.
    bool pause(RayCrossing& c) const {
        c.is_unfinished = true;
        c.t_in = certain_.t;
        c.from = phase_;
        return false;
    }
    /// Of distances.
    float rounding() const { return ray_.resolution * (1.f / 16); }

    bool report(RayCrossing& c, float t_in, float t_out, float to) const {
        c.t_in = t_in;
        c.t_out = t_out;
        c.from = phase_;
        c.to = to;
        return true;
    }
    /// Up to where, and from where on, a place proves that there is no change.
    float past(const Place& p) const { return p.t + larger(p.distance, 0.f) / ray_.slope; }
    float before(const Place& p) const { return p.t - larger(p.distance, 0.f) / ray_.slope; }
    void pass(const Place& p) {
        here_ = certain_ = p;
        other_.label = none;
    }

    const Routine& routine_;
    const RaySegment& ray_;
    float* registers_;
    bool is_alone_;  ///< the first component is enough
    bool is_by_own_;
    std::uint32_t batches_ = 0, phantoms_ = 0;
    float phase_ = 0;
    float half_curvature_ = 0;        ///< of the distance in the ray's phase
    float other_half_curvature_ = 0;  ///< and in the other, if it is pinnable
    bool is_curvature_known_ = false;
    bool is_pinnable_ = false;  ///< one value tells where the label changes, and how it curves both ways
    bool is_provable_ = false;  ///< else by a certificate
    Place here_{};              ///< all up to here is in the ray's phase
    Place certain_{};           ///< the last place whose own label is the ray's phase; mostly `here`
    Place other_{};             ///< after it, the first place of the label that is there now
    float left_ = 0;            ///< and where that was another for the first time
};

bool March::find(RayCrossing& result) {
    const float length = ray_.length, resolution = ray_.resolution;
    constexpr int deepest = 24;
    Frame frames[deepest];

    // The start, and the first frame behind it.
    for (;;) {
        const bool is_curvature_known = ray_.curvature[routine_.outputs[0].phase == ray_.carried ? 0 : 1] < 1e30f;
        const Batch t = ray_.on_interface && !ray_.is_monotone && !is_curvature_known
                            ? spread_from_interface(length, resolution)
                            : spread_evenly(ray_.from, length);
        const Classified c = sample(t);
        Frame& f = frames[0];
        store(t, f.t);
        store(c.distance, f.distance);
        store(c.label, f.label);
        here_ = f.place(0);
        phase_ = ray_.carried >= 0 ? ray_.carried : here_.label;
        if (is_alone_ && here_.label != phase_) {
            is_alone_ = false;  // what it is in must be known
            continue;
        }
        half_curvature_ = 0.5f * ray_.curvature[routine_.outputs[0].phase == phase_ ? 0 : 1];
        is_curvature_known_ = half_curvature_ < 1e30f &&
                              (routine_.outputs[0].phase != phase_ || routine_.output_count == 2 || is_by_own_);
        other_half_curvature_ = 0.5f * ray_.curvature[routine_.outputs[0].phase == phase_ ? 1 : 0];
        is_pinnable_ = is_curvature_known_ && other_half_curvature_ < 1e30f &&
                       (is_shared(routine_) || (is_alone_ && routine_.is_by_first));
        is_provable_ = !is_curvature_known_ && routine_.certificate_steps > 0 &&
                       (routine_.outputs[0].phase == phase_ || is_shared(routine_));
        other_.label = none;
        judge(f, t, c, here_);
        if (f.doubt == 0) return false;
        f.next = 1;
        break;
    }
    bool is_aligned = true;  // `here` is the place before the last frame's next lane
    int depth = 1;           // frames in use

    if (here_.label != phase_) {
        // Rounding may have put the start just across the interface it was found on: look a little ahead.
        const Batch t = Batch(ray_.from) + (lanes() + 1.f) * (resolution * (4.f / batch_size));
        const Classified c = sample(t);
        const std::uint32_t other = bits(less(c.label, Batch(phase_))) | bits(less(Batch(phase_), c.label));
        const std::uint32_t back = ~other & ~bits(less(Batch(length), t)) & all_lanes;
        if (!back) return is_entered_late(result) || report(result, ray_.from, ray_.from, here_.label);
        alignas(64) float near[batch_size], distance[batch_size];
        store(t, near);
        store(c.distance, distance);
        const int found = __builtin_ctz(back);
        here_ = {near[found], distance[found], phase_};
        is_aligned = false;
    }
    certain_ = here_;

    // Mostly the label changes at the end of the first gap in doubt, and so on until that is short enough: what the
    // loop below does, without what else it has to ask.
    while (is_aligned && depth < deepest) {
        Frame& f = frames[depth - 1];
        const std::uint32_t ahead = f.doubt >> f.next;
        if (!ahead) break;
        const int lane = f.next + __builtin_ctz(ahead);
        const Place next = f.place(lane);
        if (next.label == phase_ || !(next.t > here_.t)) break;
        if (lane > f.next) {
            const std::uint32_t passed = f.phantom & ((1u << lane) - (1u << f.next));
            phantoms_ += static_cast<std::uint32_t>(__builtin_popcount(passed));
            pass(f.place(lane - 1));
            f.next = lane;
        }
        if (next.t - here_.t > resolution) {
            if (is_pinned(next, lane, result)) return true;
            if (!fill(frames[depth], narrowing(f, lane, next), here_, next.t, true)) break;
            ++depth;
            continue;
        }
        ++f.next;
        if (is_crossing(next, result)) return true;
        ++phantoms_;
        is_aligned = false;
    }

    for (;;) {
        if (batches_ >= most_batches) return pause(result);
        if (depth == 0) {
            if (here_.t >= length) return false;
            if (!fill(frames[0], spread_evenly(here_.t, length), here_, 3.402823466e38f)) return false;
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
            if (lane > f.next) {
                const std::uint32_t passed = f.phantom & ((1u << lane) - (1u << f.next));
                phantoms_ += static_cast<std::uint32_t>(__builtin_popcount(passed));
                pass(f.place(lane - 1));
                f.next = lane;
            }
        }
        if (f.next == end) {
            --depth;
            is_aligned = false;
            continue;
        }

        const Place next = f.place(f.next);
        const bool same = next.label == phase_;
        const float gap = next.t - here_.t;
        const float low = past(here_), high = before(next);
        const bool is_covered = same && (ray_.is_monotone || here_.distance + next.distance >= gap * ray_.slope ||
                                         is_bridged(here_.distance, next.distance, gap));
        const bool is_resolved = is_covered || gap <= resolution || (same && high - low <= resolution);
        if (!is_resolved) {
            // Where frames are used up, what lies ahead of this gap is forgotten, and not the gap, which would come
            // again.
            const int deeper = depth < deepest ? depth : 0;
            const Batch t = look_ahead(f, is_aligned ? f.next : -1, next);
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

/// Where to sample in the gap from `here` to next, where the label is another; for `lane` see look_ahead().
HWY_INLINE Batch March::narrowing(const Frame& f, int lane, const Place& next) const {
    const bool has_before = lane >= 1, has_after = lane >= 0 && lane + 1 < static_cast<int>(batch_size);
    const Place before = has_before ? f.place(lane - 2) : here_, after = has_after ? f.place(lane + 1) : next;
    const float root = predicted_root(here_, next, before, after);
    // A certificate speaks of what is between samples.
    return gather_around(smaller(larger(root, here_.t), next.t), here_.t, next.t, 0.49f * ray_.resolution,
                         is_provable_);
}

/// Where to sample in the gap from `here` to next, which is the given lane of a frame if `here` is the place before it.
Batch March::look_ahead(const Frame& f, int lane, const Place& next) const {
    if (next.label != phase_) return narrowing(f, lane, next);
    const float gap = next.t - here_.t;
    if (const float slope = (next.distance - here_.distance) / gap; slope > 0.02f) {
        // The ray leaves an interface it started on, at a low angle: one frame for many of the gaps ahead.
        return spread_growing(here_.t, ray_.length, larger(here_.distance, 0.25f * ray_.resolution),
                              smaller(slope, 1.f));
    }
    const float low = past(here_), high = before(next);
    return spread_evenly(smaller(low, high), high);
}

/// Within rounding of an interface labels mean little: solids that abut leave slivers, and a ray along a face flickers.
/// So a change counts once it is decided: s(p) above rounding, or no place in the ray's phase for one and a half
/// resolutions. Until then the ray stays in its phase. The bracket is from the last place in it to the first one in the
/// phase that follows.
bool March::is_crossing(const Place& next, RayCrossing& result) {
    const float resolution = ray_.resolution;
    const auto is_decided = [&](const Place& p) {
        if (other_.label == none) left_ = p.t;
        if (other_.label != p.label) other_ = p;
        return p.distance >= rounding() || p.t - left_ >= 1.5f * resolution;
    };
    const bool is_known = next.label != another_phase;
    if (is_known && is_decided(next)) return report(result, certain_.t, other_.t, other_.label);
    alignas(64) float beyond[batch_size], label[batch_size], distance[batch_size];
    const Batch t =
        min(Batch(next.t) + (lanes() + (is_known ? 1.f : 0.f)) * (resolution * (2.f / batch_size)), Batch(ray_.length));
    const Classified c = sample_whole(t);
    store(t, beyond);
    store(c.label, label);
    store(c.distance, distance);
    for (std::size_t i = 0; i < batch_size; ++i) {
        const Place p{beyond[i], distance[i], label[i]};
        here_ = {p.t, p.distance, phase_};
        if (p.label == phase_) {
            certain_ = here_;
            other_.label = none;
            if (p.distance >= rounding()) break;
        } else if (is_decided(p)) {
            return report(result, certain_.t, other_.t, other_.label);
        }
    }
    return false;
}

/// Along a face where labels flicker another cell may have seen the ray in its phase still, and this one not. Looks for
/// where it was, a few resolutions back: farther from the cell its program means nothing.
bool March::is_entered_late(RayCrossing& result) {
    const float resolution = ray_.resolution;
    alignas(64) float t[batch_size], label[batch_size];
    const auto look = [&](const Batch& where) {
        store(where, t);
        store(sample_whole(where).label, label);
    };
    constexpr float size = static_cast<float>(batch_size);
    Place in{0, 0, none}, out{0, 0, here_.label};
    const float back = smaller(ray_.behind, 4 * resolution);
    if (!(back > 0)) return false;
    look((lanes() + 1.f) * (-back / size));
    for (std::size_t i = 0; i < batch_size && in.label == none; ++i)
        (label[i] == phase_ ? in : out) = {t[i], 0, label[i]};
    if (in.label == none) return false;
    while (out.t - in.t > resolution) {
        const float low = in.t, step = (out.t - low) / (size + 1);
        look(Batch(low) + (lanes() + 1.f) * step);
        if (!(t[0] > low)) break;  // no float lies between
        for (std::size_t i = batch_size; i-- > 0 && in.t == low;) (label[i] == phase_ ? in : out) = {t[i], 0, label[i]};
    }
    return report(result, in.t, out.t, out.label);
}

}  // namespace
}  // namespace phasetree::HWY_NAMESPACE
