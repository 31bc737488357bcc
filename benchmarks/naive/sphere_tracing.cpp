#include "naive/sphere_tracing.hpp"

#include <cmath>

#include "tree/walk.hpp"

namespace phasetree::bench {

namespace {

struct Sample {
    Phase label;
    float radius;
};

Sample sample(const NaiveScene::Object& object, const glm::vec3& p) {
    const Phases<float> phi = Walk<float>{}.phases(object.tree, {p.x, p.y, p.z});
    float least = std::numeric_limits<float>::infinity(), second = least, magnitude = least;
    for_each_phase(phi.present, [&](int i) {
        const float v = phi[i];
        second = std::min(second, std::max(least, v));
        least = std::min(least, v);
        magnitude = std::min(magnitude, std::abs(v));
    });
    return {label(phi), object.step == Step::interface_distance ? second : magnitude};
}

// The part of a ray within a box.
std::optional<glm::vec2> clipped(const Bounds& box, const glm::vec3& origin, const glm::vec3& direction, float near,
                                 float far) {
    for (int a = 0; a < 3; ++a) {
        if (direction[a] == 0) {
            if (origin[a] < box.low[a] || origin[a] > box.high[a]) return std::nullopt;
            continue;
        }
        const float t0 = (box.low[a] - origin[a]) / direction[a], t1 = (box.high[a] - origin[a]) / direction[a];
        near = std::max(near, std::min(t0, t1));
        far = std::min(far, std::max(t0, t1));
    }
    if (!(near <= far)) return std::nullopt;
    return glm::vec2(near, far);
}

void bounds_of(const RTCBoundsFunctionArguments* arguments) {
    const Bounds& b = static_cast<const NaiveScene::Object*>(arguments->geometryUserPtr)->bounds;
    *arguments->bounds_o = {b.low.x, b.low.y, b.low.z, 0, b.high.x, b.high.y, b.high.z, 0};
}

// Where the label is no longer that at the start. A small |φ| alone is no hit: it may be a phantom zero.
void march(const RTCIntersectFunctionNArguments* arguments) noexcept {
    if (arguments->valid[0] != -1 || arguments->N != 1) return;
    const auto& object = *static_cast<const NaiveScene::Object*>(arguments->geometryUserPtr);
    RTCRayHit& ray = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
    const glm::vec3 origin(ray.ray.org_x, ray.ray.org_y, ray.ray.org_z);
    const glm::vec3 direction(ray.ray.dir_x, ray.ray.dir_y, ray.ray.dir_z);
    const auto part = clipped(object.bounds, origin, direction, ray.ray.tnear, ray.ray.tfar);
    if (!part) return;
    float t = part->x;
    Sample s = sample(object, origin + t * direction);
    const Phase from = s.label;
    while (t < part->y) {
        float next = t + std::max(s.radius, object.resolution);
        if (next == t) next = std::nextafter(t, std::numeric_limits<float>::infinity());
        s = sample(object, origin + next * direction);
        if (s.label != from) {
            ray.ray.tfar = t;
            ray.hit.geomID = arguments->geomID;
            ray.hit.primID = 0;
            ray.hit.u = s.label.index;
            ray.hit.v = from.index;
            ray.hit.Ng_x = -direction.x;
            ray.hit.Ng_y = -direction.y;
            ray.hit.Ng_z = -direction.z;
            return;
        }
        t = next;
    }
}

}  // namespace

NaiveScene::NaiveScene(const Phased& object, const Bounds& bounds, float resolution, Step step)
    : object_(std::make_unique<const Object>(Object{object, bounds, resolution, step})), scene_(RTC_SCENE_FLAG_ROBUST) {
    geometry_ = rtcNewGeometry(scene_.device(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry_, 1);
    rtcSetGeometryUserData(geometry_, const_cast<Object*>(object_.get()));
    rtcSetGeometryBoundsFunction(geometry_, bounds_of, nullptr);
    rtcSetGeometryIntersectFunction(geometry_, march);
    rtcCommitGeometry(geometry_);
    rtcAttachGeometry(scene_.handle(), geometry_);
    rtcCommitScene(scene_.handle());
}

NaiveScene::~NaiveScene() {
    rtcReleaseGeometry(geometry_);
}

}  // namespace phasetree::bench
