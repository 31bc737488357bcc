// Standard input of `phasetree eval` and `phasetree trace`. The first byte of an input chooses.
#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <sstream>

#include "command/commands.hpp"
#include "fuzz/input_file.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree::fuzz {

namespace {

// Some of everything: corners, seams, thin layers, a warp, phases that touch.
constexpr std::string_view scene = R"({"version": 1,
 "phases": {"a": {"clear": {"ior": 1.5}}, "b": {"clear": {"ior": 1.3}}, "c": {"diffuse": {"color": [1, 1, 1]}}},
 "tree": {"under": [
   {"thin_shell": {"of": {"sphere": {"radius": 1}}, "shell": "a", "inside": "b", "half_thickness": 0.01}},
   {"set": {"phase": "c", "of": {"twist": {"rate": 90, "of": {"box": {"size": [0.5, 0.5, 3]}}}}}},
   {"set": {"phase": "b", "of": {"translate": {"by": [0, 0, 1.5], "of": {"octahedron": {"radius": 0.5}}}}}}]},
 "lights": [{"constant": {}}],
 "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]}}
)";

// What the commands print is theirs to print; a fuzzer's own messages go to standard error.
void silence_standard_output() {
    static const bool done = [] {
        const int nowhere = ::open("/dev/null", O_WRONLY);
        return nowhere >= 0 && ::dup2(nowhere, STDOUT_FILENO) >= 0;
    }();
    promised(done, "there is /dev/null");
}

}  // namespace

void run_lines(Bytes input) {
    static InputFile file("scene.json");
    static const std::string path =
        file.write({reinterpret_cast<const std::uint8_t*>(scene.data()), scene.size()}).string();
    if (input.empty()) return;
    silence_standard_output();
    CLI::App app("", "phasetree");
    tracer::Run run;
    tracer::add_eval(app, run);
    tracer::add_trace(app, run);
    std::istringstream lines{std::string(text_of(input.subspan(1)))};
    std::streambuf* const before = std::cin.rdbuf(lines.rdbuf());
    std::cin.clear();
    try {
        const char* const arguments[] = {"phasetree", input[0] % 2 == 0 ? "eval" : "trace", path.c_str()};
        app.parse(3, arguments);
        (void)run();
    } catch (const SceneError&) {
    }
    std::cin.rdbuf(before);
}

}  // namespace phasetree::fuzz
