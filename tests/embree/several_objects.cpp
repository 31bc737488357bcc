// Rays through several objects at once. A ray has a phase for each object, and its crossings are those of the objects
// alone, merged by distance.
#include <algorithm>

#include "embree/embree.hpp"
#include "embree_core/cell_geometry.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "support/random_tree.hpp"

namespace test_several_objects {

using namespace phasetree;
using namespace phasetree::tests;
using embree::ObjectInstance;
using embree::RayPhases;

namespace {

std::shared_ptr<const InterfaceCells> cells_of(const Phased& object) {
    return std::make_shared<const InterfaceCells>(object);
}

// A placed object: how rays identify it, and the transform from its own space to the world.
struct Standing {
    ObjectInstance id;
    const InterfaceCells* cells;
    glm::vec3 shift{0};
};

struct Step {
    std::size_t object;
    Phase from, to;
    float distance;  // from the origin of the first ray, to where the old phase ends
};

// From crossing to crossing, with the phases of all objects, of which those that are not in `phases` yet are known.
std::vector<Step> walk(RTCScene scene, const std::vector<Standing>& objects, const Ray& ray, RayPhases phases) {
    std::vector<Step> steps;
    glm::vec3 origin = ray.origin;
    for (;;) {
        embree::Query query;
        query.carry(phases);
        RTCRayHit hit = embree::rayhit_of(origin, ray.direction);
        embree::intersect(scene, query.context, hit);
        embree::Query shadow;
        shadow.carry(phases);
        RTCRay shadow_ray = embree::ray_of(origin, ray.direction);
        REQUIRE(embree::occluded(scene, shadow.context, shadow_ray) == embree::is_hit(hit));
        if (!embree::is_hit(hit)) return steps;
        const ObjectInstance id = ObjectInstance::of(hit.hit);
        const auto met = std::ranges::find_if(objects, [&](const Standing& s) { return s.id == id; });
        REQUIRE(met != objects.end());
        const Crossing& c = query.crossing;
        CHECK(phases.of(id) == c.from);
        phases.set(id, c.to);
        steps.push_back({static_cast<std::size_t>(met - objects.begin()), c.from, c.to,
                         glm::dot(c.p_from + met->shift - ray.origin, ray.direction)});
        origin = c.p_to + met->shift;
        REQUIRE(steps.size() < 100);
    }
}

// The phases at the first ray's start.
RayPhases phases_at(const std::vector<Standing>& objects, const glm::vec3& p) {
    RayPhases phases(vacuum);
    for (const Standing& s : objects) phases.set(s.id, s.cells->label(p - s.shift, Evaluator::thread_workspace()));
    return phases;
}

// The scene holds the objects, and each of `alone` one of them. Returns how many crossings there were.
int check_merged(RTCScene scene, const std::vector<Standing>& objects, const std::vector<RTCScene>& alone,
                 const std::vector<Standing>& as_alone, const std::vector<Ray>& all) {
    int crossings = 0;
    for (const Ray& ray : all) {
        CAPTURE(ray.origin.x);
        CAPTURE(ray.origin.y);
        CAPTURE(ray.origin.z);
        CAPTURE(ray.direction.x);
        CAPTURE(ray.direction.y);
        CAPTURE(ray.direction.z);
        const std::vector<Step> together = walk(scene, objects, ray, phases_at(objects, ray.origin));
        crossings += static_cast<int>(together.size());
        // What each object does by itself, to be found again in its order.
        std::vector<std::vector<Step>> expected;
        for (std::size_t i = 0; i < objects.size(); ++i)
            expected.push_back(walk(alone[i], {as_alone[i]}, ray, phases_at({as_alone[i]}, ray.origin)));
        std::vector<std::size_t> next(objects.size(), 0);
        float last = 0;
        for (const Step& step : together) {
            CAPTURE(step.object);
            CAPTURE(step.distance);
            REQUIRE(next[step.object] < expected[step.object].size());
            const Step& same = expected[step.object][next[step.object]++];
            const float resolution = objects[step.object].cells->resolution();
            CHECK(step.from == same.from);
            CHECK(step.to == same.to);
            CHECK(same_place(step.distance, same.distance, resolution));
            // Where two objects touch, their interfaces are at one place and either may come first.
            CHECK(same.distance >= last - 4 * resolution);
            last = std::max(last, same.distance);
        }
        for (std::size_t i = 0; i < objects.size(); ++i) CHECK(next[i] == expected[i].size());
    }
    return crossings;
}

RTCGeometry instance_of(RTCDevice device, RTCScene scene, const glm::vec3& shift) {
    const RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    const float moved[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, shift.x, shift.y, shift.z};
    rtcSetGeometryInstancedScene(instance, scene);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, moved);
    return instance;
}

unsigned add_instance(RTCDevice device, EmbreeScene& to, RTCScene scene, const glm::vec3& shift) {
    const RTCGeometry instance = instance_of(device, scene, shift);
    const unsigned id = to.add(instance);
    rtcReleaseGeometry(instance);
    return id;
}

ObjectInstance within(unsigned geometry, const std::vector<unsigned>& path) {
    ObjectInstance object;
    object.geometry = geometry;
    for (std::size_t level = 0; level < path.size(); ++level) {
        object.instances[level] = path[level];
#if defined(RTC_GEOMETRY_INSTANCE_ARRAY)
        object.instance_primitives[level] = 0;
#endif
    }
    return object;
}

constexpr embree::CellGeometry::Options carrying = {.rays_carry_phases = true};
const Phase glass{1}, water{2}, core{3};

// A wall of glass, a block of water that lies against it, a ball of two phases that reaches into both.
const Field side = Box{.size = {1, 1.6f, 1.6f}};
const Phased wall = Set{.phase = glass, .of = warped(Translate{.by = {-0.5f, 0, 0}}, side)};
const Phased block = Set{.phase = water, .of = warped(Translate{.by = {0.5f, 0, 0}}, side)};
const Phased ball =
    Under{.of = {Set{.phase = glass, .of = Sphere{.radius = 0.5f}}, Set{.phase = core, .of = Sphere{.radius = 0.2f}}}};

}  // namespace

TEST_CASE("glass and water that touch, and a ball within both: each keeps its own phase") {
    Device device;
    std::vector<embree::CellGeometry> geometries;
    for (const Phased& object : {wall, block, ball}) geometries.emplace_back(device, cells_of(object), carrying);
    EmbreeScene scene(device);
    std::vector<std::unique_ptr<EmbreeScene>> own;
    std::vector<RTCScene> alone;
    std::vector<Standing> objects, as_alone;
    for (const embree::CellGeometry& geometry : geometries) {
        objects.push_back({ObjectInstance{scene.add(geometry.handle())}, &geometry.cells()});
        own.push_back(std::make_unique<EmbreeScene>(device));
        as_alone.push_back({ObjectInstance{own.back()->add(geometry.handle())}, &geometry.cells()});
        own.back()->commit();
        alone.push_back(*own.back());
    }
    scene.commit();
    const int crossings = check_merged(scene, objects, alone, as_alone, rays(long_tests() ? 100'000 : 3000, 21));
    CHECK(crossings > 4000);
}

TEST_CASE("instances that overlap, beside what is in none") {
    Device device;
    const embree::CellGeometry inner(device, cells_of(ball), carrying),
        block_geometry(device, cells_of(block), carrying);
    EmbreeScene within_instances(device), scene(device), block_alone(device);
    const unsigned inner_id = within_instances.add(inner.handle());
    within_instances.commit();
    std::vector<Standing> objects, as_alone;
    std::vector<RTCScene> alone;
    std::vector<std::unique_ptr<EmbreeScene>> own;
    for (const glm::vec3& shift : {glm::vec3(-0.25f, 0, 0), glm::vec3(0.25f, 0.125f, 0), glm::vec3(0, 0, 0.5f)}) {
        const unsigned id = add_instance(device, scene, within_instances, shift);
        objects.push_back({within(inner_id, {id}), &inner.cells(), shift});
        own.push_back(std::make_unique<EmbreeScene>(device));
        as_alone.push_back(
            {within(inner_id, {add_instance(device, *own.back(), within_instances, shift)}), &inner.cells(), shift});
        own.back()->commit();
        alone.push_back(*own.back());
    }
    objects.push_back({ObjectInstance{scene.add(block_geometry.handle())}, &block_geometry.cells()});
    as_alone.push_back({ObjectInstance{block_alone.add(block_geometry.handle())}, &block_geometry.cells()});
    block_alone.commit();
    alone.push_back(block_alone);
    scene.commit();
    CHECK(check_merged(scene, objects, alone, as_alone, rays(long_tests() ? 100'000 : 3000, 22)) > 3500);
}

#if RTC_MAX_INSTANCE_LEVEL_COUNT > 1
// Most installations of Embree have one level of instances; this is for those that have more.
TEST_CASE("instances within instances: a path of them is one object") {
    Device device;
    const embree::CellGeometry inner(device, cells_of(ball), carrying);
    EmbreeScene lowest(device), middle(device), scene(device);
    const unsigned inner_id = lowest.add(inner.handle());
    lowest.commit();
    const glm::vec3 small[] = {glm::vec3(-0.125f, 0, 0), glm::vec3(0.25f, 0, 0.125f)};
    const glm::vec3 large[] = {glm::vec3(0, -0.5f, 0), glm::vec3(0.125f, 0.25f, 0)};
    unsigned small_id[2], large_id[2];
    for (int i = 0; i < 2; ++i) small_id[i] = add_instance(device, middle, lowest, small[i]);
    middle.commit();
    for (int i = 0; i < 2; ++i) large_id[i] = add_instance(device, scene, middle, large[i]);
    scene.commit();
    std::vector<Standing> objects, as_alone;
    std::vector<RTCScene> alone;
    std::vector<std::unique_ptr<EmbreeScene>> own;
    for (int i = 0; i < 2; ++i)
        for (int k = 0; k < 2; ++k) {
            const glm::vec3 shift = large[i] + small[k];
            objects.push_back({within(inner_id, {large_id[i], small_id[k]}), &inner.cells(), shift});
            own.push_back(std::make_unique<EmbreeScene>(device));
            as_alone.push_back(
                {within(inner_id, {add_instance(device, *own.back(), lowest, shift)}), &inner.cells(), shift});
            own.back()->commit();
            alone.push_back(*own.back());
        }
    CHECK(check_merged(scene, objects, alone, as_alone, rays(3000, 23)) > 3500);
}
#endif

TEST_CASE("a ray that leaves with its phases evaluates nothing in the cell that it leaves") {
    Device device;
    const embree::CellGeometry room(device, cells_of(Set{.phase = water, .of = Box{.size = glm::vec3(6)}}), carrying),
        stone(device, cells_of(Set{.phase = glass, .of = Sphere{.radius = 0.5f}}), carrying);
    EmbreeScene scene(device);
    const ObjectInstance room_id{scene.add(room.handle())}, stone_id{scene.add(stone.handle())};
    scene.commit();
    int left = 0, left_at_once = 0;
    for (const Ray& ray : rays(4000, 24)) {
        if (glm::length(ray.origin) < 0.6f) continue;
        RayPhases phases;
        phases.set(room_id, glm::length(ray.origin) < 3 ? water : vacuum);
        phases.set(stone_id, vacuum);
        embree::Query query;
        query.carry(phases);
        RTCRayHit hit = embree::rayhit_of(ray.origin, ray.direction);
        embree::intersect(scene, query.context, hit);
        if (!embree::is_hit(hit) || !(ObjectInstance::of(hit.hit) == stone_id)) continue;
        // Reflected, and not at a grazing angle, where it may have to look after all; up to where the room ends.
        const Crossing c = query.crossing;
        const CrossingNormal normal = stone.cells().normal(hit.hit.primID, c, ray.direction);
        if (glm::dot(ray.direction, normal.unit) < 0.25f) continue;
        const Ray away{c.p_from, glm::reflect(ray.direction, normal.unit)};
        const auto counters = [&](const RayPhases& known, const embree::StartHint& start) {
            embree::Query leaving;
            leaving.carry(known);
            leaving.start = start;
            RTCRayHit rest = embree::rayhit_of(away.origin, away.direction, 0, 2);
            embree::intersect(scene, leaving.context, rest);
            CHECK_FALSE(embree::is_hit(rest));
            return leaving.counters;
        };
        const TraceCounters kept = counters(phases, {stone_id, hit.hit.primID, c.from, normal.gradient}),
                            forgotten = counters(RayPhases(), {});
        ++left;
        // Without phases the label at the start is evaluated, wherever the ray goes.
        CHECK(forgotten.batches > kept.batches);
        if (kept.visits > 1) continue;
        ++left_at_once;
        CHECK(kept.batches == 0);
    }
    CHECK(left > 200);
    CHECK(left_at_once > 150);
}

TEST_CASE("phases of a ray: known by object, path and all, and of the rest what holds elsewhere") {
    RayPhases nothing, outside(vacuum);
    CHECK_FALSE(nothing.of(ObjectInstance{0}).has_value());
    CHECK(outside.of(ObjectInstance{0}) == vacuum);
    for (unsigned i = 0; i < 20; ++i) {
        nothing.set(ObjectInstance{i}, Phase{static_cast<std::uint8_t>(i)});
        nothing.set(within(i, {7}), Phase{static_cast<std::uint8_t>(i + 20)});
    }
    nothing.set(ObjectInstance{1}, Phase{50});
    nothing.set(within(19, {7}), Phase{51});
    const RayPhases copy = nothing;
    for (unsigned i = 0; i < 20; ++i) {
        CHECK(copy.of(ObjectInstance{i}) == Phase{static_cast<std::uint8_t>(i == 1 ? 50 : i)});
        CHECK(copy.of(within(i, {7})) == Phase{static_cast<std::uint8_t>(i == 19 ? 51 : i + 20)});
        CHECK_FALSE(copy.of(within(i, {8})).has_value());
    }
}

}  // namespace test_several_objects
