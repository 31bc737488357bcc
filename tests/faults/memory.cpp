// Memory that runs out at the n-th allocation: a message, exit code 1, and no half file. Never a crash.
#include <algorithm>

#include "faults/support/child.hpp"
#include "faults/support/faults.hpp"

namespace test_memory {

using namespace phasetree::tests;

namespace {

// Every n at first, and then ever fewer; in the long form all.
std::size_t next(std::size_t n) {
    return long_tests() ? n + 1 : n + 1 + n / 20;
}

void check_each_allocation(const std::vector<std::string>& arguments) {
    const auto run = [&](std::size_t n, bool for_good) {
        return run_command(
            arguments, [=] { faults::fail_allocation(n, for_good); }, faults::stop_failing_allocations);
    };
    const Ended reference = run(~std::size_t{0}, false);
    CAPTURE(reference.err);
    REQUIRE(reference.code == 0);
    REQUIRE(reference.calls > 300);
    int failed = 0;
    for (std::size_t n = 1; n <= reference.calls + 1; n = next(n))
        for (const bool for_good : {false, true}) {
            const Ended ended = run(n, for_good);
            CAPTURE(n);
            CAPTURE(for_good);
            CAPTURE(ended.err);
            CHECK(ended.signal == 0);
            CHECK(are_whole(ended, reference));
            if (ended.code == 0) {
                CHECK(ended.out == reference.out);
                CHECK(ended.files == reference.files);
            } else {
                CHECK(ended.code == 1);
                CHECK(ended.err.starts_with("phasetree: "));
                ++failed;
            }
        }
    // Nearly all of them matter.
    CHECK(failed > 100);
    MESSAGE(reference.calls << " allocations, " << failed << " runs without memory");
}

}  // namespace

TEST_CASE("check") {
    check_each_allocation({"check", "scene.json"});
}
TEST_CASE("info") {
    check_each_allocation({"info", "scene.json"});
}
TEST_CASE("render") {
    check_each_allocation(tiny_render);
}

}  // namespace test_memory
