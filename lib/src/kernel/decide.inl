// What counts as a crossing where labels are a matter of rounding errors (March). Included by kernel.inl.

namespace phasetree::kernel::HWY_NAMESPACE {
namespace {

// Whether the change of label at `next` is a crossing; if so, reports it, and if not, moves `here` on to where that is
// known.
//
// Within the rounding error of an interface labels mean little: between solids that abut there are slivers of other
// phases, and along a face the label flickers. So a change counts only once it is decided: once s(p) is above the
// rounding error, or once there was no sample in the ray's phase for one and a half resolutions. Until then the ray
// stays in its phase. The bracket goes from the last sample in that phase to the first one in the phase that follows.
// So it is at most 2.75 resolutions long: a gap of one before the first sample in another phase, the one and a half,
// and a quarter more to the next sample if a rounding error hides that the one and a half are full.
bool March::is_crossing(const Sample& next, RayCrossing& result) {
    const float resolution = ray_.resolution;
    // Takes note of a sample in another phase; returns whether the change is decided with it.
    const auto note_other = [&](const Sample& p) {
        if (other_.label == no_label) left_at_ = p.t;
        if (other_.label != p.label) other_ = p;
        return p.distance >= rounding_error() || p.t - left_at_ >= 1.5f * resolution;
    };
    const bool is_known = next.label != another_phase;
    if (is_known && note_other(next)) return report(result, certain_.t, other_.t, other_.label);
    alignas(64) float beyond[batch_size], label[batch_size], distance[batch_size];
    // Eight samples a quarter of a resolution apart: behind `next`, or from `next` on if it is only known not to be in
    // the ray's phase, because no more than the first component was evaluated there.
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

// Whether a ray whose start is not in the phase that it carries was in it a few resolutions before; if so, reports the
// crossing there. Along a face where labels flicker the cell before may still have seen the ray in its phase. No point
// farther back is asked, because a cell's program holds only in the cell and a little around it.
bool March::is_entered_late(RayCrossing& result) {
    const float resolution = ray_.resolution;
    alignas(64) float t[batch_size], label[batch_size];
    const auto look = [&](const Batch& where) {
        store(where, t);
        store(sample_whole(where).label, label);
    };
    constexpr float size = static_cast<float>(batch_size);
    // `in` is the last sample that was found in the ray's phase, and `out` the first one behind it that was not. First
    // we go backward from the start until there is a sample for `in`; then what lies between the two is divided.
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
        if (!(t[0] > low)) break;  // no float lies between
        for (std::size_t i = batch_size; i-- > 0 && in.t == low;) (label[i] == phase_ ? in : out) = {t[i], 0, label[i]};
    }
    return report(result, in.t, out.t, out.label);
}

}  // namespace
}  // namespace phasetree::kernel::HWY_NAMESPACE
