#include "world/placed_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "embree_core/cell_callbacks.hpp"
#include "parameters/world_limits.hpp"

namespace phasetree::tracer {

namespace {

using InstanceList = PlacedGeometry::InstanceList;
using EmbreeInstance = PlacedGeometry::EmbreeInstance;
using Target = PlacedGeometry::Target;

void bounds_of_instance(const RTCBoundsFunctionArguments* arguments) {
    embree::write_bounds(*arguments->bounds_o,
                         static_cast<const InstanceList*>(arguments->geometryUserPtr)->list[arguments->primID].bounds);
}

// The transform into the space of the target at an instance of a list. If the target moves, the transform is stored in
// `then`.
const Transform& inward_at(const InstanceList& instances, unsigned number, double time, Transform& then) {
    const EmbreeInstance& instance = instances.list[number];
    if (!instance.moves) return instance.inward;
    const Instance& source = (*instances.source)[number];
    const Transform outward = instances.placed->transform_of(source, time);
    then = source.is_group
               ? outward.inverse()
               : (outward * instances.placed->first_of(instances.placed->objects[source.of], time)).inverse();
    return then;
}

// Transforms the ray into the space of the target at an instance, and back on destruction.
class InwardRay {
  public:
    InwardRay(RTCRay& ray, PlacedQuery& query, const Transform& inward, std::uint32_t first_copy, const Target& target)
        : ray_(ray), query_(query), outer_ray_(ray), outer_(query.here), outer_first_copy_(query.first_copy) {
        query.here = inward * outer_;
        query.first_copy = outer_first_copy_ + first_copy;
        glm::vec3 origin(query.here(query.origin));
        if (target.cells) {
            query.query.context.instID[0] = query.first_copy;
            if (query.start && query.start->copy == query.first_copy) origin = query.start->origin;
        }
        const glm::vec3 direction(query.here.matrix * query.direction);
        embree::set_ray(ray, origin, direction, ray.tnear, target.cells ? query.far : ray.tfar);
        ray.time = outer_ray_.time;
    }
    ~InwardRay() {
        const float far = ray_.tfar;
        ray_ = outer_ray_;
        ray_.tfar = far;
        query_.here = outer_;
        query_.first_copy = outer_first_copy_;
        query_.query.context.instID[0] = RTC_INVALID_GEOMETRY_ID;
    }
    InwardRay(const InwardRay&) = delete;
    InwardRay& operator=(const InwardRay&) = delete;

  private:
    RTCRay& ray_;
    PlacedQuery& query_;
    RTCRay outer_ray_;
    Transform outer_;
    std::uint32_t outer_first_copy_;
};

// A previous hit is kept if nothing closer is found. Among copies at the same distance, the one with the lower number
// wins, and a mesh precedes any copy, as Embree's triangles replace hits at the same distance. So the order in which
// Embree visits instances does not matter. Crossings are known only up to a bracket. Therefore each copy is searched to
// the ray's original end: stopping at the closest hit so far could miss a copy at the same distance.
void intersect_instance(const RTCIntersectFunctionNArguments* arguments) noexcept {
    if (arguments->valid[0] != -1) return;
    const InstanceList& instances = *static_cast<const InstanceList*>(arguments->geometryUserPtr);
    const EmbreeInstance& instance = instances.list[arguments->primID];
    const Target& target = (*instances.targets)[instance.target];
    auto& query = *reinterpret_cast<PlacedQuery*>(arguments->context);
    if (query.query.skips_cells) return;
    auto& rayhit = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);

    const RTCHit hit_before = rayhit.hit;
    const Crossing crossing_before = query.query.crossing;
    const Copy copy_before = query.hit;
    const float far_before = rayhit.ray.tfar;
    rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    {
        Transform then;
        const InwardRay inward(rayhit.ray, query, inward_at(instances, arguments->primID, query.time, then),
                               instance.first_copy, target);
        embree::intersect(target.scene, query.query.context, rayhit);
        if (target.cells && embree::is_hit(rayhit)) query.hit = {query.first_copy, target.object, query.here};
    }
    if (embree::is_hit(rayhit)) {
        const bool is_copy_before = hit_before.instID[0] != RTC_INVALID_GEOMETRY_ID;
        const bool is_first =
            hit_before.geomID == RTC_INVALID_GEOMETRY_ID || (is_copy_before && query.hit.number < copy_before.number);
        const float far = rayhit.ray.tfar;
        if (far < far_before || (far == far_before && is_first)) return;
    }
    rayhit.hit = hit_before;
    rayhit.ray.tfar = far_before;
    query.query.crossing = crossing_before;
    query.hit = copy_before;
}

// A query for the objects that contain a point: the transform to the space of the current list, and the results so far.
struct PointOnItsWay {
    const InstanceList* instances = nullptr;
    glm::dvec3 point{0};
    Transform here{};
    std::uint32_t first_copy = 0;
    RayObjects found{};
};

bool query_instance(RTCPointQueryFunctionArguments* arguments);

// Queries the instances whose boxes contain the point. They are the primitives of the first geometry of the scene.
void ask(RTCScene scene, PointOnItsWay& on_its_way) {
    const glm::vec3 p(on_its_way.here(on_its_way.point));
    RTCPointQuery query{};
    query.x = p.x;
    query.y = p.y;
    query.z = p.z;
    // The point was rounded when it was transformed into this space, so boxes that nearly contain it are queried, too.
    query.radius = 1e-6f * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene, &query, &context, query_instance, &on_its_way);
}

bool query_instance(RTCPointQueryFunctionArguments* arguments) {
    if (arguments->geomID != 0) return false;
    auto& on_its_way = *static_cast<PointOnItsWay*>(arguments->userPtr);
    const PointOnItsWay before = on_its_way;
    const EmbreeInstance& instance = before.instances->list[arguments->primID];
    const Target& target = (*before.instances->targets)[instance.target];
    const auto time = static_cast<double>(before.found.time());
    Transform then;
    on_its_way.here = inward_at(*before.instances, arguments->primID, time, then) * before.here;
    on_its_way.first_copy = before.first_copy + instance.first_copy;
    if (target.cells) {
        const glm::vec3 p(on_its_way.here(on_its_way.point));
        on_its_way.found.set(on_its_way.first_copy, target.cells->label(p, Evaluator::thread_workspace()));
    } else {
        on_its_way.instances = target.instances;
        ask(target.scene, on_its_way);
    }
    on_its_way.instances = before.instances;
    on_its_way.here = before.here;
    on_its_way.first_copy = before.first_copy;
    return false;
}

// Two touching interfaces may be found this many resolutions of the cells apart, plus this share of the coordinates.
constexpr double resolutions_apart = 2, relative_rounding = 4e-7;

// The bounds of the target at a moving instance during the shutter interval, and the maximum factor by which it is
// stretched.
struct Sweep {
    Bounds bounds;
    double stretch;
};

Sweep swept(const PlacedObjects& placed, const Instance& instance, const Bounds& of) {
    Sweep sweep{of, 1};
    const auto go_on = [&](std::uint32_t moving, const Transform& still) {
        const bool moves = moving != stands_still;
        sweep.bounds = moves ? placed.moving[moving].swept(sweep.bounds) : still.image(sweep.bounds);
        sweep.stretch *= moves ? placed.moving[moving].stretch() : still.stretch();
    };
    if (!instance.is_group) go_on(placed.objects[instance.of].moving, placed.objects[instance.of].first);
    go_on(stands_still, instance.transform);
    if (instance.moving != stands_still) go_on(instance.moving, {});
    return sweep;
}

double rounded_at(const glm::vec3& p) {
    return relative_rounding * static_cast<double>(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}));
}

}  // namespace

PlacedGeometry::PlacedGeometry(RTCDevice device, const PlacedObjects& placed,
                               std::vector<std::shared_ptr<const InterfaceCells>> cells)
    : cells_(std::move(cells)) {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        geometries_.emplace_back(device, cells_[i], embree::CellGeometry::Options{.rays_carry_phases = true});
        SceneHandle scene(rtcNewScene(device));
        rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
        rtcCommitGeometry(geometries_.back().handle());
        rtcAttachGeometryByID(scene.get(), geometries_.back().handle(), 0);
        rtcCommitScene(scene.get());
        targets_.push_back({.scene = scene.get(),
                            .bounds = cells_[i]->bounds(),
                            .cells = cells_[i].get(),
                            .object = static_cast<std::uint32_t>(i),
                            .resolution = static_cast<double>(cells_[i]->resolution()),
                            .look_back = static_cast<double>(cells_[i]->look_back())});
        scenes_.push_back(std::move(scene));
    }
    targets_.reserve(placed.objects.size() + placed.groups.size());
    for (const PlacedGroup& group : placed.groups) {
        auto instances = made(device, placed, group.instances);
        instances->scene.reset(rtcNewScene(device));
        rtcSetSceneFlags(instances->scene.get(), RTC_SCENE_FLAG_ROBUST);
        rtcAttachGeometryByID(instances->scene.get(), instances->geometry.get(), 0);
        rtcCommitScene(instances->scene.get());
        targets_.push_back({.scene = instances->scene.get(),
                            .bounds = instances->bounds,
                            .instances = instances.get(),
                            .resolution = instances->resolution,
                            .look_back = instances->look_back});
        groups_.push_back(std::move(instances));
    }
    root_ = made(device, placed, placed.instances);
    const glm::vec3 far = glm::max(glm::abs(root_->bounds.low), glm::abs(root_->bounds.high));
    most_tolerance_ = resolutions_apart * root_->resolution + rounded_at(far);
}

std::unique_ptr<InstanceList> PlacedGeometry::made(RTCDevice device, const PlacedObjects& placed,
                                                   const std::vector<Instance>& list) {
    auto instances = std::make_unique<InstanceList>();
    instances->targets = &targets_;
    instances->placed = &placed;
    instances->source = &list;
    instances->list.reserve(list.size());
    std::uint64_t copies = 0;
    for (const Instance& instance : list) {
        const std::uint32_t target =
            instance.of + (instance.is_group ? static_cast<std::uint32_t>(placed.objects.size()) : 0);
        const PlacedObject* object = instance.is_group ? nullptr : &placed.objects[instance.of];
        const Transform outward = object ? instance.transform * object->first : instance.transform;
        const bool moves = instance.moving != stands_still || (object && object->moving != stands_still);
        const Sweep sweep = moves ? swept(placed, instance, targets_[target].bounds)
                                  : Sweep{outward.image(targets_[target].bounds), outward.stretch()};
        const Bounds& bounds = sweep.bounds;
        for (int i = 0; i < 3 && !bounds.empty(); ++i)
            if (!(bounds.low[i] >= -farthest) || !(bounds.high[i] <= farthest))
                throw ModelError("an instance is too large or too far away");
        const double look_back = sweep.stretch * targets_[target].look_back;
        instances->list.push_back({outward.inverse(), bounds.inflated(1.01f * static_cast<float>(look_back)), target,
                                   moves, static_cast<std::uint32_t>(copies)});
        instances->bounds = unite(instances->bounds, bounds);
        instances->resolution = std::max(instances->resolution, sweep.stretch * targets_[target].resolution);
        instances->look_back = std::max(instances->look_back, look_back);
        copies += placed.copies_at(instance);
    }
    instances->geometry.reset(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER));
    rtcSetGeometryUserPrimitiveCount(instances->geometry.get(), static_cast<unsigned>(list.size()));
    rtcSetGeometryUserData(instances->geometry.get(), instances.get());
    rtcSetGeometryBoundsFunction(instances->geometry.get(), bounds_of_instance, nullptr);
    rtcSetGeometryIntersectFunction(instances->geometry.get(), intersect_instance);
    rtcCommitGeometry(instances->geometry.get());
    return instances;
}

RayObjects PlacedGeometry::objects_at(RTCScene scene, const glm::vec3& p, float time) const {
    PointOnItsWay on_its_way{.instances = root_.get(), .point = glm::dvec3(p), .found = RayObjects(time)};
    ask(scene, on_its_way);
    return on_its_way.found;
}

Transform PlacedGeometry::to_object(std::uint32_t copy, float time) const {
    Transform here;
    for (const InstanceList* instances = root_.get(); instances != nullptr;) {
        // The last instance whose first copy is not after this one: each instance has at least one copy.
        const auto next = std::ranges::upper_bound(instances->list, copy, {}, &EmbreeInstance::first_copy);
        const auto number = static_cast<unsigned>(next - instances->list.begin() - 1);
        Transform then;
        here = inward_at(*instances, number, static_cast<double>(time), then) * here;
        copy -= instances->list[number].first_copy;
        instances = targets_[instances->list[number].target].instances;
    }
    return here;
}

double PlacedGeometry::tolerance(std::uint32_t object, const Transform& to_scene, const glm::vec3& p) const {
    return resolutions_apart * static_cast<double>(cells_[object]->resolution()) * to_scene.stretch() + rounded_at(p);
}

}  // namespace phasetree::tracer
