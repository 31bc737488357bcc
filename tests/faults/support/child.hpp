// Runs the command in a process of its own, in which a fault is injected.
#pragma once

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "phasetree_support/temporary_directory.hpp"
#include "support/long_tests.hpp"

// The command's main().
int phasetree_main(int count, char** arguments);

namespace phasetree::tests {

using support::bytes_of;
using support::TemporaryDirectory;
using support::write_text;

// A scene with some of everything that is read and written, as small as can be.
inline constexpr const char* tiny_scene = R"({"version": 1,
"phases": {"glass": {"clear": {"ior": 1.5, "color": [0.9, 1, 0.9]}}, "water": {"clear": {"ior": 1.3}}, "wood": {"diffuse": {"color": {"wood": {}}}}},
"shapes": {"ball": {"sphere": {"radius": 1}}},
"tree": {"under": [
    {"thin_shell": {"of": "ball", "shell": "glass", "inside": "water", "half_thickness": 0.1}},
    {"set": {"phase": "wood", "of": {"scatter": {"of": {"sphere": {"radius": 0.1}}, "on": "ball", "count": 3}}}}]},
"meshes": [{"floor": {"height": -1.2, "material": {"diffuse": {"color": "#808080"}}}}],
"lights": [{"gradient": {"zenith": [1, 1, 1], "horizon": [0.5, 0.5, 0.5], "ground": [0.1, 0.1, 0.1]}},
           {"sphere": {"centre": [2, -2, 3], "radius": 0.5}}],
"camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]},
"render": {"width": 4, "height": 3, "samples": 1}})";

struct Ended {
    int code = -1;   // exit code; −1 if a signal ended it
    int signal = 0;  // that signal
    std::string out, err;
    std::size_t calls = 0;                     // what `after` told
    std::map<std::string, std::string> files;  // of its directory, but the scene
};

// Runs the command. Calls `before` in its process before main(), `after` there after main(), and `meanwhile` in this
// process.
inline Ended run_command(const std::vector<std::string>& arguments, const std::function<void()>& before = {},
                         const std::function<std::size_t()>& after = {}, const std::string& scene = tiny_scene,
                         const std::function<void(pid_t)>& meanwhile = {}) {
    const TemporaryDirectory directory, streams;
    write_text(directory / "scene.json", scene);
    const std::string out = streams / "out", err = streams / "err", told = streams / "told";
    std::vector<std::string> words{"phasetree"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::fflush(nullptr);
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL, SIGTERM, SIGINT})
            std::signal(signal, SIG_DFL);
        const rlimit seconds{30, 30}, none{0, 0};
        ::setrlimit(RLIMIT_CPU, &seconds);
        ::setrlimit(RLIMIT_CORE, &none);
        ::alarm(600);
        const bool ready = ::chdir(directory.path().c_str()) == 0 &&
                           ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO) >= 0 &&
                           ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO) >= 0;
        if (!ready) ::_exit(127);
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        if (before) before();
        // An exception that leaves main() ends the process.
        const int code = [&]() noexcept { return phasetree_main(static_cast<int>(words.size()), argv.data()); }();
        if (after) write_text(told, std::to_string(after()));
        std::fflush(nullptr);
        ::_exit(code);
    }
    if (meanwhile) meanwhile(child);
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    Ended ended;
    if (WIFEXITED(status)) ended.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) ended.signal = WTERMSIG(status);
    ended.out = bytes_of(out);
    ended.err = bytes_of(err);
    if (after && ended.signal == 0) ended.calls = std::stoul("0" + bytes_of(told));
    for (const auto& entry : std::filesystem::directory_iterator(directory.path()))
        if (entry.path().filename() != "scene.json") ended.files[entry.path().filename()] = bytes_of(entry.path());
    return ended;
}

// Whether each file is complete, equal to that of another run, and there are no others.
inline bool are_whole(const Ended& ended, const Ended& reference) {
    for (const auto& [name, bytes] : ended.files) {
        const auto whole = reference.files.find(name);
        if (whole == reference.files.end() || whole->second != bytes) return false;
    }
    return true;
}

inline const std::vector<std::string> tiny_render{"render", "scene.json", "-o", "a.png",  "-o",
                                                  "b.exr",  "--threads",  "1",  "--quiet"};

}  // namespace phasetree::tests
