// Rays that tell which phase they are in.
#include "embree/alone.hpp"

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

TEST_CASE("a ray that carries another phase than is at its start meets an interface before the next one") {
    const Alone alone({.rays_carry_phases = true});
    embree::Query query;
    query.carried = Phase{3};
    RTCRayHit r = rayhit({{0.9f, 0, 0}, {1, 0, 0}});  // within the wall of glass
    embree::intersect(alone.scene, query.context, r);
    REQUIRE(hits(r));
    CHECK(r.ray.tfar < 0.0999f);  // the wall ends at 0.1
    CHECK(query.crossing.from == Phase{3});
    CHECK(query.crossing.to == Phase{1});
}
