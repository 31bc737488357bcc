// Embree's devices and scenes, an object, and rays for it.
#pragma once

#include <doctest/doctest.h>

#include <cstring>
#include <limits>
#include <random>

#include "phasetree/embree_version.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree::tests {

constexpr float infinity = std::numeric_limits<float>::infinity();

// A glass ball half full of water, a rod of metal through it, sand below.
inline const char* const object_text = R"({
        "phases": {"glass": 0, "water": 0, "metal": 0, "sand": 0},
        "tree": {"under": [
            {"intersect_shape": {"phases": "water", "shape": {"plane": {"normal": [0.1, 0.2, 1], "offset": 0.1}}, "of":
                {"thin_shell": {"of": {"sphere": {"radius": 0.9}}, "shell": "glass", "inside": "water", "half_thickness": 0.05}}}},
            {"set": {"phase": "metal", "of": {"rotate": {"axis": [1, 0, 0], "angle": 25, "of": {"cylinder": {"radius": 0.15, "height": 2.6}}}}}},
            {"set": {"phase": "sand", "of": {"translate": {"by": [0, 0, -1.1], "of": {"rounded_box": {"size": [2, 1.5, 0.4], "radius": 0.1}}}}}}]}})";
inline Phased object() {
    return read_tree(Document::from_text(object_text)).object;
}

class Device {
  public:
    Device() : device_(rtcNewDevice(nullptr)) { REQUIRE(device_ != nullptr); }
    ~Device() { rtcReleaseDevice(device_); }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    operator RTCDevice() const { return device_; }

  private:
    RTCDevice device_;
};

class EmbreeScene {
  public:
    explicit EmbreeScene(RTCDevice device) : scene_(rtcNewScene(device)) {}
    ~EmbreeScene() { rtcReleaseScene(scene_); }
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;
    operator RTCScene() const { return scene_; }

    // Commits and attaches.
    unsigned add(RTCGeometry geometry) {
        rtcCommitGeometry(geometry);
        return rtcAttachGeometry(scene_, geometry);
    }
    void commit() { rtcCommitScene(scene_); }

  private:
    RTCScene scene_;
};

struct Ray {
    glm::vec3 origin, direction;
};

inline RTCRayHit rayhit(const Ray& ray, float near = 0, float far = infinity) {
    RTCRayHit r{};
    r.ray.org_x = ray.origin.x, r.ray.org_y = ray.origin.y, r.ray.org_z = ray.origin.z;
    r.ray.dir_x = ray.direction.x, r.ray.dir_y = ray.direction.y, r.ray.dir_z = ray.direction.z;
    r.ray.tnear = near, r.ray.tfar = far;
    r.ray.mask = ~0u;
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.primID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return r;
}

inline RTCRayHit intersect(RTCScene scene, RTCRayHit ray) {
    embree::Context context;
    embree::initialise(context);
    embree::intersect(scene, context, ray);
    return ray;
}

inline bool occluded(RTCScene scene, RTCRayHit ray) {
    embree::Context context;
    embree::initialise(context);
    return embree::occluded(scene, context, ray.ray);
}

// From all sides and from inside; some parallel to an axis.
inline std::vector<Ray> rays(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(-1.3f, 1.3f);
    const auto point = [&] { return glm::vec3(coordinate(random), coordinate(random), coordinate(random)); };
    std::vector<Ray> all;
    while (all.size() < static_cast<std::size_t>(count)) {
        const glm::vec3 target = point();
        glm::vec3 direction = glm::normalize(point());
        if (all.size() % 8 == 0) {
            const glm::vec3 axis(all.size() % 3 == 0, all.size() % 3 == 1, all.size() % 3 == 2);
            direction = all.size() % 2 == 0 ? axis : -axis;
        }
        const float back = all.size() % 2 == 0 ? 3.0f : 0.0f;
        all.push_back({target - back * direction, direction});
    }
    return all;
}

inline bool hits(const RTCRayHit& ray) {
    return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

// Two places on a ray are one where they are within brackets of each other; the width of a bracket is what tracing
// resolves.
inline bool same_place(float a, float b, float resolution) {
    return std::abs(a - b) <= 4 * resolution;
}

}  // namespace phasetree::tests
