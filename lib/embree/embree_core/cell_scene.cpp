#include "embree_core/cell_scene.hpp"

#include <cmath>
#include <new>
#include <type_traits>

#include "embree_core/error.hpp"

namespace phasetree::embree {

namespace {

RTCDevice without_error(RTCDevice device) {
    rtcGetDeviceError(device);
    return device;
}

// Whether Embree accepts the ray. For any other ray, an Embree with assertions ends the program.
bool is_within_range(const UnitRay& ray) {
    for (int i = 0; i < 3; ++i)
        if (!(std::abs(ray.origin[i]) < 1e18f)) return false;
    return ray.near >= 0 && ray.near < 1e18f && ray.near <= ray.far;
}

}  // namespace

CellScene::CellScene(RTCDevice device, std::shared_ptr<const InterfaceCells> cells)
    : geometry_(without_error(device), std::move(cells), {.rays_carry_phases = true}) {
    throw_device_error(device, "Embree cannot create a geometry");
    const auto close = [](RTCScene s) { rtcReleaseScene(s); };
    std::unique_ptr<std::remove_pointer_t<RTCScene>, decltype(close)> scene(rtcNewScene(device), close);
    throw_device_error(device, "Embree cannot create a scene");
    rtcCommitGeometry(geometry_.handle());
    rtcAttachGeometryByID(scene.get(), geometry_.handle(), 0);
    rtcCommitScene(scene.get());
    throw_device_error(device, "Embree cannot build the scene");
    scene_ = scene.release();
}

CellScene::~CellScene() {
    rtcReleaseScene(scene_);
}

std::optional<CellScene::Hit> CellScene::first_crossing(const UnitRay& ray, std::optional<Phase> carried) const {
    if (!is_within_range(ray)) return std::nullopt;
    Query query;
    query.default_phase = carried;  // the scene has one object
    RTCRayHit rayhit = rayhit_of(ray.origin, ray.direction, ray.near, ray.far);
    intersect(scene_, query.context, rayhit);
    if (query.is_out_of_memory) throw std::bad_alloc();
    if (!is_hit(rayhit)) return std::nullopt;
    return Hit{rayhit.hit.primID, query.crossing};
}

bool CellScene::any_crossing(const UnitRay& ray, std::optional<Phase> carried) const {
    if (!is_within_range(ray)) return false;
    Query query;
    query.default_phase = carried;  // the scene has one object
    RTCRay embree_ray = ray_of(ray.origin, ray.direction, ray.near, ray.far);
    const bool is_occluded = occluded(scene_, query.context, embree_ray);
    if (query.is_out_of_memory && !is_occluded) throw std::bad_alloc();
    return is_occluded;
}

}  // namespace phasetree::embree
