// Crossings are the same bit for bit under every SIMD instruction set, in any order, with any workspace.
#include <doctest/doctest.h>

#include <cstring>
#include <thread>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/program/program.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/random_tree.hpp"

namespace test_determinism {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

struct RestoreTarget {
    std::string name = simd_target();
    ~RestoreTarget() { use_simd_target(name); }
};

/// The sequence along a ray, as bits.
std::vector<std::uint32_t> sequence(const InterfaceTracer& tracer, const glm::vec3& o, const glm::vec3& d,
                                    Evaluator::Workspace& w) {
    std::vector<std::uint32_t> bits;
    glm::vec3 origin = o;
    std::optional<Phase> carried;
    for (int n = 0; n < 100; ++n) {
        TraceCounters c;
        const auto hit = tracer.first_crossing(origin, d, 0, 1e6f, carried, w, &c);
        bits.push_back(static_cast<std::uint32_t>(c.batches));
        if (!hit) break;
        const glm::vec3 normal = tracer.normal(*hit, d);
        for (const float f : {hit->t_from, hit->t_to, hit->p_from.x, hit->p_from.y, hit->p_from.z, hit->p_to.x,
                              hit->p_to.y, hit->p_to.z, normal.x, normal.y, normal.z})
            bits.push_back(std::bit_cast<std::uint32_t>(f));
        bits.push_back(hit->from.index);
        bits.push_back(hit->to.index);
        origin = hit->p_to;
        carried = hit->to;
    }
    return bits;
}

struct Job {
    std::shared_ptr<InterfaceTracer> tracer;
    std::vector<std::pair<glm::vec3, glm::vec3>> rays;
};

std::vector<Job> jobs() {
    Random rng(101);
    std::vector<Job> all;
    while (all.size() < 100) {
        Job job;
        try {
            job.tracer = std::make_shared<InterfaceTracer>(random_object(rng, 3 + static_cast<int>(all.size() % 4)));
        } catch (const ModelError&) {
            continue;  // unbounded or empty
        }
        for (int n = 0; n < 40; ++n) {
            const glm::vec3 o = rng.in(job.tracer->bounds().inflated(job.tracer->bounds().diagonal()));
            job.rays.emplace_back(o, glm::normalize(rng.in(job.tracer->bounds()) - o));
        }
        all.push_back(std::move(job));
    }
    return all;
}

std::vector<std::uint32_t> all_sequences(const std::vector<Job>& all, bool backwards) {
    Evaluator::Workspace w;
    std::vector<std::vector<std::uint32_t>> parts(all.size());
    for (std::size_t n = 0; n < all.size(); ++n) {
        const std::size_t i = backwards ? all.size() - 1 - n : n;
        for (const auto& [o, d] : all[i].rays) {
            const auto bits = sequence(*all[i].tracer, o, d, w);
            parts[i].insert(parts[i].end(), bits.begin(), bits.end());
        }
    }
    std::vector<std::uint32_t> result;
    for (const auto& p : parts) result.insert(result.end(), p.begin(), p.end());
    return result;
}

}  // namespace

TEST_CASE("crossings are the same bit for bit under every instruction set and in any order") {
    const RestoreTarget restore;
    const std::vector<Job> all = jobs();
    const auto expected = all_sequences(all, false);
    CHECK(expected.size() > 20'000);
    for (const std::string& target : simd_targets()) {
        CAPTURE(target);
        use_simd_target(target);
        const bool forwards = all_sequences(all, false) == expected, backwards = all_sequences(all, true) == expected;
        CHECK(forwards);
        CHECK(backwards);
    }
}

TEST_CASE("threads share a tracer, each with its own workspace") {
    const std::vector<Job> all = jobs();
    const auto expected = all_sequences(all, false);
    std::vector<std::vector<std::uint32_t>> results(7);
    {
        std::vector<std::jthread> threads;
        for (auto& r : results) threads.emplace_back([&all, &r] { r = all_sequences(all, false); });
    }
    for (const auto& r : results) {
        const bool same = r == expected;
        CHECK(same);
    }
}

TEST_CASE("recording is the same every time") {
    Random a(102), b(102);
    for (int tree = 0; tree < 100; ++tree) {
        const Program p = record(random_object(a, 3 + tree % 4)), q = record(random_object(b, 3 + tree % 4));
        REQUIRE(p.instructions.size() == q.instructions.size());
        for (std::size_t i = 0; i < p.instructions.size(); ++i) {
            const Instruction &x = p.instructions[i], &y = q.instructions[i];
            REQUIRE((x.op == y.op && x.a == y.a && x.b == y.b && x.data == y.data));
        }
        REQUIRE(std::memcmp(p.constants.data(), q.constants.data(), p.constants.size() * sizeof(float)) == 0);
    }
}

}  // namespace test_determinism
