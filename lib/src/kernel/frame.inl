// What the search along a ray works on: a piece of the ray, and eight samples of it at a time. Included by kernel.inl.

namespace phasetree::kernel::HWY_NAMESPACE {
namespace {

// Eight samples of a ray in rising order, and the sample that lies before them. Gap i is what lies between sample i − 1
// (the sample before, for i = 0) and sample i.
struct alignas(64) Frame {
    float t[batch_size];
    float distance[batch_size];  // s(p), as in Classified: the label is the same within this radius
    float label[batch_size];
    Sample before;
    std::uint32_t doubt;    // bit i: gap i is not proven to be free of interfaces
    std::uint32_t phantom;  // bit i: gap i is passed only because it is no longer than the resolution
    int next;               // the first gap that is not passed yet

    Frame() {}  // members are unset on purpose: most rays use one or two of many frames
    Sample sample(int lane) const { return lane < 0 ? before : Sample{t[lane], distance[lane], label[lane]}; }
};

// The piece of a ray that is searched: origin + t·direction, t_begin ≤ t ≤ length. The origin is where the ray enters
// the cell, so that t is small and exact.
struct RaySegment {
    float origin[3];
    float direction[3];
    float length;
    float t_begin;
    float before;  // the length of the ray in front of the origin, along which samples with t < 0 may be taken
    float resolution;
    float slope;         // a bound of how fast a component changes along the ray
    float curvature[2];  // as in Visit
    float carried;       // the phase that the ray is in; negative: the label at its start
    bool is_monotone;    // there is one component, and along the ray it only grows or only falls
    bool on_interface;   // the ray most likely starts on an interface: a hint where to sample first
};

}  // namespace
}  // namespace phasetree::kernel::HWY_NAMESPACE
