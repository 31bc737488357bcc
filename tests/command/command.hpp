// Runs `phasetree` as a user does: in a directory of its own, with arguments and standard input.
#pragma once

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "phasetree_support/temporary_directory.hpp"
#include "support/sanitizers.hpp"

namespace phasetree::tests {

using support::bytes_of;
using support::TemporaryDirectory;
using support::write_text;

// How long an error may take, in seconds of processor time. The promise is one; a machine that runs other things too
// gets a few more.
inline constexpr double at_once = 5 * sanitizer_slowdown;

struct Outcome {
    int code = -1;   // exit code; −1 if a signal ended it
    int signal = 0;  // that signal; SIGKILL also for a run that was given up
    std::string out, err;
    double seconds = 0;
    double processor_seconds = 0;  // wall-clock time on a busy machine says nothing about the program
    double peak_megabytes = 0;     // of memory that was there at once
};

// What a process has used of the processors so far, all threads together; 0 of one that has ended.
inline double processor_seconds(pid_t process) {
    const std::string stat = bytes_of("/proc/" + std::to_string(process) + "/stat");
    // Fields after the name, which may contain anything, starting with the third. The 14th and 15th are clock ticks.
    std::istringstream fields(stat.substr(std::min(stat.rfind(')') + 1, stat.size())));
    std::string field;
    double ticks = 0;
    for (int i = 3; i <= 15 && fields >> field; ++i)
        if (i >= 14) ticks += std::stod(field);
    return ticks / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

// Whether a process has a handler of its own for a signal by now.
inline bool catches(pid_t process, int signal) {
    std::istringstream status(bytes_of("/proc/" + std::to_string(process) + "/status"));
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("SigCgt:")) return (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1)) & 1;
    return false;
}

// No run of the command in a test works for longer than a few seconds. On a machine that is busy otherwise it may wait
// for the processors much longer than that.
inline constexpr auto give_up_after = std::chrono::seconds(60 * sanitizer_slowdown);
inline constexpr int waiting_per_work = 10;

// Without the lines that begin so.
inline std::string without_lines(const std::string& text, std::string_view begin) {
    std::istringstream lines(text);
    std::string rest;
    for (std::string line; std::getline(lines, line);)
        if (!line.starts_with(begin)) rest += line + "\n";
    return rest;
}

// Starting `phasetree` takes a quarter of a second of processor time, nearly all of it in the dynamic loader, because
// Debian's OpenImageIO depends on 200 libraries. In test-command, a forked child therefore calls this function, which
// is all that main() does, instead of executing the program. nullptr in other executables.
using CommandMain = int (*)(int argc, char** argv);
extern const CommandMain command_main;

inline std::ptrdiff_t thread_count() {
    const std::filesystem::directory_iterator tasks("/proc/self/task");
    return std::distance(begin(tasks), end(tasks));
}

// Some libraries start threads when they are loaded, which then wait. A forked child does without them.
inline const std::ptrdiff_t threads_of_libraries = thread_count();

// Gives all signals their default effect again, as executing a program does: doctest handles some of them.
inline void reset_signals() {
    for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_DFL);
}

// A directory for scenes and images, and the command run there.
class Shell {
  public:
    // `meanwhile` is called every few milliseconds with the process's id.
    Outcome run(const std::vector<std::string>& arguments, const std::string& input = "",
                const std::function<void(pid_t)>& meanwhile = {}) const {
        // Outside of the directory, whose entries are counted.
        const TemporaryDirectory streams;
        write_text(streams / "in", input);
        const std::string in = streams / "in", out = streams / "out", err = streams / "err";
        std::vector<std::string> words{PHASETREE_COMMAND};
        words.insert(words.end(), arguments.begin(), arguments.end());
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);

        // If the test itself has used threads, a forked child could wait for them.
        const bool executes =
            executes_program || in_child || under_sanitizer || !command_main || thread_count() != threads_of_libraries;
        const auto start = std::chrono::steady_clock::now();
        std::cout.flush();
        std::fflush(nullptr);
        const pid_t child = ::fork();
        REQUIRE(child >= 0);
        if (child == 0) {
            reset_signals();
            const bool ready = ::chdir(directory.path().c_str()) == 0 &&
                               ::dup2(::open(in.c_str(), O_RDONLY), STDIN_FILENO) >= 0 &&
                               ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO) >= 0 &&
                               ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO) >= 0;
            if (ready) {
                for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
                if (environment.empty()) ::unsetenv("OCIO");
                if (in_child) in_child();
                if (executes) ::execv(argv[0], argv.data());
                const int code = command_main(static_cast<int>(words.size()), argv.data());
                std::cout.flush();
                std::fflush(nullptr);
                ::_exit(code);  // without destructors of libraries, which join their threads
            }
            ::_exit(127);
        }
        int status = 0;
        rusage used{};
        while (::wait4(child, &status, WNOHANG, &used) == 0) {
            if (meanwhile) meanwhile(child);
            if (std::chrono::steady_clock::now() - start > waiting_per_work * patience ||
                processor_seconds(child) > static_cast<double>(patience.count()))
                ::kill(child, SIGKILL);
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        Outcome outcome;
        const auto seconds = [](const timeval& t) {
            return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
        };
        outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        outcome.processor_seconds = seconds(used.ru_utime) + seconds(used.ru_stime);
        outcome.peak_megabytes = static_cast<double>(used.ru_maxrss) / 1024;
        if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
        if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
        outcome.out = bytes_of(out);
        outcome.err = bytes_of(err);
        // TBB warns of the limit that thread_sanitizer/embree_device.cpp sets.
        if (under_sanitizer) outcome.err = without_lines(outcome.err, "TBB Warning:");
        return outcome;
    }

    TemporaryDirectory directory;
    std::vector<std::pair<std::string, std::string>> environment;
    std::chrono::seconds patience = give_up_after;
    bool executes_program = false;   // always executes the program, for tests that measure memory
    std::function<void()> in_child;  // called just before the program is executed
};

// A scene that renders quickly; the parts may be replaced.
struct SceneText {
    std::string phases;  // without any, those that the tree and the shapes name
    std::string shapes = R"({"ball": {"sphere": {"radius": 1}}})";
    std::string tree = R"({"set": {"phase": "glass", "of": "ball"}})";
    std::string lights = R"([{"constant": {}}])";
    std::string camera = R"({"position": [0, -5, 0], "look_at": [0, 0, 0]})";
    std::string rest = R"("render": {"width": 24, "height": 16, "samples": 2})";

    std::string text() const {
        return "{\"version\": 1,\n\"phases\": " + (phases.empty() ? named_phases() : phases) +
               ",\n\"shapes\": " + shapes + ",\n\"tree\": " + tree + ",\n\"lights\": " + lights +
               ",\n\"camera\": " + camera + (rest.empty() ? "" : ",\n" + rest) + "}\n";
    }

  private:
    std::string named_phases() const {
        std::string all = R"("glass": {"clear": {"ior": 1.5}})";
        const auto is_named = [&](const char* name) { return (tree + shapes).find(name) != std::string::npos; };
        if (is_named("\"water\"")) all += R"(, "water": {"clear": {"ior": 1.33}})";
        if (is_named("\"wood\"")) all += R"(, "wood": {"diffuse": {"color": [0.5, 0.4, 0.3]}})";
        return "{" + all + "}";
    }
};

}  // namespace phasetree::tests
