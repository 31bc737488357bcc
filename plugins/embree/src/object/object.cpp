#include "object/object.hpp"

#include <cmath>
#include <new>

namespace phasetree::embree {

namespace {

RTCRayHit embree_ray(const ObjectRay& ray) {
    RTCRayHit r{};
    r.ray.org_x = ray.origin.x;
    r.ray.org_y = ray.origin.y;
    r.ray.org_z = ray.origin.z;
    r.ray.tnear = ray.near;
    r.ray.dir_x = ray.direction.x;
    r.ray.dir_y = ray.direction.y;
    r.ray.dir_z = ray.direction.z;
    r.ray.tfar = ray.far;
    r.ray.mask = ~0u;
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return r;
}

RTCDevice without_error(RTCDevice device) {
    rtcGetDeviceError(device);
    return device;
}

/// What Embree takes for a ray: with asserts it ends the program otherwise.
bool is_within_range(const ObjectRay& ray) {
    for (int i = 0; i < 3; ++i)
        if (!(std::abs(ray.origin[i]) < 1e18f)) return false;
    return ray.near >= 0 && ray.near < 1e18f && ray.near <= ray.far;
}

/// What the thread's last call of Embree for the device has to complain of.
void check(RTCDevice device, const char* what) {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE) throw EmbreeError(error, what);
}

const char* name_of(RTCError code) {
    switch (code) {
        case RTC_ERROR_INVALID_ARGUMENT:
            return "RTC_ERROR_INVALID_ARGUMENT";
        case RTC_ERROR_INVALID_OPERATION:
            return "RTC_ERROR_INVALID_OPERATION";
        case RTC_ERROR_OUT_OF_MEMORY:
            return "RTC_ERROR_OUT_OF_MEMORY";
        case RTC_ERROR_UNSUPPORTED_CPU:
            return "RTC_ERROR_UNSUPPORTED_CPU";
        case RTC_ERROR_CANCELLED:
            return "RTC_ERROR_CANCELLED";
        default:
            return "RTC_ERROR_UNKNOWN";
    }
}

}  // namespace

EmbreeError::EmbreeError(RTCError code, const char* what)
    : std::runtime_error(std::string(what) + ": " + name_of(code)), code_(code) {}

Object::Object(RTCDevice device, std::shared_ptr<const InterfaceCells> cells)
    : tree_(without_error(device), std::move(cells), {.rays_carry_phases = true}) {
    check(device, "Embree makes no geometry");
    const auto close = [](RTCScene s) { rtcReleaseScene(s); };
    std::unique_ptr<std::remove_pointer_t<RTCScene>, decltype(close)> scene(rtcNewScene(device), close);
    check(device, "Embree makes no scene");
    rtcCommitGeometry(tree_.handle());
    rtcAttachGeometryByID(scene.get(), tree_.handle(), 0);
    rtcCommitScene(scene.get());
    check(device, "Embree could not build");
    scene_ = scene.release();
}

Object::~Object() {
    rtcReleaseScene(scene_);
}

std::optional<Object::Found> Object::first_crossing(const ObjectRay& ray, std::optional<Phase> carried) const {
    if (!is_within_range(ray)) return std::nullopt;
    Query query;
    query.carried = carried;
    RTCRayHit r = embree_ray(ray);
    intersect(scene_, query.context, r);
    if (query.is_out_of_memory) throw std::bad_alloc();
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Found{r.hit.primID, query.crossing};
}

bool Object::any_crossing(const ObjectRay& ray, std::optional<Phase> carried) const {
    if (!is_within_range(ray)) return false;
    Query query;
    query.carried = carried;
    RTCRayHit r = embree_ray(ray);
    const bool is_hit = occluded(scene_, query.context, r.ray);
    if (query.is_out_of_memory && !is_hit) throw std::bad_alloc();
    return is_hit;
}

std::optional<Object::Found> Walk::next() {
    auto found = object_.first_crossing(rest_, carried_);
    if (!found) {
        rest_.far = -1;
        return std::nullopt;
    }
    Crossing& c = found->crossing;
    const double t_in = base_ + static_cast<double>(c.t_in), t_out = base_ + static_cast<double>(c.t_out);
    rest_.origin = c.p_out;
    rest_.near = 0;
    base_ = t_out;
    carried_ = c.to;
    // Where phases flicker within rounding, crossings may follow each other without end: after some, step on.
    const double resolution = static_cast<double>(object_.cells().resolution());
    if (base_ - anchor_ > resolution) {
        anchor_ = base_;
        stuck_ = 0;
    } else if (++stuck_ > 32) {
        rest_.origin += object_.cells().resolution() * rest_.direction;
        base_ += resolution;
    }
    rest_.far = static_cast<float>(far_ - base_);
    c.t_in = static_cast<float>(t_in);
    c.t_out = static_cast<float>(t_out);
    return found;
}

}  // namespace phasetree::embree
