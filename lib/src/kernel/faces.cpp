// Where a line crosses triangles, eight at a time: the watertight test of Woop, Benthin and Wald, "Watertight
// Ray/Triangle Intersection" (Journal of Computer Graphics Techniques 2(1), 2013), in doubles.
//
// Space is sheared so that the line becomes the axis kz, and each triangle is projected along it. Each edge function is
// a difference of two products, and swapping the ends of an edge only changes its sign, even after rounding. So the two
// triangles at an edge agree about its side, and the line cannot pass between them. A line exactly through an edge or a
// vertex meets all its triangles, except those that are seen edge-on.
//
// Unlike the rest of the kernel, this needs no equation of a node, so on x86-64 Highway compiles it for all instruction
// sets at once: the file includes itself. Elsewhere, there is one kernel. Among arm64's instruction sets are some whose
// registers cannot be members of a struct (SVE).
#ifndef PHASETREE_X86
#define HWY_COMPILE_ONLY_STATIC
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/faces.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "kernel/faces.hpp"

HWY_BEFORE_NAMESPACE();
namespace phasetree::kernel::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, batch_size>;
using Register = hn::Vec<Doubles>;
constexpr std::size_t double_lanes = hn::MaxLanes(Doubles());

// The axes and the shear of a ray, as in the paper.
struct ShearedRay {
    std::size_t kx, ky, kz;
    double origin[3], shear_x, shear_y, scale;
};

HWY_INLINE ShearedRay sheared(const TracedRay& ray) {
    const float d[3] = {ray.direction.x, ray.direction.y, ray.direction.z};
    const float o[3] = {ray.origin.x, ray.origin.y, ray.origin.z};
    const double inverse[3] = {ray.inverse.x, ray.inverse.y, ray.inverse.z};
    const float x = d[0] < 0 ? -d[0] : d[0], y = d[1] < 0 ? -d[1] : d[1], z = d[2] < 0 ? -d[2] : d[2];
    ShearedRay r;
    r.kz = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
    r.kx = r.kz == 2 ? 0 : r.kz + 1;
    r.ky = r.kx == 2 ? 0 : r.kx + 1;
    if (d[r.kz] < 0) {  // preserves the winding of triangles
        const std::size_t k = r.kx;
        r.kx = r.ky;
        r.ky = k;
    }
    for (std::size_t k = 0; k < 3; ++k) r.origin[k] = static_cast<double>(o[k]);
    r.scale = inverse[r.kz];
    r.shear_x = static_cast<double>(d[r.kx]) * r.scale;
    r.shear_y = static_cast<double>(d[r.ky]) * r.scale;
    return r;
}

// Bit i says whether lane i of the mask is true.
HWY_INLINE std::uint32_t bits_of(const hn::Mask<Doubles>& mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Doubles(), mask, bytes);
    return bytes[0] & ((1u << double_lanes) - 1u);
}

// A corner of each triangle in a register, in the sheared space.
struct Corner {
    Register x, y, z;
};
HWY_INLINE Corner corner_of(const float (*at)[batch_size], std::size_t lane, const ShearedRay& ray) {
    const Doubles tag;
    const hn::Rebind<float, Doubles> floats;
    const Register z =
        hn::Sub(hn::PromoteTo(tag, hn::LoadU(floats, &at[ray.kz][lane])), hn::Set(tag, ray.origin[ray.kz]));
    const Register x =
        hn::Sub(hn::PromoteTo(tag, hn::LoadU(floats, &at[ray.kx][lane])), hn::Set(tag, ray.origin[ray.kx]));
    const Register y =
        hn::Sub(hn::PromoteTo(tag, hn::LoadU(floats, &at[ray.ky][lane])), hn::Set(tag, ray.origin[ray.ky]));
    return {hn::Sub(x, hn::Mul(hn::Set(tag, ray.shear_x), z)), hn::Sub(y, hn::Mul(hn::Set(tag, ray.shear_y), z)), z};
}
HWY_INLINE Register edge(const Corner& a, const Corner& b) {
    return hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x));
}

// Appends the crossings of the line with eight triangles, in the order of the lanes. Returns their number.
HWY_INLINE std::size_t meet_batch(const FaceBatch& faces, const ShearedRay& ray, std::uint32_t first, FaceHit* hits) {
    const Doubles tag;
    const Register zero = hn::Zero(tag);
    std::size_t count = 0;
    for (std::size_t lane = 0; lane < batch_size; lane += double_lanes) {
        const Corner a = corner_of(faces.at, lane, ray), b = corner_of(faces.at + 3, lane, ray),
                     c = corner_of(faces.at + 6, lane, ray);
        const Register u = edge(c, b), v = edge(a, c), w = edge(b, a), sum = hn::Add(u, hn::Add(v, w));
        const Register least = hn::Min(u, hn::Min(v, w)), most = hn::Max(u, hn::Max(v, w));
        const std::uint32_t front = bits_of(hn::And(hn::Ge(least, zero), hn::Gt(sum, zero)));
        const std::uint32_t back = bits_of(hn::And(hn::Le(most, zero), hn::Lt(sum, zero)));
        std::uint32_t met = front | back;
        if (HWY_LIKELY(met == 0)) continue;
        const Register depth = hn::Add(hn::Mul(u, a.z), hn::Add(hn::Mul(v, b.z), hn::Mul(w, c.z)));
        alignas(64) double t[batch_size];
        hn::Store(hn::Div(hn::Mul(hn::Set(tag, ray.scale), depth), sum), tag, t);
        for (; met != 0; met &= met - 1) {
            const auto i = static_cast<std::uint32_t>(__builtin_ctz(met));
            hits[count++] = {t[i], first + static_cast<std::uint32_t>(lane) + i, (front >> i & 1) != 0};
        }
    }
    return count;
}

std::size_t meet_faces(const FaceBatch* faces, std::size_t batches, const TracedRay& ray, FaceHit* hits) {
    const ShearedRay line = sheared(ray);
    std::size_t count = 0;
    for (std::size_t i = 0; i < batches; ++i)
        count += meet_batch(faces[i], line, static_cast<std::uint32_t>(i * batch_size), hits + count);
    return count;
}

}  // namespace
}  // namespace phasetree::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace phasetree::kernel {

MeetFaces meet_faces_for(const Kernel& kernel) {
#ifdef PHASETREE_X86
#if HWY_TARGETS & HWY_AVX3
    if (&kernel == &kernel_avx512) return N_AVX3::meet_faces;
#endif
#if HWY_TARGETS & HWY_AVX2
    if (&kernel == &kernel_avx2) return N_AVX2::meet_faces;
#endif
#if HWY_TARGETS & HWY_SSE4
    if (&kernel == &kernel_sse4) return N_SSE4::meet_faces;
#endif
#endif
    (void)kernel;
    return HWY_STATIC_DISPATCH(meet_faces);
}

}  // namespace phasetree::kernel
#endif
