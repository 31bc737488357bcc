// The outcome of a run if something outside fails: a disk, a terminal, threads. Also what `check` says about scenes
// that are not sufficient for a picture.
#include <fmt/format.h>
#include <grp.h>

#include <filesystem>
#include <regex>

#include "command.hpp"

namespace test_outcomes {

using namespace phasetree::tests;
namespace fs = std::filesystem;

namespace {

const std::string only_tree = R"({"version": 1, "phases": {"glass": 0},
"tree": )";

std::string tree_of(const std::string& shape, const std::string& more = "") {
    return only_tree + R"({"set": {"phase": "glass", "of": )" + shape + "}}" + more + "}\n";
}

}  // namespace

TEST_CASE("where one file cannot be written the others are, and the exit code is 1") {
    Shell shell;
    SceneText scene;
    // Something to see, so that floats take more room than bytes.
    scene.lights =
        R"([{"gradient": {"zenith": [1, 0.5, 0.2], "horizon": [0.2, 0.3, 0.9], "ground": [0.1, 0.2, 0.1]}}])";
    scene.rest = R"("render": {"width": 120, "height": 80, "samples": 1})";
    write_text(shell.directory / "scene.json", scene.text());
    REQUIRE(shell.run({"render", "scene.json", "-o", "whole.exr", "-o", "whole.jpg", "--quiet"}).code == 0);
    const auto large = fs::file_size(shell.directory / "whole.exr"),
               small = fs::file_size(shell.directory / "whole.jpg");
    REQUIRE(large > 2 * small);
    // As a disk does on which there is room for the small file.
    shell.in_child = [&] {
        const rlimit limit{small + 1000, small + 1000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    };
    for (const bool large_first : {true, false}) {
        const Outcome o = shell.run({"render", "scene.json", "-o", large_first ? "a.exr" : "a.jpg", "-o",
                                     large_first ? "a.jpg" : "a.exr", "--stats", "a.json", "--quiet"});
        CAPTURE(o.err);
        CHECK(o.code == 1);
        CHECK(o.signal == 0);
        CHECK(o.err == "phasetree: cannot write \"a.exr\": File too large\n");
        CHECK(bytes_of(shell.directory / "a.jpg") == bytes_of(shell.directory / "whole.jpg"));
        CHECK(bytes_of(shell.directory / "a.json").size() > 100);
        CHECK(shell.directory.size() == 5);  // no half file, and no temporary one
        fs::remove(shell.directory / "a.jpg");
        fs::remove(shell.directory / "a.json");
    }
    // The exit code is the same if this is found out before rendering, and then no file is written.
    CHECK(shell.run({"render", "scene.json", "-o", "nowhere/a.exr", "-o", "a.jpg"}).code == 1);
    CHECK_FALSE(fs::exists(shell.directory / "a.jpg"));
}

TEST_CASE("a dangling symbolic link is followed") {
    const Shell shell;
    write_text(shell.directory / "scene.json", SceneText().text());
    fs::create_directory(shell.directory / "pictures");
    fs::create_symlink("pictures/second.png", shell.directory / "first.png");
    fs::create_symlink("third.png", shell.directory / "pictures/second.png");
    CHECK(shell.run({"render", "scene.json", "-o", "first.png", "--quiet"}).code == 0);
    CHECK(fs::is_symlink(shell.directory / "first.png"));
    CHECK(fs::is_symlink(shell.directory / "pictures/second.png"));
    CHECK(fs::is_regular_file(fs::symlink_status(shell.directory / "pictures/third.png")));
    fs::create_symlink("nowhere/a.png", shell.directory / "lost.png");
    CHECK(shell.run({"render", "scene.json", "-o", "lost.png", "--quiet"}).code == 1);
}

TEST_CASE("a terminal that goes away interrupts as Ctrl-C does, but not under nohup") {
    for (const bool ignored : {false, true}) {
        Shell shell;
        write_text(shell.directory / "scene.json", SceneText().text());
        shell.in_child = [&] { std::signal(SIGHUP, ignored ? SIG_IGN : SIG_DFL); };
        bool sent = false;
        const auto hang_up = [&](pid_t child) {
            if (sent || !catches(child, SIGTERM) || processor_seconds(child) < 0.7) return;
            sent = true;
            ::kill(child, SIGHUP);
            if (ignored) ::kill(child, SIGTERM);
        };
        const Outcome o =
            shell.run({"render", "scene.json", "-o", "a.exr", "--quiet", "--spp", "16000000"}, "", hang_up);
        CHECK(sent);
        CHECK(o.signal == 0);
        CHECK(o.code == 1);
        CHECK(o.err.find("interrupted") != std::string::npos);
        CHECK(bytes_of(shell.directory / "a.exr").size() > 500);
    }
}

TEST_CASE("threads that cannot be started: it is said, and fewer do the work" * doctest::skip(under_sanitizer)) {
    if (::geteuid() != 0) return;  // the limit is one of a user's, and this one has processes already
    Shell shell;
    fs::permissions(shell.directory.path(), fs::perms::all);
    write_text(shell.directory / "scene.json", SceneText().text());
    const Outcome whole = shell.run({"render", "scene.json", "-o", "a.exr", "--threads", "1"});
    REQUIRE(whole.code == 0);
    const std::string image = bytes_of(shell.directory / "a.exr");
    fs::permissions(shell.directory / "a.exr", fs::perms::all);
    int none = 0, fewer = 0;
    // Libraries that are loaded with the program may start threads of their own, before it begins.
    for (rlim_t most = 1; most <= 24; ++most) {
        CAPTURE(most);
        shell.in_child = [&] {
            const rlimit limit{most, most};
            ::setrlimit(RLIMIT_NPROC, &limit);
            if (::setgroups(0, nullptr) != 0 || ::setgid(54321) != 0 || ::setuid(54321) != 0) ::_exit(126);
        };
        if (shell.run({"--version"}).code != 0) continue;
        const Outcome o = shell.run({"render", "scene.json", "-o", "a.exr", "--quiet", "--threads", "20"});
        CAPTURE(o.err);
        CHECK(o.signal == 0);
        if (o.code == 1) {
            ++none;
            CHECK(o.err.find("phasetree: cannot start a second thread") == 0);
            continue;
        }
        CHECK(o.code == 0);
        if (o.err.empty()) continue;
        ++fewer;
        CHECK(std::regex_match(o.err, std::regex("phasetree: warning: only [0-9]+ of 20 threads can be started\n")));
        const bool same = bytes_of(shell.directory / "a.exr") == image;
        CHECK(same);
    }
    CHECK(none > 0);
    CHECK(fewer > 0);
}

TEST_CASE("check of a scene without a camera says what it is good for") {
    const Shell shell;
    const auto check = [&](const std::string& text) {
        write_text(shell.directory / "scene.json", text);
        return shell.run({"check", "scene.json"});
    };
    const Outcome o = check(tree_of(R"({"sphere": {"radius": 1}})"));
    CHECK(o.code == 3);
    CHECK(o.err == "");
    CHECK(o.out ==
          "scene.json: the tree is valid and can be used by eval, info, trace, measure, solve, slice, export and other "
          "programs; without a \"camera\" the scene cannot be rendered\n");
    CHECK(shell.run({"render", "scene.json"}).code == 2);
    for (const char* const command : {"eval", "trace", "info"}) CHECK(shell.run({command, "scene.json"}).code == 0);

    const Outcome unbounded = check(tree_of(R"({"plane": {}})"));
    CHECK(unbounded.code == 3);
    CHECK(
        unbounded.out.find("can be used by eval and info, but not traced, because the node in line 2, column 43 makes "
                           "it unbounded") != std::string::npos);
    CHECK(shell.run({"eval", "scene.json"}).code == 0);
    CHECK(shell.run({"trace", "scene.json"}).code == 2);

    // What there is must be right.
    struct Wrong {
        std::string text, message;
    };
    for (const Wrong& w :
         {Wrong{tree_of(R"({"sphere": {"radius": 0}})"), "scene.json:2:64: \"radius\" must be positive"},
          Wrong{tree_of(R"({"sphere": {"radius": 1}})", R"(, "camrea": {"a": 0})"), "did you mean \"camera\"?"},
          Wrong{tree_of(R"({"sphere": {"radius": 1}})", R"(, "lights": {"a": 0})"), "\"lights\" must be a list"},
          Wrong{tree_of(R"({"sphere": {"radius": 1}})", R"(, "meshes": {"a": 0})"), "\"meshes\" must be a list"},
          Wrong{tree_of(R"({"sphere": {"radius": 1}})", R"(, "render": {"width": 0})"), "\"width\" must be"},
          Wrong{tree_of(R"({"sphere": {"radius": 3e38}})"), "beyond what 32-bit floats can trace"},
          Wrong{"{\"version\": 7}", "\"version\" must be 1"}}) {
        const Outcome wrong = check(w.text);
        CAPTURE(wrong.err);
        CHECK(wrong.code == 2);
        CHECK(wrong.out == "");
        CHECK(wrong.err.find(w.message) != std::string::npos);
    }
}

TEST_CASE("an unbounded object is an error at the node that makes it unbounded") {
    const Shell shell;
    SceneText scene;
    scene.tree = R"({"over": [{"set": {"phase": "glass", "of": "ball"}},
        {"set": {"phase": "glass", "of": {"union": ["ball", {"plane": {}}, {"plane": {"offset": 1}}]}}}]})";
    write_text(shell.directory / "scene.json", scene.text());
    const std::string message =
        "this \"plane\" makes the object unbounded (as does \"plane\" at 5:77); intersect it with a box: "
        "{\"intersection\": {\"of\": [{\"plane\": …}, {\"box\": …}]}}\n";
    for (const char* const command : {"check", "render", "trace"}) {
        const Outcome o = shell.run({command, "scene.json"});
        CAPTURE(o.err);
        CHECK(o.code == 2);
        CHECK(o.err.starts_with("scene.json:5:62: " + message));
    }
    // In the file of one of several objects, or in the scene itself.
    write_text(shell.directory / "objects.json", R"({"version": 1, "phases": {"wood": {"diffuse": {}}}, "objects": [
        {"name": "floor", "file": "scene.json"}]})");
    CHECK(shell.run({"info", "objects.json"}).err.starts_with("scene.json:5:62: \"floor\": " + message));
    write_text(shell.directory / "objects.json", R"({"version": 1, "phases": {"wood": {"diffuse": {}}}, "objects": [
        {"name": "floor", "tree": {"strata": {"phases": ["wood", "wood"], "thicknesses": [1]}}}]})");
    const Outcome o = shell.run({"info", "objects.json"});
    CHECK(o.code == 2);
    CHECK(
        o.err.starts_with("objects.json:2:36: \"floor\": this \"strata\" makes the object unbounded; intersect it "
                          "with a box: {\"intersect_shape\": {\"of\": {\"strata\": …}, \"shape\": {\"box\": …}}}\n"));
}

TEST_CASE("an object of which nothing is left is worth a sentence") {
    const Shell shell;
    // Its box is not empty, and it is.
    SceneText scene;
    scene.tree = R"({"set": {"phase": "glass", "of": {"intersection": ["ball",
        {"translate": {"by": [1.8, 1, 0], "of": "ball"}}]}}})";
    const std::string warning =
        "scene.json:4:9: warning: the object is empty: everything has been cut away, so no ray hits it\n";
    write_text(shell.directory / "scene.json", scene.text());
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"check", "scene.json"}, {"render", "scene.json", "-o", "a.exr", "--quiet"}}) {
        const Outcome o = shell.run(words);
        CHECK(o.code == 0);
        CHECK(o.err.find(warning) == 0);
    }
    CHECK(shell.run({"info", "scene.json"}).out.find("the object is vacuum everywhere") != std::string::npos);
    CHECK(shell.run({"info", "scene.json", "--json"}).out.find("\"empty\": true") != std::string::npos);
    // So thin that no point of a grid is in it.
    scene.shapes = "{}";
    scene.tree = R"({"under": [{"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, 1], "of":
        {"box": {"size": [2, 2, 0.001]}}}}}}, {"set": {"phase": "glass", "of": {"box": {"size": [2, 2, 0.001]}}}}]})";
    write_text(shell.directory / "scene.json", scene.text());
    const Outcome thin = shell.run({"check", "scene.json"});
    CHECK(thin.code == 0);
    CHECK(thin.err == "");
    CHECK(shell.run({"info", "scene.json", "--json"}).out.find("\"empty\": false") != std::string::npos);
    // One whose very box is empty.
    write_text(shell.directory / "scene.json",
               tree_of(R"({"offset": {"distance": -2, "of": {"sphere": {"radius": 1}}}})"));
    CHECK(shell.run({"info", "scene.json"}).out.find("the object is vacuum everywhere") != std::string::npos);
    const Outcome none = shell.run({"check", "scene.json"});
    CHECK(none.code == 3);  // it has no camera
    CHECK(none.err.find("warning: the object is empty") != std::string::npos);
    // With a camera it is rendered, as a film may begin with nothing.
    scene.tree = R"({"set": {"phase": "glass", "of": {"offset": {"distance": -2, "of": {"sphere": {"radius": 1}}}}}})";
    write_text(shell.directory / "scene.json", scene.text());
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"check", "scene.json"}, {"render", "scene.json", "-o", "b.exr", "--quiet"}}) {
        const Outcome o = shell.run(words);
        CHECK(o.code == 0);
        CHECK(o.err.find("warning: the object is empty") != std::string::npos);
    }
    CHECK(std::filesystem::exists(shell.directory / "b.exr"));
}

TEST_CASE("check warns of a phase that is declared and nowhere") {
    const Shell shell;
    const std::string tree = R"(, "tree": {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}}})";
    write_text(shell.directory / "one.json", R"({"version": 1, "phases": {"a": {"clear": {"ior": 1.5}}})" + tree);
    write_text(shell.directory / "two.json",
               R"({"version": 1, "phases": {"a": {"clear": {"ior": 1.5}}, "b": {"clear": {"ior": 1.3}}})" + tree);
    const Outcome all = shell.run({"check", "one.json"}), some = shell.run({"check", "two.json"});
    CHECK(all.err == "");
    CHECK(some.code == all.code);
    CHECK(some.err.starts_with("two.json:1:57: warning: the phase \"b\" is declared but never used\n"));
}

TEST_CASE("check warns of shapes that are declared and used nowhere") {
    const Shell shell;
    const auto warnings = [&](const std::string& shapes) {
        write_text(shell.directory / "scene.json",
                   R"({"version": 1, "phases": {"a": {"clear": {"ior": 1.5}}}, "shapes": {)" + shapes +
                       R"(}, "tree": {"set": {"phase": "a", "of": "used"}}})");
        return shell.run({"check", "scene.json"}).err;
    };
    const std::string ball = R"({"sphere": {"radius": 1}})";
    CHECK(warnings("\"used\": " + ball) == "");
    CHECK(warnings("\"used\": \"ball\", \"ball\": " + ball) == "");
    CHECK(warnings("\"used\": " + ball + ", \"bell\": " + ball)
              .starts_with("scene.json:1:104: warning: the shape \"bell\" is declared but never used\n"));
    std::string many = "\"used\": " + ball;
    for (int i = 0; i < 20; ++i) many += ", \"s" + std::to_string(i) + "\": " + ball;
    CHECK(warnings(many).find("scene.json: warning: 12 more shapes are never used\n") != std::string::npos);
}

}  // namespace test_outcomes
