// Rays that carry the phase that they are in.
#include "embree/alone.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/trace/tracer.hpp"

namespace test_carried_phases {

using namespace phasetree;
using namespace phasetree::tests;

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
            p = c->p_to;
            phase = c->to;
            REQUIRE(expected.size() < 100);
        }
        p = ray.origin;
        phase = tracer.label(p, workspace);
        for (;;) {
            embree::Query query;
            query.default_phase = phase;
            RTCRayHit r = rayhit({p, ray.direction});
            embree::intersect(alone.scene, query.context, r);
            embree::Query shadow;
            shadow.default_phase = phase;
            RTCRayHit s = rayhit({p, ray.direction});
            CHECK(embree::occluded(alone.scene, shadow.context, s.ray) == hits(r));
            if (!hits(r)) break;
            CHECK(r.ray.tfar == doctest::Approx(query.crossing.t_from).epsilon(1e-6));
            CHECK(query.crossing.from == phase);
            found.push_back(query.crossing.to);
            p = query.crossing.p_to;
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

TEST_CASE("one query serves ray after ray, from one point, along one direction, through instances") {
    const Alone alone({.rays_carry_phases = true});
    EmbreeScene instances(alone.device);
    for (const float shift : {0.f, 4.f}) {
        const RTCGeometry instance = rtcNewGeometry(alone.device, RTC_GEOMETRY_TYPE_INSTANCE);
        const float moved[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, shift, 0, 0};
        rtcSetGeometryInstancedScene(instance, alone.scene);
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, moved);
        instances.add(instance);
        rtcReleaseGeometry(instance);
    }
    instances.commit();
    std::vector<Ray> sequence;
    for (const Ray& ray : rays(400, 5)) {
        const glm::vec3 aside = glm::normalize(glm::vec3(ray.direction.y, ray.direction.z, -ray.direction.x));
        const glm::vec3 along(std::copysign(1.f, ray.direction.x), 0, 0);  // through both
        for (const glm::vec3& d : {ray.direction, glm::normalize(ray.direction + 0.1f * aside), along})
            sequence.push_back({ray.origin, d});
        sequence.push_back({ray.origin + 0.1f * aside, along});
    }
    embree::Query one;
    int hit = 0;
    for (const Ray& ray : sequence) {
        embree::Query fresh;
        RTCRayHit expected = rayhit(ray), found = rayhit(ray);
        embree::intersect(instances, fresh.context, expected);
        embree::initialise(one.context);
        embree::intersect(instances, one.context, found);
        REQUIRE(hits(found) == hits(expected));
        if (!hits(found)) continue;
        ++hit;
        CHECK(found.ray.tfar == expected.ray.tfar);
        CHECK(found.hit.instID[0] == expected.hit.instID[0]);
        CHECK(one.crossing.p_from == fresh.crossing.p_from);
        CHECK(one.crossing.to == fresh.crossing.to);
    }
    CHECK(hit > 500);
}

TEST_CASE("a ray that carries another phase than is at its start meets an interface before the next one") {
    const Alone alone({.rays_carry_phases = true});
    embree::Query query;
    query.default_phase = Phase{3};
    RTCRayHit r = rayhit({{0.9f, 0, 0}, {1, 0, 0}});  // within the wall of glass
    embree::intersect(alone.scene, query.context, r);
    REQUIRE(hits(r));
    CHECK(r.ray.tfar < 0.0999f);  // the wall ends at 0.1
    CHECK(query.crossing.from == Phase{3});
    CHECK(query.crossing.to == Phase{1});
}

}  // namespace test_carried_phases
