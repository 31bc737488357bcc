// Invalid arguments, variables and lines of numbers: one error message, exit code 2 (1 for output that cannot be
// written), and no files left behind. hostile.cpp tests invalid scene files.
#include <algorithm>

#include "command.hpp"

namespace test_wrong_arguments {

using namespace phasetree::tests;

TEST_CASE("wrong arguments: one error, exit code 2, or 1 if output cannot be written, and nothing left behind") {
    struct Arguments {
        std::vector<std::string> words;
        std::string message;
        int code = 2;
    };
    const std::vector<Arguments> wrong{
        {{"--size", "0x10"}, "--size"},
        {{"--size", "10"}, "--size"},
        {{"--size", "10x"}, "--size"},
        {{"--size", "axb"}, "--size"},
        {{"--size", "10x10x10"}, "--size"},
        {{"--size", "99999x1"}, "--size"},
        {{"--size", "99999999999999x1"}, "--size"},
        {{"--crop", "0,0,0,0"}, "--crop"},
        {{"--crop", "0,0,25,16"}, "--crop"},
        {{"--crop", "5,5,4,6"}, "--crop"},
        {{"--crop", "-1,0,5,5"}, "--crop"},
        {{"--crop", "1,2,3"}, "--crop"},
        {{"--crop", "1,2,3,4,5"}, "--crop"},
        {{"--crop", "a"}, "--crop"},
        {{"--threads", "0"}, "--threads"},
        {{"--threads", "-3"}, "--threads"},
        {{"--threads", "many"}, "--threads"},
        {{"--threads", "1000000000"}, "--threads"},
        {{"--build-quality", "best"}, "--build-quality: must be low or medium, but is \"best\""},
        {{"--build-quality", "0"}, "--build-quality: must be low or medium"},
        {{"--build-quality", ""}, "--build-quality"},
        {{"--spp", "0"}, "--spp"},
        {{"--spp", "1e3x"}, "--spp"},
        {{"--seed", "-1"}, "--seed"},
        {{"--exposure", "nan"}, "exposure"},
        {{"--exposure", "1000"}, "--exposure"},
        {{"--view", "Nowhere"}, "Nowhere"},
        {{"--display", "Nowhere"}, "Nowhere"},
        {{"-o", "picture"}, "picture"},
        {{"-o", "picture.gif"}, ".gif"},
        {{"-o", "nowhere/picture.exr"}, "nowhere/picture.exr", 1},
        {{"-o", "."}, ""},
        {{"-o", ""}, ""},
        {{"-o", "/proc/picture.exr"}, "/proc/picture.exr", 1},
        {{"-o", "nowhere/a.part"}, "nowhere/a.part", 1},
        {{"-o", "nowhere/{plane}.exr"}, "nowhere/beauty.exr", 1},
        {{"--checkpoint", "nowhere/a.part"}, "nowhere/a.part", 1},
        {{"--cells", "nowhere/a.cells"}, "nowhere/a.cells", 1},
        {{"--resume", "nowhere/a.part"}, "nowhere/a.part"},
        {{"--sample-range", "0:9"}, "--sample-range 0:9: the range must not be empty and must lie within 0:"},
        {{"--sample-range", "1:1"}, "--sample-range 1:1"},
        {{"--stats", "nowhere/stats.json"}, "nowhere/stats.json", 1},
        {{"--stats", "."}, "cannot write \".\": it is a directory", 1},
        {{"--stats", "/dev/null"}, "it is not a regular file", 1},
        {{"--nonsense"}, "phasetree render: unknown option --nonsense\nRun \"phasetree render --help\""},
        {{"--sample", "3"}, "unknown option --sample (did you mean --spp?)"},
        {{"--threds=3"}, "unknown option --threds (did you mean --threads?)"},
        {{"another.json"}, "another.json"}};
    const Shell shell;
    write_text(shell.directory / "scene.json", SceneText().text());
    for (const Arguments& a : wrong) {
        CAPTURE(a.words);
        std::vector<std::string> words{"render", "scene.json"};
        words.insert(words.end(), a.words.begin(), a.words.end());
        const Outcome o = shell.run(words);
        CAPTURE(o.err);
        CHECK(o.code == a.code);
        CHECK(o.out == "");
        CHECK(o.err.find(a.message) != std::string::npos);
        CHECK(o.err.find("Progress") == std::string::npos);  // before an hour of rendering, not after
        CHECK(o.processor_seconds < at_once);
        CHECK(shell.directory.size() == 1);
    }
    for (const std::vector<std::string>& words : {std::vector<std::string>{},
                                                  {"rendre", "scene.json"},
                                                  {"render"},
                                                  {"check"},
                                                  {"check", "scene.json", "more"}}) {
        const Outcome o = shell.run(words);
        CHECK(o.code == 2);
        CHECK(o.err != "");
    }
    CHECK(shell.run({"rendre", "scene.json"}).err ==
          "phasetree: unknown subcommand \"rendre\" (did you mean \"render\"?)\n");
    CHECK(shell.run({"nothing"}).err ==
          "phasetree: unknown subcommand \"nothing\" (choose from render, new, view, merge, farm, check, info, eval, "
          "trace, measure, solve, slice, nodes, export, import)\n");
    CHECK(shell.run({"--help"}).code == 0);
    CHECK(shell.run({"render", "--help"}).code == 0);
    CHECK(shell.run({"--version"}).out.find("phasetree") == 0);
    CHECK(shell.directory.size() == 1);
}

TEST_CASE("numbers that are not finite are refused by every option") {
    const Shell shell;
    write_text(shell.directory / "scene.json", SceneText().text());
    REQUIRE(shell.run({"render", "scene.json", "--quiet", "-o", "a.part"}).code == 0);
    const auto refused = [&](const std::vector<std::string>& words, const std::vector<std::string>& options) {
        for (const std::string& option : options)
            for (const char* const number : {"nan", "inf"}) {
                std::vector<std::string> all = words;
                all.push_back(option + "=" + number);
                CAPTURE(all);
                const Outcome o = shell.run(all);
                CAPTURE(o.err);
                CHECK(o.code == 2);
                CHECK(o.err.find(option) != std::string::npos);
                CHECK(shell.directory.size() == 2);
            }
    };
    refused({"render", "scene.json", "--quiet", "-o", "b.exr"},
            {"--exposure", "--noise", "--detail", "--time", "--checkpoint-interval", "--max-memory", "--at", "--spp",
             "--threads", "--seed"});
    refused({"merge", "a.part", "-o", "b.exr"}, {"--exposure"});
    refused({"export", "scene.json", "-o", "b.stl"}, {"--spacing", "--scale", "--max-memory", "--at"});
}

TEST_CASE("$OCIO that leads nowhere is an error") {
    Shell shell;
    shell.environment = {{"OCIO", "/nowhere/config.ocio"}};
    write_text(shell.directory / "scene.json", SceneText().text());
    const Outcome o = shell.run({"render", "scene.json", "-o", "a.png"});
    CHECK(o.code == 2);
    CHECK(o.err.find("/nowhere/config.ocio") != std::string::npos);
    CHECK(shell.directory.size() == 1);
}

TEST_CASE("what holds linear light, or no light at all, is written whatever $OCIO is and views are called") {
    Shell shell;
    shell.environment = {{"OCIO", "/nowhere/config.ocio"}};
    SceneText scene;
    scene.rest = R"("render": {"width": 24, "height": 16, "samples": 2, "view": "Nowhere"})";
    write_text(shell.directory / "scene.json", scene.text());
    const auto check_done = [&](const std::vector<std::string>& arguments, const std::string& input = "") {
        const Outcome o = shell.run(arguments, input);
        CAPTURE(arguments.front());
        CAPTURE(o.err);
        CHECK(o.code == 0);
    };
    check_done({"render", "scene.json", "-o", "a.exr", "-o", "a.part", "--quiet"});
    check_done(
        {"render", "scene.json", "-o", "b.{plane}.exr", "--planes", "albedo", "--spp", "8", "--denoise", "--quiet"});
    check_done({"merge", "a.part", "-o", "c.exr", "--quiet"});
    CHECK(bytes_of(shell.directory / "c.exr") == bytes_of(shell.directory / "a.exr"));
    check_done({"export", "scene.json", "-o", "a.3mf", "--spacing", "0.2"});
    check_done({"export", "scene.json", "-o", "a.html"});
    check_done({"export", "scene.json", "-o", "a.glsl"});
    check_done({"info", "scene.json", "--cells"});
    check_done({"eval", "scene.json"}, "0 0 0\n");
    check_done({"trace", "scene.json"}, "0 -5 0 0 1 0\n");
    // Displayed pictures need the configuration, and so does a view requested by name.
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"render", "scene.json", "-o", "a.exr", "-o", "d.png"},
          {"render", "scene.json", "-o", "a.exr", "--view", "Raw"},
          {"merge", "a.part", "-o", "d.png"},
          {"check", "scene.json"}}) {
        const Outcome o = shell.run(arguments);
        CAPTURE(o.err);
        CHECK(o.code == 2);
        CHECK(o.err.find("/nowhere/config.ocio") != std::string::npos);
    }
}

TEST_CASE("lines of numbers that are none") {
    const Shell shell;
    write_text(shell.directory / "scene.json", SceneText().text());
    struct Input {
        const char *command, *text, *place;
    };
    for (const Input& i :
         {Input{"eval", "1 2\n", "<stdin>:1:"}, Input{"eval", "0 0 0\n\n# so\n1 2 x\n", "<stdin>:4:5:"},
          Input{"eval", "1 2 3 4\n", "<stdin>:1:7:"}, Input{"eval", "nan 0 0\n", "<stdin>:1:1:"},
          Input{"eval", "1e99 0 0\n", "<stdin>:1:1:"}, Input{"trace", "0 0 0 1 0\n", "<stdin>:1:"},
          Input{"trace", "0 0 0 0 0 0\n", "<stdin>:1:"}, Input{"trace", "0 0 0 inf 0 0\n", "<stdin>:1:7:"}}) {
        CAPTURE(i.text);
        const Outcome o = shell.run({i.command, "scene.json"}, i.text);
        CAPTURE(o.err);
        CHECK(o.code == 2);
        CHECK(o.err.find(i.place) == 0);
    }
}

}  // namespace test_wrong_arguments
