// `phasetree new`: scenes to start from.
#include "command.hpp"

namespace test_new {

using namespace phasetree::tests;

TEST_CASE("each scene that the help lists is written, passes the check, and renders") {
    const Shell shell;
    const std::string help = shell.run({"new", "--help"}).out;
    for (const char* const name : {"bottle", "candle", "empty", "glass", "jar", "ring"}) {
        CAPTURE(name);
        CHECK(help.find(std::string("\n  ") + name + " ") != std::string::npos);
        const std::string file = std::string(name) + ".json";
        const Outcome made = shell.run({"new", name});
        CHECK(made.code == 0);
        CHECK(made.err.find("wrote " + file) != std::string::npos);
        const Outcome checked = shell.run({"check", file});
        CHECK(checked.code == 0);
        CHECK(checked.err == "");
        const Outcome rendered = shell.run(
            {"render", file, "--size", "24x18", "--spp", "1", "--build-quality", "low", "-o", "a.png", "--quiet"});
        CHECK(rendered.code == 0);
        CHECK(rendered.err == "");
    }
}

TEST_CASE("a new scene never replaces a file unless it is told to") {
    const Shell shell;
    write_text(shell.directory / "mine.json", "mine");
    const Outcome refused = shell.run({"new", "glass", "-o", "mine.json"});
    CHECK(refused.code == 2);
    CHECK(refused.err.find("mine.json exists already") != std::string::npos);
    CHECK(bytes_of(shell.directory / "mine.json") == "mine");
    CHECK(shell.run({"new", "glass", "-o", "mine.json", "--force"}).code == 0);
    CHECK(bytes_of(shell.directory / "mine.json").find("\"ice\"") != std::string::npos);
    const Outcome unknown = shell.run({"new", "galss"});
    CHECK(unknown.code == 2);
    CHECK(unknown.err.find("did you mean \"glass\"?") != std::string::npos);
    CHECK(shell.run({"new", "glass", "-o", "nowhere/glass.json"}).code == 1);
}

}  // namespace test_new
