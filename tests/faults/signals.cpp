// Signals at any time during a render: output files are complete or missing. SIGINT and SIGTERM leave nothing else.
// SIGKILL may leave a temporary file, which has a recognisable name and is removed when the same file is written again.
#include <time.h>

#include "faults/support/child.hpp"
#include "support/uniform.hpp"

namespace test_signals {

using namespace phasetree::tests;

namespace {

std::string scene_with(int samples) {
    std::string text = tiny_scene;
    const std::string few = "\"samples\": 1";
    return text.replace(text.find(few), few.size(), "\"samples\": " + std::to_string(samples));
}

// An image of either kind ends as its format demands.
bool is_whole(const std::string& name, const std::string& bytes) {
    if (name == "a.png") return bytes.starts_with("\x89PNG") && bytes.ends_with(std::string("IEND\xae\x42\x60\x82", 8));
    return name == "b.exr" && bytes.starts_with("\x76\x2f\x31\x01") && bytes.size() > 400;
}

bool is_temporary(const std::string& name) {
    return name.starts_with(".") && name.find(".tmp") != std::string::npos;
}

void wait(double milliseconds) {
    const auto nanoseconds = static_cast<long>(1e6 * milliseconds);
    const timespec time{nanoseconds / 1'000'000'000, nanoseconds % 1'000'000'000};
    ::nanosleep(&time, nullptr);
}

}  // namespace

TEST_CASE("whole files or none") {
    Uniform random(5);
    const std::string scene = scene_with(20'000);  // a second or so, if nobody stops it
    const int times = long_tests() ? 300 : 25;
    int with_files = 0, without = 0;
    for (const int signal : {SIGINT, SIGTERM, SIGKILL})
        for (int i = 0; i < times; ++i) {
            const double milliseconds = 300 * static_cast<double>(random());
            const Ended ended = run_command(tiny_render, {}, {}, scene, [&](pid_t child) {
                wait(milliseconds);
                ::kill(child, signal);
            });
            CAPTURE(signal);
            CAPTURE(milliseconds);
            CAPTURE(ended.err);
            // Before the render is ready for them, and with SIGKILL always, signals do what the system does.
            const int code = signal == SIGINT ? 130 : 1;  // there is no checkpoint to go on from
            CHECK((ended.code == 0 || ended.code == code || ended.signal == signal));
            for (const auto& [name, bytes] : ended.files) {
                const std::string file = name;  // Clang 14 cannot capture a binding
                CAPTURE(file);
                if (signal == SIGKILL && is_temporary(name)) continue;
                CHECK(is_whole(name, bytes));
            }
            if (ended.code > 0) CHECK(ended.err.find("interrupted") != std::string::npos);
            ++(ended.files.empty() ? without : with_files);
        }
    // Both were met.
    CHECK(with_files > 0);
    CHECK(without > 0);
}

}  // namespace test_signals
