// Invalid rays.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "embree/alone.hpp"

namespace test_hostile_rays {

using namespace phasetree;
using namespace phasetree::tests;

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

}  // namespace test_hostile_rays
