// `phasetree solve`: it finds what closed forms give, its bracket is certain, it does not depend on threads, it keeps
// the rest of the file, and mistakes are reported in words.
#include <sched.h>

#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <optional>

#include "command.hpp"
#include "support/long_tests.hpp"

namespace test_solve {

using namespace phasetree::tests;

namespace {

constexpr double pi = 3.141592653589793;

// A ball of glass, and a cylinder of water of radius 0.03 m from z = −0.1 m up to a level. Comments and the layout are
// there to be kept.
constexpr const char* scene = R"({"version": 1, "phases": {"glass": null, "water": null},  // a comment
  "shapes": {"ball": {"sphere": {"radius":    0.05 /* metres */}},
             "level": {"plane": {"offset": 5e-2}}},
  "tree": {"over": [
    {"translate": {"by": [0.5, 0, 0], "of": {"set": {"phase": "glass", "of": "ball"}}}},
    {"intersect_shape": {"of": {"set": {"phase": "water", "of": {"cylinder": {"radius": 0.03, "height": 0.2}}}},
                         "shape": "level"}}]}
}
)";

struct SolveShell : Shell {
    SolveShell() { write_text(directory / "scene.json", scene); }
    Outcome solve(const std::vector<std::string>& more) const {
        std::vector<std::string> words{"solve", "scene.json"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
};

// Checks what is certain of the solution: the number lies in the bracket, and the intervals at its ends are on
// different sides of the target.
nlohmann::json checked(const Outcome& o, double number) {
    CAPTURE(o.err);
    CAPTURE(o.out);
    REQUIRE(o.code == 0);
    const nlohmann::json found = nlohmann::json::parse(o.out);
    const double target = found["target"];
    const auto &low = found["low"], &high = found["high"], &value = found["value"];
    // Up to the rounding errors of 32-bit coordinates.
    CHECK(low["at"].get<double>() <= number * (1 + 1e-6));
    CHECK(high["at"].get<double>() >= number * (1 - 1e-6));
    CHECK(low["at"] <= value["at"]);
    CHECK(value["at"] <= high["at"]);
    const bool rises = low["measure"]["high"].get<double>() < target;
    if (!rises) CHECK(low["measure"]["low"].get<double>() > target);
    CHECK((rises ? high["measure"]["low"].get<double>() > target : high["measure"]["high"].get<double>() < target));
    return found;
}

double width_of(const nlohmann::json& found) {
    return found["high"]["at"].get<double>() - found["low"]["at"].get<double>();
}

}  // namespace

TEST_CASE("solutions are those of closed forms") {
    const SolveShell shell;
    struct Known {
        std::string number, quantity;
        double solution, width;
        std::vector<std::string> more{};
    };
    const double ball = std::cbrt(330e-6 * 3 / (4 * pi));
    // The radius of the cylinder whose level is 0.05 m.
    const double cylinder = std::sqrt(500e-6 / (pi * 0.15));
    // Levels take long, because the ends of the cylinder are measured, too.
    const double coarse = long_tests() ? 1.8e-4 : 1e-3;
    const std::vector<std::string> few{"--tolerance", long_tests() ? "1.8e-4" : "1e-3"};
    const std::vector<Known> all{
        {"/shapes/ball/sphere/radius", "volume(glass) = 330 ml", ball, 7.5e-5},
        {"/shapes/ball/sphere/radius=0.01:0.09", "volume(glass)=0.33l", ball, 8e-5},
        {"/shapes/ball/sphere/radius=0.01:0.09", "volume(glass) = 33 cL", ball, 1e-3, {"--tolerance", "1e-3"}},
        {"/shapes/ball/sphere/radius", " volume( glass ) = 3.3e-4 ", ball, 1e-3, {"--tolerance", "1e-3"}},
        {"/shapes/ball/sphere/radius",
         "mass(glass) = 825 g",
         ball,
         1e-3,
         {"--density", "glass=2500", "--tolerance", "1e-3"}},
        // In millimetres, the same numbers are a thousandth as long.
        {"/shapes/ball/sphere/radius",
         "volume(glass) = 3.3e-4 mm³",
         ball,
         1e-3,
         {"--unit", "mm", "--tolerance", "1e-3"}},
        {"/shapes/level/plane/offset=-0.09:0.09", "volume(water) = 400 ml", 400e-6 / (pi * 9e-4) - 0.1, coarse, few},
        {"/tree/over/1/intersect_shape/of/set/of/cylinder/radius",
         "volume(water) = 500 cm3",
         cylinder,
         1e-3,
         {"--tolerance", "1e-3"}},
        {"/shapes/level/plane/offset=-0.09:0.09", "volume(total) = 1000 ml",
         (1000e-6 - 4 * pi / 3 * 0.05 * 0.05 * 0.05) / (pi * 9e-4) - 0.1, coarse, few}};
    for (const Known& k : all) {
        CAPTURE(k.quantity);
        std::vector<std::string> words{"--set", k.number, "--until", k.quantity, "--json"};
        words.insert(words.end(), k.more.begin(), k.more.end());
        const nlohmann::json found = checked(shell.solve(words), k.solution);
        CHECK(found["stopped"] == "tolerance");
        CHECK(width_of(found) <= k.width * (1 + 1e-9));
        CHECK(found["number"] == k.number.substr(0, k.number.find('=')));
        CHECK(found["undecided"].is_null());
    }
}

TEST_CASE("a target that is met exactly in the middle of the bracket is found nevertheless") {
    const SolveShell shell;
    // The first number that is tried is the solution, for which no interval decides.
    const std::string target = "volume(water) = " + std::to_string(1e6 * pi * 9e-4 * 0.1) + " ml";
    const Outcome o = shell.solve({"--set", "/shapes/level/plane/offset=-0.08:0.08", "--until", target, "--json"});
    CAPTURE(o.out);
    REQUIRE(o.code == 0);
    const nlohmann::json found = nlohmann::json::parse(o.out);
    CHECK(found["stopped"] == "tolerance");
    CHECK(found["low"]["at"].get<double>() < 1e-8);
    CHECK(found["high"]["at"].get<double>() > -1e-8);
    CHECK(width_of(found) <= 1.6e-4);
}

TEST_CASE("a cap of a ball has the volume of the closed form, and the rest of the file is kept") {
    const SolveShell shell;
    std::string text =
        R"({"version": 1, "phases": {"é\u0041": null}, /* é */ "tree": {"intersect_shape": {"shape": {"plane": {"offset" : 1.50e0}},
        "of": {"set": {"phase": "é\u0041", "of": {"sphere": {"radius": 2}}}}}}} // the end)";
    write_text(shell.directory / "scene.json", text);
    const double h = 2.5, cap = pi * h * h * (6 - h) / 3;
    const Outcome o = shell.solve({"--set", "/tree/intersect_shape/shape/plane/offset=-1:1.5", "--until",
                                   "volume(éA) = " + std::to_string(cap), "-o", "solved.json", "--json"});
    const nlohmann::json found = checked(o, 0.5);
    CHECK(width_of(found) <= 2.5e-3);
    const std::string written = bytes_of(shell.directory / "solved.json");
    const std::size_t at = text.find("1.50e0");
    const std::string before = text.substr(0, at), after = text.substr(at + 6);
    CHECK(written.starts_with(before));
    CHECK(written.ends_with(after));
    const std::string number = written.substr(at, written.size() - after.size() - at);
    CHECK(std::stod(number) == found["value"]["at"].get<double>());
    CHECK(number.size() < 10);  // It has few digits.
    CHECK(bytes_of(shell.directory / "scene.json") == text);
}

TEST_CASE("a volume that falls is found as well") {
    const SolveShell shell;
    // What is above the level.
    std::string falling = scene;
    falling.replace(falling.find("{\"offset\""), 1, "{\"normal\": [0, 0, -1], ");
    write_text(shell.directory / "scene.json", falling);
    const nlohmann::json found = checked(
        shell.solve({"--set", "/shapes/level/plane/offset=-0.09:0.09", "--until", "volume(water) = 200 ml", "--json"}),
        200e-6 / (pi * 9e-4) - 0.1);
    CHECK(found["stopped"] == "tolerance");
}

TEST_CASE("numbers that the scene does not allow are reported") {
    const SolveShell shell;
    write_text(shell.directory / "scene.json", R"({"phases": {"glass": null}, "tree": {"set": {"phase": "glass", "of":
        {"grid": {"count_x": 2, "count_y": 1, "count_z": 1, "spacing": [3, 3, 3], "of": {"sphere": {"radius": 1}}}}}}})");
    const Outcome o = shell.solve({"--set", "/tree/set/of/grid/count_x=1:4", "--until", "volume(glass) = 10"});
    CAPTURE(o.err);
    CHECK(o.code == 2);
    CHECK(o.err.find("--set: the scene is invalid with 2.5 at /tree/set/of/grid/count_x: ") != std::string::npos);
}

TEST_CASE("the solution does not depend on threads") {
    SolveShell shell;
    const std::vector<std::string> words{
        "--set", "/shapes/ball/sphere/radius", "--until", "volume(total) = 800 ml", "--tolerance", "1e-3", "--json"};
    const Outcome several = shell.solve(words);
    shell.in_child = [] {
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(::sched_getcpu(), &one);
        ::sched_setaffinity(0, sizeof one, &one);
    };
    const Outcome alone = shell.solve(words);
    CHECK(alone.code == 0);
    CHECK(alone.out == several.out);
}

TEST_CASE("the table names the value, the bracket and what is certain") {
    const SolveShell shell;
    const Outcome o = shell.solve(
        {"--set", "/shapes/ball/sphere/radius", "--until", "volume(glass) = 330 ml", "--tolerance", "1e-3"});
    CHECK(o.code == 0);
    for (const char* part : {"scene               scene.json\n", "number              /shapes/ball/sphere/radius\n",
                             "target              volume(glass) = 330 ml\n", "the bracket is as narrow as requested",
                             "\nvalue ", "\nlower end ", "\nupper end ", "at least once in between."})
        CHECK(o.out.find(part) != std::string::npos);
}

TEST_CASE("a bracket that cannot be narrowed in the time is printed as it is") {
    const SolveShell shell;
    const Outcome o = shell.solve({"--set", "/shapes/ball/sphere/radius", "--until", "volume(glass) = 330 ml",
                                   "--tolerance", "1e-12", "--time", "1s", "--json"});
    const nlohmann::json found = checked(o, std::cbrt(330e-6 * 3 / (4 * pi)));
    CHECK(found["stopped"] != "tolerance");
    CHECK(width_of(found) < 1e-3);
    // Whatever ended it, the value was measured.
    CHECK(found["value"]["measure"]["low"].is_number());
    if (found["stopped"] == "undecided") {
        CHECK(found["undecided"]["measure"]["low"].get<double>() <= 330);
        CHECK(found["undecided"]["measure"]["high"].get<double>() >= 330);
    }
}

TEST_CASE("Ctrl-C prints the bracket so far and exits with 130") {
    const SolveShell shell;
    bool is_sent = false;
    std::optional<double> ready;
    const auto interrupt = [&](pid_t process) {
        if (!ready && catches(process, SIGINT)) ready = processor_seconds(process);
        if (is_sent || !ready || processor_seconds(process) < *ready + 0.5 * sanitizer_slowdown) return;
        is_sent = true;
        ::kill(process, SIGINT);
    };
    const Outcome o =
        shell.run({"solve", "scene.json", "--set", "/shapes/ball/sphere/radius", "--until", "volume(glass) = 330 ml",
                   "--tolerance", "1e-12", "--time", "5m", "--json", "-o", "solved.json"},
                  "", interrupt);
    CAPTURE(o.err);
    CAPTURE(o.out);
    CHECK(is_sent);
    CHECK(o.code == 130);
    CHECK(o.err.find("interrupted; printed what was known by then, and no file was written\n") != std::string::npos);
    const nlohmann::json found = nlohmann::json::parse(o.out);
    CHECK(found["stopped"] == "interrupted");
    CHECK(found["low"]["measure"]["high"].get<double>() < 330);
    CHECK(found["high"]["measure"]["low"].get<double>() > 330);
    CHECK(shell.directory.size() == 1);
}

TEST_CASE("the value of a keyframe is found at the time of the keyframe, or at --at") {
    const SolveShell shell;
    write_text(shell.directory / "scene.json", R"({"version": 1, "phases": {"glass": null},
"tree": {"set": {"phase": "glass", "of": {"sphere": {"radius": {"keys": [[0, 0.02], [2, 0.05]]}}}}}})");
    const std::string radius = "/tree/set/of/sphere/radius", until = "volume(glass) = 330 ml";
    const double found = std::cbrt(330e-6 * 3 / (4 * pi));
    const auto last = checked(shell.solve({"--set", radius + "/keys/1/1", "--until", until, "--json"}), found);
    CHECK(last["seconds"] == 2);
    const auto first = checked(
        shell.solve({"--set", radius + "/keys/0/1=0.01:0.1", "--until", until, "--json", "-o", "solved.json"}), found);
    CHECK(first["seconds"] == 0);
    CHECK(bytes_of(shell.directory / "solved.json").find("[2, 0.05]") != std::string::npos);
    // At 1 s the radius is the mean of both keys.
    const auto between = checked(shell.solve({"--set", radius + "/keys/1/1", "--until", until, "--json", "--at", "1"}),
                                 2 * found - 0.02);
    CHECK(between["seconds"] == 1);
    CHECK(shell.solve({"--set", radius + "/keys/1/1", "--until", until}).out.find("time                2 s\n") !=
          std::string::npos);

    const Outcome keyed = shell.solve({"--set", radius, "--until", until});
    CHECK(keyed.code == 2);
    CHECK(keyed.err.find("--set: \"" + radius + "\" has keyframes; choose the value of one of them: " + radius +
                         "/keys/0/1 (at 0 s), " + radius + "/keys/1/1 (at 2 s)\n") != std::string::npos);
    const Outcome time = shell.solve({"--set", radius + "/keys/1/0", "--until", until});
    CHECK(time.code == 2);
    CHECK(time.err.find("is the time of a keyframe; choose with --at SECONDS when the object is measured") !=
          std::string::npos);
    // The time of the last key decides how large the ball is at 1 s.
    (void)checked(shell.solve({"--set", radius + "/keys/1/0=1.01:40", "--until", until, "--json", "--at", "1"}),
                  0.03 / (found - 0.02));
}

TEST_CASE("mistakes are reported in words: one error, exit code 2, or 1 if output cannot be written") {
    const SolveShell shell;
    struct Mistake {
        std::vector<std::string> words;
        std::string message;
        int code = 2;
    };
    const std::string radius = "/shapes/ball/sphere/radius", until = "volume(glass) = 330 ml";
    const auto set = [&](const std::string& number) {
        return std::vector<std::string>{"--set", number, "--until", until};
    };
    const auto aim = [&](const std::string& quantity) {
        return std::vector<std::string>{"--set", radius, "--until", quantity};
    };
    const auto with = [&](std::vector<std::string> more) {
        std::vector<std::string> words{"--set", radius, "--until", until};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    const std::vector<Mistake> mistakes{
        {{}, "--set is required"},
        {{"--set", radius}, "--until is required"},
        {set(""), "must be the path of a number"},
        {set("shapes/ball"), "must be the path of a number"},
        {set("/shapes/ball~2"), "must be the path of a number"},
        {set("/shapes/bal/sphere/radius"), "--set: \"/shapes\" has no \"bal\" (did you mean \"ball\"?)"},
        {set("/shape/ball"), "--set: the scene has no \"shape\" (did you mean \"shapes\"?)"},
        {set("/shapes/ball/sphere/x"), "\"/shapes/ball/sphere\" has no \"x\" (it has radius)"},
        {set("/shapes/ball/sphere"), "is an object, not a number; it has radius"},
        {set(radius + "/0"), "\"/shapes/ball/sphere/radius\" is a number and has no \"0\""},
        {set("/tree/over"), "is an array, not a number; append the index of an item, such as /0"},
        {set("/tree/over/2"), "\"/tree/over\" is a list, whose items are 0 to 1, so it has no \"2\""},
        {set("/tree/over/-1"), "so it has no \"-1\""},
        {set("/tree/over/01"), "so it has no \"01\""},
        {set("/tree/over/99999999999999999999"), "so it has no \"99999999999999999999\""},
        {set("/version"), "version of the scene format"},
        {set("/tree/over/0/translate/by/1"), "is 0, so it gives no bracket; give one, as in "},
        {set(radius + "="), "the bracket must be LOW:HIGH"},
        {set(radius + "=1"), "the bracket must be LOW:HIGH"},
        {set(radius + "=nan:1"), "the bracket must be LOW:HIGH"},
        {set(radius + "=0:inf"), "the bracket must be LOW:HIGH"},
        {set(radius + "=0.1:0.2:0.3"), "the bracket must be LOW:HIGH"},
        {set(radius + "=0.2:0.1"), "must have two ends, the lower one first"},
        {set(radius + "=0.1:0.1"), "must have two ends, the lower one first"},
        {set(radius + "=-0.1:0.2"), "--set: the scene is invalid with -0.1 at /shapes/ball/sphere/radius: "},
        {set(radius + "=0.01:1e300"), "--set: the scene is invalid with 1e+300"},
        {set(radius + "=0.06:0.07"), "--set: no bracket: volume(glass) is from "},
        {set(radius + "=0.06:0.07"), "both are more than 330 ml"},
        {set(radius + "=0.01:0.02"), "both are less than 330 ml"},
        {set("/shapes/level/plane/offset=0:0.05"), "both are more than 330 ml"},
        {aim(""), "--until: must be like \"volume(water) = 330 ml\""},
        {aim("330 ml"), "--until: must be like"},
        {aim("volume(glass)"), "--until: must be like"},
        {aim("volume(glass = 3"), "--until: must be like"},
        {aim("area(glass) = 3"), "--until: must be like"},
        {aim("volume(glass) = ml"), "--until: must be like"},
        {aim("volume(glass) = nan"), "must be positive and finite"},
        {aim("volume(glass) = inf ml"), "must be positive and finite"},
        {aim("volume(glass) = -3 ml"), "must be positive and finite"},
        {aim("volume(glass) = 0"), "must be positive and finite"},
        {aim("volume(glass) = 1e-320 mm3"), "the value is too large or too small"},
        {aim("volume(glass) = 3 kg"), "unknown unit \"kg\" (choose from mm3, ml, cm3, cl, dl, l, dm3, m3)"},
        {aim("mass(glass) = 3 ml"), "a mass needs a density"},
        {aim("volume(glas) = 3 ml"), "--until: unknown phase \"glas\" (did you mean \"glass\"?)"},
        {aim("volume(vacuum) = 3 ml"), "--until: the vacuum has no volume"},
        {with({"--unit", "furlong"}), "--unit: unknown unit \"furlong\" (choose from mm, cm, m or in)"},
        {with({"--density", "glass=-1"}), "--density: must be PHASE=VALUE"},
        {with({"--tolerance", "0"}), "--tolerance"},
        {with({"--tolerance", "nan"}), "--tolerance"},
        {with({"--time", "0"}), "--time"},
        {with({"--object", "bottle"}), "--object: the scene has a single \"tree\""},
        {with({"-o", "scene.json"}), "would overwrite"},
        {with({"-o", "nowhere/solved.json"}), "nowhere/solved.json", 1},
        {with({"-o", "."}), "cannot write", 1}};
    for (const Mistake& m : mistakes) {
        CAPTURE(m.words);
        const Outcome o = shell.solve(m.words);
        CAPTURE(o.err);
        CHECK(o.code == m.code);
        CHECK(o.out == "");
        CHECK(o.err.find(m.message) != std::string::npos);
        CHECK(o.err.size() < 700);
        CHECK(shell.directory.size() == 1);
    }
}

TEST_CASE("a density cannot be the number, because it changes no shape") {
    const SolveShell shell;
    std::string dense = scene;
    dense.replace(dense.find("null"), 4, R"({"clear": {"ior": 1.5}, "density": 2500})");
    write_text(shell.directory / "scene.json", dense);
    const Outcome o = shell.solve({"--set", "/phases/glass/density=500:5000", "--until", "mass(glass) = 1 kg"});
    CHECK(o.code == 2);
    CHECK(o.err.find("--set: /phases/glass/density is a density and changes no shape") != std::string::npos);
}

TEST_CASE("without a value, no scene is written, and the exit code says so") {
    const SolveShell shell;
    const Outcome o = shell.solve({"--set", "/shapes/ball/sphere/radius", "--until", "volume(glass) = 330 ml", "--time",
                                   "0.000001s", "-o", "solved.json"});
    CAPTURE(o.err);
    CHECK(o.code == 1);
    CHECK(o.err.find("no value is known yet") != std::string::npos);
    CHECK(!std::filesystem::exists(shell.directory / "solved.json"));
}

TEST_CASE("a scene is not written to a folder from which it would not find its files") {
    const SolveShell shell;
    std::filesystem::create_directory(shell.directory / "other");
    write_text(shell.directory / "glass.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    write_text(shell.directory / "scene.json", R"({"phases": {"glass": null}, "tree": {"scale": {"factor": 2, "of":
        {"set": {"phase": "glass", "of": {"mesh": {"file": "glass.obj"}}}}}}})");
    const std::vector<std::string> words{
        "--set", "/tree/scale/factor", "--until", "volume(glass) = 3", "--tolerance", "0.1", "-o"};
    const auto solve_into = [&](const std::string& file) {
        std::vector<std::string> all = words;
        all.push_back(file);
        return shell.solve(all);
    };
    const Outcome elsewhere = solve_into("other/solved.json");
    CHECK(elsewhere.code == 2);
    CHECK(elsewhere.err.find("the scene names \"glass.obj\", relative to its own folder") != std::string::npos);
    const Outcome beside = solve_into("solved.json");
    CAPTURE(beside.err);
    CHECK(beside.code == 0);
    CHECK(shell.run({"info", "solved.json"}).code == 0);
}

}  // namespace test_solve
