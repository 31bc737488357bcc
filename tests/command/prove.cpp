// `phasetree check --prove`, and "unit" and "density" in scenes: verdicts, exit codes, places and defaults.
#include <csignal>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command.hpp"

namespace test_command_prove {

using namespace phasetree::tests;

namespace {

// A ball of glass with a radius of 10 around a smaller one of water.
std::string flask(const std::string& rest, const std::string& glass = R"({"clear": {"ior": 1.5}})") {
    return R"({"version": 1, )" + rest + R"(
"phases": {"glass": )" +
           glass + R"(, "water": {"clear": {"ior": 1.33}}},
"tree": {"thin_shell": {"of": {"sphere": {"radius": 9}}, "shell": "glass", "inside": "water", "half_thickness": 1}}})";
}

std::string expect(const std::string& statements) {
    return "\n\"expect\": [" + statements + "],";
}

struct Run : Shell {
    Outcome operator()(const std::string& scene, std::vector<std::string> words) const {
        write_text(directory / "scene.json", scene);
        words.insert(words.begin() + 1, "scene.json");
        return run(words);
    }
};

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("verdicts have the place of their statement, and decide the exit code") {
    const Run run;
    const Outcome right =
        run(flask(expect(
                R"({"wall": {"phase": "glass", "at_least": 1.2}}, {"closed": {"walls": "glass", "around": "water"}})")),
            {"check", "--prove", "--resolution", "0.3"});
    CHECK(right.code == 0);
    CHECK(has(right.out, R"(scene.json:2:12: proved: {"wall": {"phase": "glass", "at_least": 1.2}})"));
    CHECK(has(right.out, R"(proved: {"closed": {"walls": "glass", "around": "water"}})"));

    const Outcome wrong = run(flask(expect(R"({"closed": {"walls": "water", "around": "glass"}},
{"apart": {"phases": ["glass", "water"]}}, {"present": {"phase": "water"}})")),
                              {"check", "--prove", "--resolution", "0.3"});
    CHECK(wrong.code == 4);
    CHECK(has(wrong.out, "scene.json:2:12: refuted: "));
    CHECK(has(wrong.out, "a path leads outside; it begins in \"glass\" at ("));
    CHECK(has(wrong.out, "scene.json:3:1: refuted: "));
    CHECK(has(wrong.out, "they touch; see \"glass\" at ("));
    CHECK(has(wrong.out, "scene.json:3:44: proved: "));

    const Outcome open =
        run(flask(expect(R"({"wall": {"phase": "glass", "at_least": 2}})")), {"check", "--prove", "--resolution", "1"});
    CHECK(open.code == 5);
    CHECK(has(open.out, "undecided: "));
    CHECK(has(open.out, "the resolution is too coarse at boxes of "));
    CHECK(has(open.out, "choose a finer one with --resolution"));
}

TEST_CASE("a statement that takes several lines in the file is printed in one") {
    const Run run;
    const Outcome o = run(flask(expect(R"({ "wall": {  // the glass, not the
        "phase": "glass" /* the wall */, "at_least":
        1.2 } })")),
                          {"check", "--prove", "--resolution", "0.3"});
    CAPTURE(o.out);
    CHECK(has(o.out, R"(proved: {"wall": {"phase": "glass", "at_least": 1.2}})"));
}

TEST_CASE("volumes and masses are in the units of the statement, and the scene's unit and densities count") {
    const Run run;
    // 4/3 π 8³ mm³ of water are 2.145 ml.
    const std::string statements = expect(
        R"({"volume": {"phase": "water", "at_least": 2.1, "at_most": 2.2, "unit": "ml"}}, {"mass": {"phase": "glass", "at_most": 5.2, "unit": "g"}},
{"volume": {"phase": "water", "at_least": 2100, "at_most": 2200}}, {"volume": {"phase": "water", "at_least": 3, "unit": "ml"}})");
    const Outcome o = run(flask(R"("unit": "mm", )" + statements, R"({"clear": {"ior": 1.5}, "density": 2500})"),
                          {"check", "--prove", "--json"});
    CHECK(o.code == 4);
    std::size_t proved = 0;
    for (std::size_t at = o.out.find("\"proved\""); at != std::string::npos; at = o.out.find("\"proved\"", at + 1))
        ++proved;
    CHECK(proved == 3);
    CHECK(has(o.out, R"("unit": "ml")"));
}

TEST_CASE("without statements, phases are somewhere and in one piece, or not") {
    const Run run;
    const std::string two = R"({"phases": {"glass": null, "iron": null}, "tree": {"over": [
{"set": {"phase": "glass", "of": {"union": [{"sphere": {"radius": 1}}, {"translate": {"by": [3, 0, 0], "of": {"sphere": {"radius": 1}}}}]}}},
{"set": {"phase": "iron", "of": {"sphere": {"radius": 0.5}}}}]}})";
    const Outcome o = run(two, {"check", "--prove", "--resolution", "0.1"});
    CHECK(o.code == 0);
    CHECK(has(o.out, R"(proved: {"present":{"phase":"glass"}})"));
    CHECK(has(o.out, R"(refuted: {"connected":{"phase":"glass"}}: it has at least 2 pieces; see "glass" at ()"));
    CHECK(has(o.out, R"(refuted: {"present":{"phase":"iron"}}: no point has this phase)"));
}

TEST_CASE("measures use the unit and the densities of the scene, and options override them") {
    const Run run;
    const std::string dense = R"({"clear": {"ior": 1.5}, "density": 2500})";
    const std::vector<std::string> coarse{"measure", "--json", "--tolerance", "0.1"};
    const auto with = [&](std::vector<std::string> more) {
        std::vector<std::string> words = coarse;
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    const Outcome declared = run(flask(R"("unit": "mm",)", dense), coarse);
    CHECK(declared.code == 0);
    CHECK(has(declared.out, R"("density": 2500.0)"));
    CHECK(declared.out == run(flask(""), with({"--unit", "mm", "--density", "glass=2500"})).out);
    CHECK(run(flask(R"("unit": "mm",)", dense), with({"--unit", "cm", "--density", "glass=1"})).out ==
          run(flask(""), with({"--unit", "cm", "--density", "glass=1"})).out);
    CHECK(run(flask(""), coarse).out == run(flask(R"("unit": "m",)"), coarse).out);
    // The table is in the scene's unit, so the flask's lengths are the same numbers in each unit.
    const auto table = [&](const std::string& unit) {
        return run(flask(unit, dense), {"measure", "--tolerance", "0.1"}).out;
    };
    const std::string in_mm = table(R"("unit": "mm",)"), in_m = table("");
    CHECK(has(in_mm, " mm³ "));
    CHECK(has(in_mm, " kg mm² "));
    CHECK(has(in_mm, "area in mm²"));
    CHECK_FALSE(has(in_mm, " m "));
    const auto line_of = [](const std::string& text, const std::string& start) {
        const std::size_t begin = text.find(start);
        REQUIRE(begin != std::string::npos);
        const std::string line = text.substr(begin, text.find('\n', begin) - begin);
        return line.substr(line.find(" from "));
    };
    CHECK(line_of(in_mm, "  largest x") == line_of(in_m, "  largest x"));
    CHECK(line_of(in_mm, "  mass") != line_of(in_m, "  mass"));
    // So are volumes and areas. Masses follow from the density in kg/m³, and moments of inertia from masses.
    const auto lower_limit = [&](const std::string& text, const std::string& start) {
        return std::stod(line_of(text, start).substr(std::string(" from ").size()));
    };
    const double to_cubic_metres = 1e-9;  // of a cubic millimetre
    CHECK(lower_limit(in_mm, "  volume") == doctest::Approx(lower_limit(in_m, "  volume")).epsilon(1e-6));
    CHECK(lower_limit(in_mm, "  mass") == doctest::Approx(to_cubic_metres * lower_limit(in_m, "  mass")).epsilon(1e-6));
    CHECK(lower_limit(in_mm, "  inertia xx") ==
          doctest::Approx(to_cubic_metres * lower_limit(in_m, "  inertia xx")).epsilon(1e-6));
}

TEST_CASE("files whose unit is fixed have lengths in it") {
    const Run run;
    const auto exported = [&](const std::string& unit, const std::string& file, const std::string& scale) {
        std::vector<std::string> words{"export", "-o", file, "--spacing", "4"};
        if (!scale.empty()) words.insert(words.end(), {"--scale", scale});
        CHECK(run(flask(unit), words).code == 0);
        return bytes_of(run.directory / file);
    };
    const bool is_3mf_equal = exported(R"("unit": "cm",)", "a.3mf", "") == exported("", "a.3mf", "10");
    CHECK(is_3mf_equal);
    const bool is_glb_equal = exported(R"("unit": "mm",)", "a.glb", "") == exported("", "a.glb", "0.001");
    CHECK(is_glb_equal);
    const bool is_scale_kept = exported(R"("unit": "mm",)", "a.glb", "2") == exported("", "a.glb", "2");
    CHECK(is_scale_kept);
    const bool is_stl_plain = exported(R"("unit": "mm",)", "a.stl", "") == exported("", "a.stl", "");
    CHECK(is_stl_plain);
}

TEST_CASE("mistakes in units, densities and statements are reported at their place, by every command") {
    const Run run;
    const std::string glass = R"({"clear": {"ior": 1.5}})";
    const std::vector<std::pair<std::string, std::string>> wrong{
        {flask(R"("unit": "furlong",)"), "\"unit\" must be \"mm\", \"cm\", \"m\" or \"in\", but is \"furlong\""},
        {flask(R"("unit": 3,)"), "\"unit\""},
        {flask("", R"({"clear": {"ior": 1.5}, "density": -1})"), "\"density\""},
        {flask("", R"({"clear": {"ior": 1.5}, "diffuse": {}, "density": 1})"), "a phase must have one material"},
        {flask("", R"({"cleer": {"ior": 1.5}, "density": 1})"), "a material cannot be of the kind \"cleer\""},
        {flask(R"("expect": 3,)"), "\"expect\" must be a list of statements"},
        {flask(expect(R"({"wal": {}})")), "a statement cannot be of the kind \"wal\""},
        {flask(expect(R"({"wall": {"phase": "glas", "at_least": 1}})")),
         "unknown phase \"glas\" (did you mean \"glass\"?)"},
        {flask(expect(R"({"wall": {"phase": "glass", "at_least": 1, "reach": 0.4}})")),
         "\"reach\" must be more than half of \"at_least\", 0.5"},
        {flask(expect(R"({"apart": {"phases": ["glass", "glass"]}})")), "must name two different phases"},
        {flask(expect(R"({"closed": {"walls": "glass", "around": "vacuum"}})")),
         "the vacuum, which surrounds the object"},
        {flask(expect(R"({"closed": {"walls": "glass", "around": ["water", "glass"]}})")), "both a wall and inside"},
        {flask(expect(R"({"volume": {"phase": "glass"}})")), "needs \"at_least\", \"at_most\" or both"},
        {flask(expect(R"({"volume": {"phase": "glass", "at_least": 2, "at_most": 1}})")), "must not be less than"},
        {flask(expect(R"({"mass": {"phase": "glass", "at_most": 1}})")), "the phase \"glass\" has no density"},
    };
    for (const auto& [scene, message] : wrong) {
        CAPTURE(message);
        for (const std::vector<std::string>& command : {std::vector<std::string>{"check", "--prove"}, {"info"}}) {
            const Outcome o = run(scene, command);
            CHECK(o.code == 2);
            CHECK(has(o.err, "scene.json:"));
            CHECK(has(o.err, message));
        }
    }
    CHECK(has(run(flask(""), {"check", "--json"}).err, "--json requires --prove"));
}

TEST_CASE("Ctrl-C at any moment ends proofs and measurements at once, with what is known by then") {
    const Run run;
    write_text(run.directory / "scene.json", flask(expect(R"({"wall": {"phase": "glass", "at_least": 2}})")));
    struct Command {
        std::vector<std::string> words;
        std::string known;  // printed however early the interruption comes, unless the scene is still being read
    };
    for (const Command& c : {Command{{"check", "--prove", "--resolution", "0.002", "--time", "5m"}, "wall"},
                             Command{{"measure", "--tolerance", "1e-9", "--time", "5m"}, "glass"}}) {
        bool is_known = false;
        for (const double moment : {0.0, 0.02, 0.05, 0.1, 0.3, 0.8}) {
            std::optional<double> ready, sent;
            const auto interrupt = [&](pid_t process) {
                // Until the program is there, the process has the test's own handler of SIGINT.
                if (!ready && catches(process, SIGUSR1) && catches(process, SIGINT)) ready = processor_seconds(process);
                if (sent || !ready || processor_seconds(process) < *ready + moment * sanitizer_slowdown) return;
                sent = processor_seconds(process);
                ::kill(process, SIGINT);
            };
            std::vector<std::string> words = c.words;
            words.insert(words.begin() + 1, "scene.json");
            const Outcome o = run.run(words, "", interrupt);
            INFO(c.words[0], " after ", moment, " s: ", o.out, o.err);
            CHECK(o.code == 130);
            REQUIRE(sent);
            CHECK(o.processor_seconds < *sent + 1.5 * sanitizer_slowdown);
            if (has(o.err, "interrupted while the scene was being read; nothing is known yet")) {
                CHECK(o.out.empty());
                continue;
            }
            is_known = true;
            CHECK(has(o.err, "interrupted; printed what was known by then"));
            CHECK(has(o.out, c.known));
            if (c.words[0] == "check") CHECK(has(o.out, "undecided: "));
        }
        CHECK(is_known);
    }
}

}  // namespace test_command_prove
