// The corpus of a target and mutations of it, without libFuzzer: replay TARGET CORPUS, or replay TARGET FILE… for what
// a fuzzer has found. The same inputs in every run. If one of them ends the process, it lies in the file that is named.
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <oneapi/tbb/global_control.h>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz/mutate.hpp"
#include "fuzz/words.hpp"
#include "support/long_tests.hpp"

using namespace phasetree::fuzz;

namespace {

// Of the input that is being run, for a signal's handler, which has no context.
std::string current;
std::string found_path;

void say(const char* text) {
    if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

extern "C" void phasetree_keep_finding(int signal) {
    const int file = ::open(found_path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const bool kept = file >= 0 && ::write(file, current.data(), current.size()) >= 0;
    say(signal == SIGXCPU ? "an input took too long" : "an input ended the process");
    say(kept ? "; it is in " : "; it cannot be written to ");
    say(found_path.c_str());
    say("\n");
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

double processor_seconds() {
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec); };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
}

// An input is worth milliseconds; whatever machine this is, one of this many seconds is a finding.
constexpr rlim_t longest_seconds = 60;

void run(const Target& target, std::string input) {
    current = std::move(input);
    const auto end = static_cast<rlim_t>(processor_seconds()) + longest_seconds;
    const rlimit limit{end, RLIM_INFINITY};
    ::setrlimit(RLIMIT_CPU, &limit);
    target.run({reinterpret_cast<const std::uint8_t*>(current.data()), current.size()});
}

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

int main(int count, char** arguments) {
    if (count < 3) {
        std::fprintf(stderr, "usage: replay TARGET CORPUS | replay TARGET FILE…\n");
        return 2;
    }
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Target& target = phasetree::fuzz::target(arguments[1]);
    found_path = (std::filesystem::temp_directory_path() / ("phasetree-found-" + std::string(target.name))).string();
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU})
        std::signal(signal, phasetree_keep_finding);

    std::vector<std::filesystem::path> files;
    bool is_corpus = false;
    for (int i = 2; i < count; ++i) {
        if (!std::filesystem::is_directory(arguments[i])) {
            files.emplace_back(arguments[i]);
            continue;
        }
        is_corpus = true;
        for (const auto& entry : std::filesystem::directory_iterator(arguments[i])) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    std::vector<std::string> inputs;
    for (const auto& file : files) inputs.push_back(bytes_of(file));
    if (inputs.empty()) {
        std::fprintf(stderr, "there are no inputs\n");
        return 2;
    }
    for (const std::string& input : inputs) run(target, input);
    if (!is_corpus) return 0;

    const std::vector<std::string> known = words();
    const std::size_t times = phasetree::tests::long_tests() ? 40 : 1;
    const std::size_t most = times * target.replayed;
    Random random(1);
    for (std::size_t i = 0; i < most; ++i) {
        std::string input = random.of(inputs);
        for (std::size_t changes = random.below(4) + 1; changes-- > 0;)
            input = mutated(input, target.inputs, known, random);
        if (input.size() > target.longest) input.resize(target.longest);
        run(target, std::move(input));
    }
    std::fprintf(stderr, "%zu inputs and %zu mutations of them\n", inputs.size(), most);
    return 0;
}
