// phasetree-bench as a user runs it, with images of a few pixels: it comes to its end, its numbers are numbers, and
// what it compares is the same. Whether its targets are met on such images means nothing, and is ignored.
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "command/command.hpp"

const phasetree::tests::CommandMain phasetree::tests::command_main = nullptr;

namespace test_bench {

using namespace phasetree::tests;

namespace {

// Calls f(path, number) for each number of the tables of a subcommand.
template <class F>
void for_each_number(const nlohmann::json& value, const std::string& path, F&& f) {
    if (value.is_number()) f(path, value.get<double>());
    // A number that is not finite is written as null.
    if (value.is_null()) f(path, std::nan(""));
    if (value.is_structured())
        for (const auto& [key, child] : value.items()) for_each_number(child, path + "/" + key, f);
}

}  // namespace

TEST_CASE("phasetree-bench all: every subcommand's numbers are finite and positive, and its checks hold") {
    Shell shell;
    shell.patience = std::chrono::seconds(280);
    const std::string file = shell.directory / "bench.json";
    const Outcome outcome = shell.run({"all", "--quick", "--size", "32x24", "--json", file});
    CAPTURE(outcome.out);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.err == "");
    REQUIRE(std::filesystem::exists(file));
    const nlohmann::json all = nlohmann::json::parse(bytes_of(file));
    CHECK(all.at("settings").at("width") == 32);
    // How many rows the tables have, and how many targets and checks there are.
    struct Expected {
        std::string command, table;
        std::size_t rows, targets, checks;
    };
    for (const Expected& e : std::vector<Expected>{{"table1", "objects", 7, 2, 7},
                                                   {"phases", "counts", 11, 2, 1},
                                                   {"scaling", "counts", 4, 4, 0},
                                                   {"quality", "objects", 10, 2, 0},
                                                   {"naive", "scenes", 2, 2, 2},
                                                   {"mesh", "scenes", 16, 3, 4},
                                                   {"simd", "instruction_sets", 0, 2, 1},
                                                   {"host", "scenes", 2, 2, 0},
                                                   {"carve", "objects", 8, 0, 16},
                                                   {"march", "ways", 3, 0, 1},
                                                   {"proxies", "objects", 3, 0, 1},
                                                   {"light", "pictures", 6, 0, 0}}) {
        CAPTURE(e.command);
        const nlohmann::json& report = all.at(e.command);
        const nlohmann::json& table = report.at(e.table);
        // One row for each scene, kind of rays and instruction set of this machine.
        const std::size_t rows = e.command == "simd" ? table.size() / 4 * 4 : e.rows;
        CHECK(table.size() == rows);
        CHECK(table.size() > 0);
        CHECK(report.at("notes").size() > 0);
        CHECK(report.value("targets", nlohmann::json::array()).size() == e.targets);
        CHECK(report.value("checks", nlohmann::json::array()).size() == e.checks);
        if (report.contains("checks")) {
            for (const auto& check : report["checks"]) {
                CAPTURE(check.dump());
                CHECK(check.at("holds") == true);
            }
        }
        std::size_t numbers = 0;
        for_each_number(table, e.command, [&](const std::string& path, double v) {
            ++numbers;
            CAPTURE(path);
            CHECK(std::isfinite(v));
            // An overhead may be less than nothing, and no hit should be another.
            if (path.find("overhead") == std::string::npos && path.find("disagreements") == std::string::npos)
                CHECK(v > 0);
        });
        CHECK(numbers > (e.command == "march" ? 1 : 4) * table.size());
    }
}

TEST_CASE("phasetree-bench: what is wrong with the command line is said, and nothing is written") {
    Shell shell;
    const std::string file = shell.directory / "bench.json";
    struct Case {
        std::vector<std::string> arguments;
        std::string message;
    };
    for (const Case& c : std::vector<Case>{{{"tablel"}, "unknown subcommand \"tablel\" (did you mean \"table1\"?)"},
                                           {{"nothing"}, "unknown subcommand \"nothing\" (choose from table1, "},
                                           {{"phases", "--size", "32"}, "--size"},
                                           {{"phases", "--size", "0x5"}, "--size"},
                                           {{"phases", "--size", ""}, "--size"},
                                           {{"phases", "--threads", "0"}, "--threads"},
                                           {{"phases", "--seed", "-1"}, "--seed"},
                                           {{"phases", "--seed", "99999999999999999999999"}, "--seed"},
                                           {{"phases", "--nothing"}, "--nothing"},
                                           {{}, "subcommand"}}) {
        std::vector<std::string> arguments = c.arguments;
        if (!arguments.empty()) arguments.insert(arguments.end(), {"--json", file});
        CAPTURE(arguments);
        const Outcome outcome = shell.run(arguments);
        CAPTURE(outcome.err);
        CHECK(outcome.code == 2);
        CHECK(outcome.err.find(c.message) != std::string::npos);
        CHECK(outcome.out == "");
        CHECK(shell.directory.size() == 0);
    }
    // Before an hour of measuring, not after it.
    for (const std::string& wrong : {std::string("nowhere/bench.json"), std::string("."), std::string("/dev/null")}) {
        const Outcome outcome = shell.run({"phases", "--quick", "--size", "4x4", "--json", wrong});
        CAPTURE(outcome.err);
        CHECK(outcome.code == 1);
        CHECK(outcome.err.find("cannot write \"" + wrong + "\"") != std::string::npos);
        CHECK(outcome.out == "");
        CHECK(shell.directory.size() == 0);
    }
}

TEST_CASE("phasetree-bench: who stops it finds the old file of numbers, and nothing else") {
    const Shell shell;
    write_text(shell.directory / "bench.json", "precious");
    bool is_stopped = false;
    const auto stop = [&](pid_t process) {
        if (!is_stopped && processor_seconds(process) > 0.5) is_stopped = ::kill(process, SIGTERM) == 0;
    };
    const Outcome outcome = shell.run({"scaling", "--json", "bench.json"}, "", stop);
    CHECK(is_stopped);
    CHECK(outcome.signal == SIGTERM);
    CHECK(bytes_of(shell.directory / "bench.json") == "precious");
    CHECK(shell.directory.size() == 1);
}

}  // namespace test_bench
