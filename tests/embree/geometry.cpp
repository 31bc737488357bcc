// A PhaseTree in an Embree scene: what an application sees that knows only Embree, and what one sees that sends phases
// along. The yardstick is InterfaceTracer, which marches through the whole object by its whole program.
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstring>
#include <limits>
#include <random>

#include "phasetree/embree.hpp"
#include "phasetree/phasetree.hpp"
#include "phasetree/reading/tree.hpp"

using namespace phasetree;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// A glass ball half full of water, a rod of metal through it, sand below.
Phased object() {
    return read_tree(Document::from_text(R"({
        "phases": {"glass": 0, "water": 0, "metal": 0, "sand": 0},
        "tree": {"under": [
            {"intersect_shape": {"phases": "water", "shape": {"plane": {"normal": [0.1, 0.2, 1], "offset": 0.1}}, "of":
                {"thin_shell": {"of": {"sphere": {"radius": 0.9}}, "shell": "glass", "inside": "water", "half_thickness": 0.05}}}},
            {"set": {"phase": "metal", "of": {"rotate": {"axis": [1, 0, 0], "angle": 25, "of": {"cylinder": {"radius": 0.15, "height": 2.6}}}}}},
            {"set": {"phase": "sand", "of": {"translate": {"by": [0, 0, -1.1], "of": {"rounded_box": {"size": [2, 1.5, 0.4], "radius": 0.1}}}}}}]}})"))
        .object;
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

// The object alone in a scene.
struct Alone {
    explicit Alone(const embree::Options& options = {})
        : tree(device, std::make_shared<const InterfaceCells>(object()), options), scene(device) {
        id = scene.add(tree.handle());
        scene.commit();
    }
    Device device;
    embree::TreeGeometry tree;
    EmbreeScene scene;
    unsigned id = 0;
};

struct Ray {
    glm::vec3 origin, direction;
};

RTCRayHit rayhit(const Ray& ray, float near = 0, float far = infinity) {
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

RTCRayHit intersect(RTCScene scene, RTCRayHit ray) {
    embree::Context context;
    embree::initialise(context);
    embree::intersect(scene, context, ray);
    return ray;
}

bool occluded(RTCScene scene, RTCRayHit ray) {
    embree::Context context;
    embree::initialise(context);
    return embree::occluded(scene, context, ray.ray);
}

// From all sides and from inside; some parallel to an axis.
std::vector<Ray> rays(int count, unsigned seed) {
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

bool hits(const RTCRayHit& ray) {
    return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

// Two places on a ray are one where they are within brackets of each other; the width of a bracket is what tracing
// resolves.
bool same_place(float a, float b, float resolution) {
    return std::abs(a - b) <= 4 * resolution;
}

}  // namespace

TEST_CASE("a stock context: hits are the tracer's first crossings") {
    const Alone alone;
    const InterfaceTracer tracer(object());
    Evaluator::Workspace workspace;
    int hit = 0;
    for (const Ray& ray : rays(4000, 1)) {
        CAPTURE(ray.origin.x);
        CAPTURE(ray.origin.y);
        CAPTURE(ray.origin.z);
        CAPTURE(ray.direction.x);
        CAPTURE(ray.direction.y);
        CAPTURE(ray.direction.z);
        const RTCRayHit r = intersect(alone.scene, rayhit(ray));
        const auto expected = tracer.first_crossing(ray.origin, ray.direction, 0, 1e30f, std::nullopt, workspace);
        REQUIRE(hits(r) == expected.has_value());
        if (!expected) continue;
        ++hit;
        CHECK(same_place(r.ray.tfar, expected->t_in, tracer.resolution()));
        CHECK(r.hit.u == expected->from.index);
        CHECK(r.hit.v == expected->to.index);
        CHECK(r.hit.geomID == alone.id);
        CHECK(r.hit.primID < alone.tree.object().size());
        const glm::vec3 normal(r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z);
        CHECK(glm::length(normal) == doctest::Approx(1).epsilon(1e-5));
        CHECK(glm::dot(normal, ray.direction) < 0);
    }
    CHECK(hit > 2000);
}

TEST_CASE("normals are the surface's, on the side the ray came from") {
    Device device;
    const Phased ball = Set{.phase = Phase{1}, .of = Sphere{.radius = 2}};
    const embree::TreeGeometry tree(device, std::make_shared<const InterfaceCells>(ball));
    EmbreeScene scene(device);
    scene.add(tree.handle());
    scene.commit();
    for (const Ray& ray : rays(500, 2)) {
        const RTCRayHit r = intersect(scene, rayhit(ray));
        REQUIRE((hits(r) || glm::length(ray.origin) > 2));
        if (!hits(r)) continue;
        const glm::vec3 outward = glm::normalize(ray.origin + r.ray.tfar * ray.direction);
        const glm::vec3 expected = glm::length(ray.origin) < 2 ? -outward : outward;
        CHECK(glm::distance(glm::vec3(r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z), expected) < 1e-4f);
    }
}

namespace {

// Bit for bit, member by member: Embree 4's RTCHit has padding, which nobody promises.
bool untouched(const RTCRayHit& a, const RTCRayHit& b) {
    const auto same = [](const auto& x, const auto& y) { return std::memcmp(&x, &y, sizeof x) == 0; };
    const RTCHit &h = a.hit, &k = b.hit;
    return same(a.ray, b.ray) && same(h.Ng_x, k.Ng_x) && same(h.Ng_y, k.Ng_y) && same(h.Ng_z, k.Ng_z) &&
           same(h.u, k.u) && same(h.v, k.v) && h.primID == k.primID && h.geomID == k.geomID &&
           h.instID[0] == k.instID[0];
}

// Rays in packets of N with every third lane inactive: the others are as one by one.
template <int N, class Packet, class Trace>
void check_packets(const Alone& alone, Trace&& trace) {
    CAPTURE(N);
    const float resolution = alone.tree.object().resolution();
    const std::vector<Ray> all = rays(100 * N, 3);
    for (std::size_t first = 0; first < all.size(); first += N) {
        alignas(64) int valid[N];
        Packet packet{};
        std::vector<RTCRayHit> before;
        RTCRayHitN* const p = reinterpret_cast<RTCRayHitN*>(&packet);
        for (unsigned i = 0; i < N; ++i) {
            valid[i] = i % 3 == 2 ? 0 : -1;
            before.push_back(rayhit(all[first + i]));
            before.back().hit.u = 0.125f;  // to be found again where nothing is hit
            before.back().hit.Ng_x = 0.25f;
            RTCRayN* const r = RTCRayHitN_RayN(p, N);
            RTCHitN* const h = RTCRayHitN_HitN(p, N);
            const RTCRayHit& b = before.back();
            RTCRayN_org_x(r, N, i) = b.ray.org_x, RTCRayN_org_y(r, N, i) = b.ray.org_y;
            RTCRayN_org_z(r, N, i) = b.ray.org_z, RTCRayN_tnear(r, N, i) = b.ray.tnear;
            RTCRayN_dir_x(r, N, i) = b.ray.dir_x, RTCRayN_dir_y(r, N, i) = b.ray.dir_y;
            RTCRayN_dir_z(r, N, i) = b.ray.dir_z, RTCRayN_tfar(r, N, i) = b.ray.tfar;
            RTCRayN_mask(r, N, i) = b.ray.mask;
            RTCHitN_geomID(h, N, i) = b.hit.geomID, RTCHitN_primID(h, N, i) = b.hit.primID;
            RTCHitN_instID(h, N, i, 0) = b.hit.instID[0];
            RTCHitN_u(h, N, i) = b.hit.u, RTCHitN_Ng_x(h, N, i) = b.hit.Ng_x;
        }
        trace(valid, packet);
        for (unsigned i = 0; i < N; ++i) {
            CAPTURE(i);
            RTCRayHit after = rtcGetRayHitFromRayHitN(p, N, i);
            const RTCRayHit alone_one = intersect(alone.scene, before[i]);
            if (valid[i] == 0 || !hits(alone_one)) {
                after.ray.flags = before[i].ray.flags;
                CHECK(untouched(after, before[i]));
                continue;
            }
            CHECK(same_place(after.ray.tfar, alone_one.ray.tfar, resolution));
            CHECK(after.hit.geomID == alone_one.hit.geomID);
            CHECK(after.hit.u == alone_one.hit.u);
            CHECK(after.hit.v == alone_one.hit.v);
        }
    }
}

}  // namespace

TEST_CASE("packets of 4, 8 and 16") {
    const Alone alone;
#if PHASETREE_EMBREE_MAJOR == 4
    check_packets<4, RTCRayHit4>(alone,
                                 [&](int* valid, RTCRayHit4& p) { rtcIntersect4(valid, alone.scene, &p, nullptr); });
    check_packets<8, RTCRayHit8>(alone,
                                 [&](int* valid, RTCRayHit8& p) { rtcIntersect8(valid, alone.scene, &p, nullptr); });
    check_packets<16, RTCRayHit16>(
        alone, [&](int* valid, RTCRayHit16& p) { rtcIntersect16(valid, alone.scene, &p, nullptr); });
#else
    embree::Context context;
    embree::initialise(context);
    check_packets<4, RTCRayHit4>(alone,
                                 [&](int* valid, RTCRayHit4& p) { rtcIntersect4(valid, alone.scene, &context, &p); });
    check_packets<8, RTCRayHit8>(alone,
                                 [&](int* valid, RTCRayHit8& p) { rtcIntersect8(valid, alone.scene, &context, &p); });
    check_packets<16, RTCRayHit16>(
        alone, [&](int* valid, RTCRayHit16& p) { rtcIntersect16(valid, alone.scene, &context, &p); });
#endif
}

TEST_CASE("occluded agrees with intersect, whatever the segment") {
    const Alone alone;
    std::mt19937 random(4);
    const float resolution = alone.tree.object().resolution();
    for (const Ray& ray : rays(2000, 5)) {
        const RTCRayHit r = intersect(alone.scene, rayhit(ray));
        CHECK(occluded(alone.scene, rayhit(ray)) == hits(r));
        if (!hits(r) || r.ray.tfar < 0.01f) continue;
        CHECK_FALSE(occluded(alone.scene, rayhit(ray, 0, r.ray.tfar - 8 * resolution)));
        CHECK(occluded(alone.scene, rayhit(ray, 0, r.ray.tfar + 8 * resolution)));
        const float far = std::uniform_real_distribution<float>(0, 4)(random);
        if (same_place(far, r.ray.tfar, resolution)) continue;
        CHECK(occluded(alone.scene, rayhit(ray, 0, far)) == (r.ray.tfar < far));
        CHECK(hits(intersect(alone.scene, rayhit(ray, 0, far))) == (r.ray.tfar < far));
        // Behind the hit, the next one.
        const RTCRayHit next = intersect(alone.scene, rayhit(ray, r.ray.tfar + 8 * resolution));
        if (hits(next)) CHECK(next.ray.tfar > r.ray.tfar);
    }
}

TEST_CASE("the length of the direction is the unit of distance and nothing else") {
    const Alone alone;
    const float resolution = alone.tree.object().resolution();
    for (const Ray& ray : rays(1000, 6)) {
        const RTCRayHit unit = intersect(alone.scene, rayhit(ray));
        for (const float length : {1e-3f, 1e3f}) {
            const RTCRayHit scaled = intersect(alone.scene, rayhit({ray.origin, length * ray.direction}));
            REQUIRE(hits(scaled) == hits(unit));
            if (!hits(unit)) continue;
            CHECK(same_place(scaled.ray.tfar * length, unit.ray.tfar, resolution));
            CHECK(scaled.hit.u == unit.hit.u);
            CHECK(scaled.hit.v == unit.hit.v);
        }
    }
}

TEST_CASE("instances: moved, turned and scaled") {
    Device device;
    const embree::TreeGeometry tree(device, std::make_shared<const InterfaceCells>(object()));
    EmbreeScene inner(device), outer(device);
    inner.add(tree.handle());
    inner.commit();
    const RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, inner);
    // p ↦ 3 (y, −x, z) + (1, 2, 3), by columns
    const float matrix[12] = {0, -3, 0, 3, 0, 0, 0, 0, 3, 1, 2, 3};
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, matrix);
    const unsigned id = outer.add(instance);
    outer.commit();
    rtcReleaseGeometry(instance);
    const auto moved = [](const glm::vec3& v) { return 3.0f * glm::vec3(v.y, -v.x, v.z); };
    for (const Ray& ray : rays(1000, 7)) {
        const RTCRayHit here = intersect(inner, rayhit(ray));
        const RTCRayHit there =
            intersect(outer, rayhit({moved(ray.origin) + glm::vec3(1, 2, 3), moved(ray.direction) / 3.0f}));
        REQUIRE(hits(there) == hits(here));
        if (!hits(here)) continue;
        CHECK(same_place(there.ray.tfar / 3, here.ray.tfar, tree.object().resolution()));
        CHECK(there.hit.instID[0] == id);
        CHECK(there.hit.u == here.hit.u);
        CHECK(there.hit.v == here.hit.v);
    }
}

TEST_CASE("beside a triangle mesh the nearest wins, whichever came first") {
    const float walls[] = {-2, 0.2f, 2};  // planes x = …: before, within and behind the object
    for (const bool mesh_first : {true, false}) {
        for (const float x : walls) {
            Device device;
            const embree::TreeGeometry tree(device, std::make_shared<const InterfaceCells>(object()));
            EmbreeScene scene(device);
            const RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
            auto* const v = static_cast<float*>(
                rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3));
            auto* const t = static_cast<unsigned*>(
                rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), 1));
            const float vertices[] = {x, -100, -100, x, 200, -100, x, -100, 200};
            std::memcpy(v, vertices, sizeof vertices);
            t[0] = 0, t[1] = 1, t[2] = 2;
            unsigned mesh_id = 0, tree_id = 0;
            if (mesh_first) mesh_id = scene.add(mesh);
            tree_id = scene.add(tree.handle());
            if (!mesh_first) mesh_id = scene.add(mesh);
            rtcReleaseGeometry(mesh);
            scene.commit();

            const InterfaceTracer tracer(object());
            Evaluator::Workspace workspace;
            for (const Ray& ray : rays(500, 8)) {
                const auto c = tracer.first_crossing(ray.origin, ray.direction, 0, 1e30f, std::nullopt, workspace);
                const float to_tree = c ? c->t_in : infinity;
                const float along = (x - ray.origin.x) / ray.direction.x;
                if (along > 50) continue;  // beyond the triangle
                const float to_mesh = along > 0 ? along : infinity;
                if (std::abs(to_mesh - to_tree) < 1e-4f) continue;
                const RTCRayHit r = intersect(scene, rayhit(ray));
                const unsigned expected = std::min(to_tree, to_mesh) == infinity ? RTC_INVALID_GEOMETRY_ID
                                          : to_mesh < to_tree                    ? mesh_id
                                                                                 : tree_id;
                CHECK(r.hit.geomID == expected);
                if (hits(r)) CHECK(r.ray.tfar == doctest::Approx(std::min(to_tree, to_mesh)).epsilon(1e-4));
            }
        }
    }
}

TEST_CASE("rays that carry their phase go from interface to interface as the tracer's do") {
    const Alone alone({.rays_carry_phases = true});
    const InterfaceTracer tracer(object());
    Evaluator::Workspace workspace;
    int crossings = 0;
    for (const Ray& ray : rays(1500, 9)) {
        std::vector<Phase> expected, found;
        glm::vec3 p = ray.origin;
        Phase phase = tracer.label(p, workspace);
        while (const auto c = tracer.first_crossing(p, ray.direction, 0, 1e30f, phase, workspace)) {
            expected.push_back(c->to);
            p = c->p_out;
            phase = c->to;
            REQUIRE(expected.size() < 100);
        }
        p = ray.origin;
        phase = tracer.label(p, workspace);
        for (;;) {
            embree::Query query;
            query.carried = phase;
            RTCRayHit r = rayhit({p, ray.direction});
            embree::intersect(alone.scene, query.context, r);
            embree::Query shadow;
            shadow.carried = phase;
            RTCRayHit s = rayhit({p, ray.direction});
            CHECK(embree::occluded(alone.scene, shadow.context, s.ray) == hits(r));
            if (!hits(r)) break;
            CHECK(r.ray.tfar == doctest::Approx(query.crossing.t_in).epsilon(1e-6));
            CHECK(query.crossing.from == phase);
            found.push_back(query.crossing.to);
            p = query.crossing.p_out;
            phase = query.crossing.to;
            REQUIRE(found.size() < 100);
        }
        CHECK(phase == vacuum);
        CAPTURE(ray.origin.x);
        CAPTURE(ray.origin.y);
        CAPTURE(ray.origin.z);
        CAPTURE(ray.direction.x);
        CAPTURE(ray.direction.y);
        CAPTURE(ray.direction.z);
        CHECK(found == expected);
        crossings += static_cast<int>(found.size());
    }
    CHECK(crossings > 2500);
}

TEST_CASE("a ray that carries another phase than is at its start meets an interface there") {
    const Alone alone({.rays_carry_phases = true});
    embree::Query query;
    query.carried = Phase{3};
    RTCRayHit r = rayhit({{0.9f, 0, 0}, {1, 0, 0}});  // within the wall of glass
    embree::intersect(alone.scene, query.context, r);
    REQUIRE(hits(r));
    CHECK(r.ray.tfar < 1e-3f);
    CHECK(query.crossing.from == Phase{3});
    CHECK(query.crossing.to == Phase{1});
}

TEST_CASE("degenerate rays hit nothing") {
    const Alone alone;
    const glm::vec3 from(0, -3, 0), up(0, 1, 0);
    CHECK(hits(intersect(alone.scene, rayhit({from, up}))));
    CHECK_FALSE(hits(intersect(alone.scene, rayhit({from, glm::vec3(0)}))));
    CHECK_FALSE(hits(intersect(alone.scene, rayhit({from, 1e-30f * up}))));  // its length is 0 in float
    CHECK_FALSE(hits(intersect(alone.scene, rayhit({from, up}, 0, 0))));
    CHECK_FALSE(hits(intersect(alone.scene, rayhit({from, up}, 5, 1))));
}

// Some builds of Embree end the program by an assertion of their own for such rays; if it comes to ours, no hit.
TEST_CASE("rays of numbers that are not finite, or nearly not, hit nothing, and in no time") {
    const Alone alone;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Ray bad[] = {{{0, -3, 0}, {0, 1e30f, 0}},    {{0, 1e30f, 0}, {0, 1, 0}},     {{nan, 0, 0}, {0, 1, 0}},
                       {{0, nan, nan}, {1, 1, 1}},     {{0, -3, 0}, {nan, 1, 0}},      {{0, -3, 0}, {0, nan, 0}},
                       {{infinity, 0, 0}, {-1, 0, 0}}, {{0, -infinity, 0}, {0, 1, 0}}, {{0, -3, 0}, {0, infinity, 0}},
                       {{0, -3, 0}, {nan, nan, nan}}};
    for (const Ray& ray : bad) {
        CAPTURE(ray.origin.x);
        CAPTURE(ray.origin.y);
        CAPTURE(ray.direction.x);
        CAPTURE(ray.direction.y);
        const pid_t child = ::fork();
        REQUIRE(child >= 0);
        if (child == 0) {
            std::freopen("/dev/null", "w", stderr);
            std::signal(SIGABRT, SIG_DFL);  // doctest reports it otherwise
            ::alarm(5);
            const bool hit = hits(intersect(alone.scene, rayhit(ray))) || occluded(alone.scene, rayhit(ray));
            ::_exit(hit ? 1 : 0);
        }
        int status = 0;
        REQUIRE(::waitpid(child, &status, 0) == child);
        const bool none = WIFEXITED(status) && WEXITSTATUS(status) == 0;
        const bool assertion_of_embree = WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT;
        CHECK((none || assertion_of_embree));
    }
}

TEST_CASE("geometries move; Embree calls go on") {
    Device device;
    embree::TreeGeometry first(device, std::make_shared<const InterfaceCells>(object()));
    embree::TreeGeometry second(
        device, std::make_shared<const InterfaceCells>(Phased(Set{.phase = Phase{1}, .of = Sphere{.radius = 0.1f}})));
    embree::TreeGeometry moved(std::move(first));
    second = std::move(moved);
    EmbreeScene scene(device);
    scene.add(second.handle());
    scene.commit();
    CHECK(hits(intersect(scene, rayhit({{0, -3, 0}, {0, 1, 0}}))));
    CHECK(second.object().size() > 0);
}
