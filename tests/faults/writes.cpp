// Files that cannot be written, or only byte by byte: there must be complete files or none, and a message.
#include <cerrno>

#include "faults/support/child.hpp"
#include "faults/support/faults.hpp"

namespace test_writes {

using namespace phasetree::tests;

namespace {

std::vector<std::string> render() {
    std::vector<std::string> arguments = tiny_render;
    arguments.insert(arguments.end(), {"-o", "c.jpg", "-o", "d.tif"});
    return arguments;
}
Ended run(const faults::WriteFaults& planned) {
    return run_command(
        render(), [=] { faults::set_write_faults(planned); }, faults::stop_write_faults);
}

}  // namespace

TEST_CASE("a call that fails") {
    const Ended reference = run({});
    CAPTURE(reference.err);
    REQUIRE(reference.code == 0);
    REQUIRE(reference.files.size() == 4);
    REQUIRE(reference.calls >= 16);  // open, write, close and rename for each
    int failed = 0;
    for (const int error : {ENOSPC, EIO, EDQUOT, EACCES})
        for (const bool for_good : {false, true})
            for (std::size_t n = 1; n <= reference.calls; ++n) {
                const Ended ended = run({.failing = n, .for_good = for_good, .error = error});
                CAPTURE(n);
                CAPTURE(error);
                CAPTURE(for_good);
                CAPTURE(ended.err);
                CHECK(ended.signal == 0);
                CHECK(are_whole(ended, reference));
                if (ended.code == 0) {
                    CHECK(ended.files == reference.files);
                    continue;
                }
                CHECK((ended.code == 1 || ended.code == 2));
                CHECK(ended.err.find("phasetree: cannot write \"") == 0);
                CHECK(ended.files.size() < 4);
                ++failed;
            }
    CHECK(failed > 4 * 2 * 12);
}

TEST_CASE("short and interrupted writes") {
    const Ended reference = run({});
    REQUIRE(reference.code == 0);
    for (const std::size_t shortest : {std::size_t{1}, std::size_t{7}, std::size_t{1000}}) {
        const Ended ended = run({.shortest = shortest});
        CHECK(ended.code == 0);
        CHECK(ended.files == reference.files);
        CHECK(ended.calls > reference.calls);
    }
    int undisturbed = 0;
    for (std::size_t n = 1; n <= reference.calls; ++n) {
        const Ended ended = run({.failing = n, .error = EINTR, .shortest = 100});
        CHECK(ended.signal == 0);
        CHECK(are_whole(ended, reference));
        undisturbed += ended.code == 0;
    }
    CHECK(undisturbed > 0);
}

}  // namespace test_writes
