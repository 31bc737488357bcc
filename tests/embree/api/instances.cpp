// Directions of any length, and instances of any affine kind: the same points, the right IDs.
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "embree/api/api.hpp"

namespace test_instances {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

struct AffineTransform {
    const char* name;
    glm::mat3 linear;
    glm::vec3 shift;
};

std::array<float, 12> columns(const AffineTransform& a) {
    std::array<float, 12> m{};
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) m[static_cast<std::size_t>(3 * column + row)] = a.linear[column][row];
    for (int row = 0; row < 3; ++row) m[static_cast<std::size_t>(9 + row)] = a.shift[row];
    return m;
}

const AffineTransform affines[] = {
    {"moved", glm::mat3(1), {1, 2, 3}},
    {"tiny", glm::mat3(1e-3f), {0.5f, 0, 0}},
    {"huge", glm::mat3(1e3f), {-500, 20, 100}},
    {"stretched", glm::mat3(0.3f, 0, 0, 0, 1, 0, 0, 0, 4), {0, 1, 0}},
    {"sheared", glm::mat3(1, 0, 0, 0.7f, 1, 0, -0.3f, 0.5f, 1), {0, -1, 2}},
    {"mirrored", glm::mat3(0, 1, 0, 1, 0, 0, 0, 0, 1), {3, 0, 0}},
    {"mirrored, sheared, scaled", glm::mat3(-2, 0.2f, 0, 0.4f, 1.5f, 0, 0, 0.3f, 1), {0, 0, -4}},
};

RTCGeometry add_instance(RTCDevice device, RTCScene outer, RTCScene inner, const AffineTransform& a, unsigned& id) {
    const RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, inner);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns(a).data());
    rtcCommitGeometry(instance);
    id = rtcAttachGeometry(outer, instance);
    rtcReleaseGeometry(instance);
    return instance;
}

}  // namespace

TEST_CASE("the length of the direction is the unit of distance and nothing else") {
    const Placed placed;
    const float resolution = placed.geometry.statistics().resolution;
    int hit = 0;
    for (const Ray& ray : rays(1000, 6)) {
        const RTCRayHit unit = trace_one(placed.scene, rayhit(ray));
        for (const float length : {1e-3f, 1e3f}) {
            CAPTURE(length);
            const RTCRayHit scaled = trace_one(placed.scene, rayhit({ray.origin, length * ray.direction}));
            REQUIRE(hits(scaled) == hits(unit));
            REQUIRE(occluded_one(placed.scene, rayhit({ray.origin, length * ray.direction})) == hits(unit));
            if (!hits(unit)) continue;
            ++hit;
            REQUIRE(same_place(scaled.ray.tfar * length, unit.ray.tfar, resolution));
            REQUIRE(scaled.hit.u == unit.hit.u);
            REQUIRE(scaled.hit.v == unit.hit.v);
            const PhasetreeHit decoded = placed.geometry.decode(scaled);
            REQUIRE(same_place(decoded.tTo * length, unit.ray.tfar, resolution));
            REQUIRE(glm::distance(vec(decoded.pointFrom), ray.origin + unit.ray.tfar * ray.direction) < 4 * resolution);
        }
    }
    CHECK(hit > 1000);
}

TEST_CASE("instances: scaled, sheared and mirrored ones hit the same points, with the right IDs") {
    Device device;
    const embree::Geometry geometry(device, object_tree());
    EmbreeScene inner(device);
    const unsigned geom_id = inner.add(geometry.embree());
    inner.commit();
    const float resolution = geometry.statistics().resolution;
    for (const AffineTransform& a : affines) {
        CAPTURE(a.name);
        EmbreeScene outer(device);
        unsigned other = 0, id = 0;
        // Another instance far away, so that the ID is not the only one there is.
        add_instance(device, outer, inner, {"", glm::mat3(1), glm::vec3(1e6f)}, other);
        add_instance(device, outer, inner, a, id);
        outer.commit();
        int hit = 0;
        const double stretch = std::cbrt(std::abs(glm::determinant(a.linear)));
        for (const Ray& ray : rays(400, 7)) {
            const Ray there{a.linear * ray.origin + a.shift, a.linear * ray.direction};
            // The ray in the instance's space, including rounding. The reference traces this ray.
            const RTCRayHit here = trace_one(inner, rayhit(ray));
            const RTCRayHit r = trace_one(outer, marked(there));
            // World coordinates are rounded to ulps of the shift; seen from the object that is this much.
            const float blur = static_cast<float>(
                2e-7 * static_cast<double>(glm::length(a.shift) + glm::length(there.origin)) / stretch);
            if (hits(r) != hits(here)) {
                // Only where the ray grazes: a hair beside it is what was found.
                bool beside = false;
                for (int axis = 0; axis < 6 && !beside; ++axis) {
                    glm::vec3 off(0);
                    off[axis % 3] = (axis < 3 ? 8 : -8) * (blur + resolution);
                    beside = hits(trace_one(inner, rayhit({ray.origin + off, ray.direction}))) == hits(r);
                }
                REQUIRE(beside);
                continue;
            }
            REQUIRE(occluded_one(outer, rayhit(there)) == hits(r));
            if (!hits(r)) {
                REQUIRE(same_bits(r, marked(there)));
                continue;
            }
            ++hit;
            // Along grazing rays a blur sideways is larger along the ray.
            const glm::vec3 normal(here.hit.Ng_x, here.hit.Ng_y, here.hit.Ng_z);
            const float cosine = std::abs(glm::dot(normal, ray.direction));
            if (cosine < 0.02f) continue;
            REQUIRE(std::abs(r.ray.tfar - here.ray.tfar) < 4 * resolution + 4 * blur / cosine);
            if (r.hit.primID == here.hit.primID) {
                REQUIRE(r.hit.u == here.hit.u);
                REQUIRE(r.hit.v == here.hit.v);
            }
            REQUIRE(r.hit.geomID == geom_id);
            REQUIRE(r.hit.instID[0] == id);
#if defined(RTC_GEOMETRY_INSTANCE_ARRAY)
            REQUIRE(r.hit.instPrimID[0] == 0);
#endif
            const PhasetreeHit decoded = geometry.decode(r, columns(a).data());
            REQUIRE(decoded.from == static_cast<unsigned>(r.hit.u));
            REQUIRE(glm::distance(vec(decoded.pointFrom), ray.origin + here.ray.tfar * ray.direction) <
                    8 * resolution + 8 * blur / cosine);
        }
        CHECK(hit > 150);
    }
}

#if defined(RTC_GEOMETRY_INSTANCE_ARRAY)
TEST_CASE("instance arrays tell which of them") {
    Device device;
    const embree::Geometry geometry(device, object_tree());
    EmbreeScene inner(device);
    inner.add(geometry.embree());
    inner.commit();
    EmbreeScene outer(device);
    const RTCGeometry array = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE_ARRAY);
    rtcSetGeometryInstancedScene(array, inner);
    std::vector<float> matrices;
    for (int i = 0; i < 3; ++i) {
        const auto m = columns({"", glm::mat3(1), {5.0f * static_cast<float>(i), 0, 0}});
        matrices.insert(matrices.end(), m.begin(), m.end());
    }
    rtcSetSharedGeometryBuffer(array, RTC_BUFFER_TYPE_TRANSFORM, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, matrices.data(),
                               0, 12 * sizeof(float), 3);
    rtcCommitGeometry(array);
    const unsigned id = rtcAttachGeometry(outer, array);
    rtcReleaseGeometry(array);
    outer.commit();
    for (unsigned i = 0; i < 3; ++i) {
        const RTCRayHit r = trace_one(outer, rayhit({{5.0f * static_cast<float>(i) + 0.01f, -3, 0.01f}, {0, 1, 0}}));
        REQUIRE(hits(r));
        CHECK(r.hit.instID[0] == id);
        CHECK(r.hit.instPrimID[0] == i);
    }
}
#endif

}  // namespace test_instances
