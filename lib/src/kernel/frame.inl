// The data structures of the search along a ray: a segment of the ray, and frames of eight samples. Included by
// kernel.inl.

namespace phasetree::kernel::HWY_NAMESPACE {
namespace {

// Eight samples of a ray in ascending order, and the sample before them. Gap i lies between sample i − 1 and sample i;
// for i = 0, it starts at the sample before.
struct alignas(64) Frame {
    float t[batch_size];
    float distance[batch_size];  // s(p), as in Classified: the label is constant within this radius
    float label[batch_size];
    Sample before;
    std::uint32_t doubt;    // bit i: gap i is not proven free of interfaces
    std::uint32_t phantom;  // bit i: gap i is passed only because it does not exceed the resolution
    int next;               // the first gap not yet passed

    Frame() {}  // intentionally uninitialised: most rays use only one or two of many frames
    Sample sample(int lane) const { return lane < 0 ? before : Sample{t[lane], distance[lane], label[lane]}; }
};

// The segment of a ray to search: origin + t·direction, t_begin ≤ t ≤ length. The origin is where the ray enters the
// cell, so that t is small and exact.
struct RaySegment {
    float origin[3];
    float direction[3];
    float length;
    float t_begin;
    float before;  // the length of the ray before the origin; samples with t < 0 may be taken there
    float resolution;
    float slope;         // an upper bound on the rate at which a component changes along the ray
    float curvature[2];  // as in Visit
    float carried;       // the ray's phase; if negative, use the label at its start
    bool is_monotone;    // there is one component, and it is monotone along the ray
    bool on_interface;   // the ray most likely starts on an interface; a hint for placing the first samples
};

}  // namespace
}  // namespace phasetree::kernel::HWY_NAMESPACE
