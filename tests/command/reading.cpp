// Before the first sample: progress of reading, and signals, which end the command at once.
#include <regex>

#include "command.hpp"

namespace test_reading {

using namespace phasetree::tests;

namespace {

// A scene that takes seconds to read, and is wrong at its end.
std::string long_scene(std::size_t megabytes) {
    std::string text = "{\"version\": 1, \"phases\": [";
    text.reserve((megabytes << 20) + 100);
    while (text.size() < megabytes << 20) text += "[0.123456,12,1,1,1],";
    return text + "0]}";
}

// Sends a signal as soon as the command has a handler for it. Before the command is there the test's own process has
// one, but none for SIGUSR1.
struct Signal {
    int number;
    bool is_sent = false;

    void operator()(pid_t child) {
        if (!is_sent && catches(child, SIGUSR1) && catches(child, number)) is_sent = ::kill(child, number) == 0;
    }
};

}  // namespace

TEST_CASE("a signal while the scene is read ends the command at once, with the code that is documented") {
    const Shell shell;
    write_text(shell.directory / "scene.json", long_scene(100));
    write_text(shell.directory / "there.part", "whatever it is");
    const std::vector<std::string> start{"--checkpoint", "a.part", "--resume", "a.part", "--or-start"};
    const std::vector<std::string> resume{"--resume", "there.part"};
    const std::vector<std::string> again{"--checkpoint", "a.part"};
    struct Case {
        int signal;
        std::vector<std::string> words;
        int code;
    };
    for (const Case& c :
         {Case{SIGINT, start, 130}, Case{SIGTERM, start, 75}, Case{SIGHUP, start, 75}, Case{SIGTERM, resume, 75},
          Case{SIGTERM, again, 1}, Case{SIGHUP, {}, 1}, Case{SIGINT, {}, 130}}) {
        CAPTURE(c.signal);
        CAPTURE(c.words);
        std::vector<std::string> words{"render", "scene.json", "-o", "a.exr", "--quiet"};
        words.insert(words.end(), c.words.begin(), c.words.end());
        Signal signal{c.signal};
        const Outcome o = shell.run(words, "", std::ref(signal));
        CHECK(signal.is_sent);
        CHECK(o.code == c.code);
        CHECK(o.signal == 0);
        CHECK(o.err == "phasetree: interrupted while the scene was being read; no file was written\n");
        CHECK(o.processor_seconds < 2);
        CHECK(shell.directory.size() == 2);
    }
}

TEST_CASE("SIGUSR1 while the scene is read ends nothing") {
    const Shell shell;
    write_text(shell.directory / "scene.json", long_scene(20));
    Signal signal{SIGUSR1};
    const Outcome o = shell.run({"render", "scene.json"}, "", std::ref(signal));
    CHECK(signal.is_sent);
    CHECK(o.code == 2);  // the scene is wrong
}

TEST_CASE("so does one while the scene is waited for on standard input") {
    // Nothing comes from a terminal that nobody types at.
    Shell waiting;
    waiting.in_child = [] {
        int ends[2];
        if (::pipe(ends) == 0) ::dup2(ends[0], STDIN_FILENO);
    };
    Signal signal{SIGTERM};
    const Outcome o = waiting.run({"render", "-", "-o", "a.exr", "--quiet"}, "", std::ref(signal));
    CHECK(o.code == 1);
    CHECK(o.err == "phasetree: interrupted while the scene was being read; no file was written\n");
}

TEST_CASE("reading that takes long shows how far it is, also where there is no terminal") {
    const Shell shell;
    write_text(shell.directory / "scene.json", long_scene(100));
    const Outcome o = shell.run({"render", "scene.json", "-o", "a.exr"});
    CAPTURE(o.err);
    CHECK(o.code == 2);
    CHECK(std::regex_search(o.err, std::regex("^reading the scene: 0%\n")));
    CHECK(std::regex_search(o.err, std::regex("\nreading the scene: [5-9][05]%, [0-9]:[0-9]+ elapsed, ETA [0-9]")));
    CHECK(shell.run({"render", "scene.json", "-o", "a.exr", "--quiet"}).err.find("reading") == std::string::npos);
}

}  // namespace test_reading
