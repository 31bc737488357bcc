// Shared by the tests of the C99 interface: trees and geometries created through its C++ wrapper, and packets of any
// size.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <vector>

#include "embree/embree.hpp"
#include "phasetree/phasetree_embree.hpp"
#include "support/long_tests.hpp"

namespace phasetree::tests {

inline embree::Tree object_tree() {
    return embree::Tree::from_text(object_text, "object");
}

inline PhasetreeGeometryOptions with_flags(unsigned flags) {
    PhasetreeGeometryOptions options = embree::default_options();
    options.flags = flags;
    return options;
}

inline RTCScene new_scene(RTCDevice device, int flags = 0, RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM) {
    const RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(flags));
    rtcSetSceneBuildQuality(scene, quality);
    return scene;
}

// A tree alone in a scene, as geometry `id`.
struct Placed {
    explicit Placed(const embree::Tree& of = object_tree(),
                    const PhasetreeGeometryOptions& options = embree::default_options())
        : tree(of), geometry(device, tree, options), scene(device) {
        id = scene.add(geometry.embree());
        scene.commit();
    }
    Device device;
    embree::Tree tree;
    embree::Geometry geometry;
    EmbreeScene scene;
    unsigned id = 0;
};

// How a query passes additional data to Embree.
struct Call {
    bool coherent = false;
    embree::Context* context = nullptr;   // none: a stock one
    RTCFilterFunctionN filter = nullptr;  // Embree 3: the context's
};

template <int N>
struct PacketOf;
template <>
struct PacketOf<1> {
    using Rays = RTCRay;
    using Both = RTCRayHit;
};
template <>
struct PacketOf<4> {
    using Rays = RTCRay4;
    using Both = RTCRayHit4;
};
template <>
struct PacketOf<8> {
    using Rays = RTCRay8;
    using Both = RTCRayHit8;
};
template <>
struct PacketOf<16> {
    using Rays = RTCRay16;
    using Both = RTCRayHit16;
};

// Traces N rays at once.
template <int N>
void query(RTCScene scene, int* valid, typename PacketOf<N>::Both& packet, const Call& call) {
    embree::Context stock;
    embree::initialise(stock);
    embree::Context* const context = call.context ? call.context : &stock;
#if PHASETREE_EMBREE_MAJOR == 4
    RTCIntersectArguments a;
    rtcInitIntersectArguments(&a);
    a.context = context;
    a.flags = call.coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    if constexpr (N == 1) rtcIntersect1(scene, &packet, &a);
    if constexpr (N == 4) rtcIntersect4(valid, scene, &packet, &a);
    if constexpr (N == 8) rtcIntersect8(valid, scene, &packet, &a);
    if constexpr (N == 16) rtcIntersect16(valid, scene, &packet, &a);
#else
    context->flags = call.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    context->filter = call.filter;
    if constexpr (N == 1) rtcIntersect1(scene, context, &packet);
    if constexpr (N == 4) rtcIntersect4(valid, scene, context, &packet);
    if constexpr (N == 8) rtcIntersect8(valid, scene, context, &packet);
    if constexpr (N == 16) rtcIntersect16(valid, scene, context, &packet);
#endif
    (void)valid;
}

template <int N>
void query(RTCScene scene, int* valid, typename PacketOf<N>::Rays& packet, const Call& call) {
    embree::Context stock;
    embree::initialise(stock);
    embree::Context* const context = call.context ? call.context : &stock;
#if PHASETREE_EMBREE_MAJOR == 4
    RTCOccludedArguments a;
    rtcInitOccludedArguments(&a);
    a.context = context;
    a.flags = call.coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    if constexpr (N == 1) rtcOccluded1(scene, &packet, &a);
    if constexpr (N == 4) rtcOccluded4(valid, scene, &packet, &a);
    if constexpr (N == 8) rtcOccluded8(valid, scene, &packet, &a);
    if constexpr (N == 16) rtcOccluded16(valid, scene, &packet, &a);
#else
    context->flags = call.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    context->filter = call.filter;
    if constexpr (N == 1) rtcOccluded1(scene, context, &packet);
    if constexpr (N == 4) rtcOccluded4(valid, scene, context, &packet);
    if constexpr (N == 8) rtcOccluded8(valid, scene, context, &packet);
    if constexpr (N == 16) rtcOccluded16(valid, scene, context, &packet);
#endif
    (void)valid;
}

// The context of one ray that carries phases.
struct Carrying {
    std::vector<PhasetreeCarriedPhase> carried;
    PhasetreeRay state{};
    PhasetreeRayContext context{};

    Carrying(std::initializer_list<PhasetreeCarriedPhase> phases) : carried(phases) {
        state.carried = carried.data();
        state.carriedCount = static_cast<unsigned>(carried.size());
        phasetreeInitRayContext(&context);
        context.rays = &state;
        context.rayCount = 1;
    }
    Carrying(const Carrying&) = delete;
    Carrying& operator=(const Carrying&) = delete;
};

// A packet's members, field after field, N floats each; a struct of one ray is a packet of one. The layout is the one
// that Embree documents for RTCRayN and RTCHitN.
constexpr int ray_fields = 12;
inline unsigned hit_fields() {
    return static_cast<unsigned>(offsetof(RTCHit, instID) / 4 + (RTC_MAX_INSTANCE_LEVEL_COUNT * sizeof(unsigned)) / 4);
}

template <int N>
void put_ray(void* packet, unsigned i, const RTCRay& ray) {
    const auto* from = reinterpret_cast<const std::byte*>(&ray);
    auto* to = static_cast<std::byte*>(packet);
    for (unsigned f = 0; f < ray_fields; ++f) std::memcpy(to + 4 * (f * N + i), from + 4 * f, 4);
}
template <int N>
void put(typename PacketOf<N>::Both& packet, unsigned i, const RTCRayHit& ray) {
    put_ray<N>(&packet.ray, i, ray.ray);
    const auto* from = reinterpret_cast<const std::byte*>(&ray.hit);
    auto* to = reinterpret_cast<std::byte*>(&packet.hit);
    for (unsigned f = 0; f < hit_fields(); ++f) std::memcpy(to + 4 * (f * N + i), from + 4 * f, 4);
}
template <int N>
RTCRay get_ray(const void* packet, unsigned i) {
    RTCRay ray{};
    auto* to = reinterpret_cast<std::byte*>(&ray);
    const auto* from = static_cast<const std::byte*>(packet);
    for (unsigned f = 0; f < ray_fields; ++f) std::memcpy(to + 4 * f, from + 4 * (f * N + i), 4);
    return ray;
}
template <int N>
RTCRayHit get(const typename PacketOf<N>::Both& packet, unsigned i) {
    RTCRayHit ray{};
    ray.ray = get_ray<N>(&packet.ray, i);
    auto* to = reinterpret_cast<std::byte*>(&ray.hit);
    const auto* from = reinterpret_cast<const std::byte*>(&packet.hit);
    for (unsigned f = 0; f < hit_fields(); ++f) std::memcpy(to + 4 * f, from + 4 * (f * N + i), 4);
    return ray;
}

// Bit for bit, member by member: structs may have padding, which nobody promises. `flags` is Embree's to use.
inline bool same_bits(const RTCRay& a, const RTCRay& b) {
    RTCRay x = a, y = b;
    x.flags = y.flags = 0;
    return std::memcmp(&x, &y, 4 * ray_fields) == 0;
}
inline bool same_bits(const RTCRayHit& a, const RTCRayHit& b) {
    return same_bits(a.ray, b.ray) && std::memcmp(&a.hit, &b.hit, 4 * hit_fields()) == 0;
}

// A ray with marks in the members of the hit, to be found again where nothing is hit.
inline RTCRayHit marked(const Ray& ray, float near = 0, float far = infinity) {
    RTCRayHit r = rayhit(ray, near, far);
    r.hit.Ng_x = 0.25f, r.hit.Ng_y = 0.5f, r.hit.Ng_z = 0.75f;
    r.hit.u = 0.125f, r.hit.v = 0.375f;
    r.hit.primID = 12345;
    r.ray.id = 77;
    return r;
}

inline RTCRayHit trace_one(RTCScene scene, RTCRayHit ray, const Call& call = {}) {
    query<1>(scene, nullptr, ray, call);
    return ray;
}
inline bool occluded_one(RTCScene scene, RTCRayHit ray, const Call& call = {}) {
    query<1>(scene, nullptr, ray.ray, call);
    return ray.ray.tfar < 0;
}

// Requires that a call fails with a message that contains this text.
inline void expect_error(PhasetreeError error, PhasetreeError expected, const char* part) {
    CHECK(error == expected);
    const std::string message = phasetreeGetErrorMessage();
    CAPTURE(message);
    CHECK(message.find(part) != std::string::npos);
}

// Twelve floats as a map.
struct ColumnMap {
    glm::dmat3 linear{1};
    glm::dvec3 shift{0};
    explicit ColumnMap(const std::array<float, 12>& m) {
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                linear[column][row] = static_cast<double>(m[static_cast<std::size_t>(3 * column + row)]);
        for (int row = 0; row < 3; ++row) shift[row] = static_cast<double>(m[static_cast<std::size_t>(9 + row)]);
    }
    glm::dvec3 operator()(const glm::dvec3& p) const { return linear * p + shift; }
};

inline glm::vec3 vec(const float* p) {
    return {p[0], p[1], p[2]};
}
inline std::array<float, 3> arr(const glm::vec3& p) {
    return {p.x, p.y, p.z};
}

}  // namespace phasetree::tests
