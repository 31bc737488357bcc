// Decides what counts as a crossing where rounding errors determine the labels (March). Included by kernel.inl.

namespace phasetree::kernel::HWY_NAMESPACE {
namespace {

// Whether the change of label at `next` is a crossing. If so, reports it; if not, advances `here` as far as its label
// is known.
//
// Labels are unreliable within the rounding error of an interface. Slivers of other phases appear between abutting
// solids, and the label flickers along a face. So a change counts only once it is decided: when s(p) exceeds the
// rounding error, or when the ray's phase has not been sampled for one and a half resolutions. Until then, the ray
// stays in its phase.
//
// The bracket goes from the last sample in the ray's phase to the first sample in the phase that follows. It is at most
// 2.75 resolutions long: a gap of one before the first sample in another phase, the one and a half, and another quarter
// to the next sample if a rounding error hides that one and a half has been reached.
bool March::is_crossing(const Sample& next, RayCrossing& result) {
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
bool March::is_entered_late(RayCrossing& result) {
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
    const float way_back = smaller(ray_.before, 4 * resolution);
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
