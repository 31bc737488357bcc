// Tables of numbers as other programs write them: the same rules for what `eval` and `trace` read from standard input
// and for the files of the nodes `balls` and `particles`.
#include <fmt/format.h>

#include <algorithm>

#include "command.hpp"

namespace test_tables {

using namespace phasetree::tests;

namespace {

constexpr const char* scene =
    R"({"phases": {"a": 0, "b": 0}, "tree": {"particles": {"phases": ["a", "b"], "file": "balls.csv"}}})";
constexpr const char* ball =
    R"({"phases": {"a": 0}, "tree": {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}}})";

// A reader of tables: its columns, and two rows of numbers for them.
struct User {
    std::string name;
    std::vector<std::string> columns;
    std::vector<std::string> rows[2];
};

std::vector<User> users() {
    return {{"particles",
             {"x", "y", "z", "radius", "phase"},
             {{"0", "0", "0", "0.5", "0"}, {"2", "0", "-1.5e0", "0.5", "1"}}},
            {"eval", {"x", "y", "z"}, {{"0", "0.5", "0"}, {"2", "0", "-1.5e0"}}},
            {"trace",
             {"ox", "oy", "oz", "dx", "dy", "dz"},
             {{"0", "0.25", "5", "0", "0", "-1"}, {"2", "0", "-1.5e0", "-1", "0", "0"}}}};
}

// The result of reading a table.
Outcome use(const Shell& shell, const User& user, const std::string& table) {
    if (user.name != "particles") {
        write_text(shell.directory / "scene.json", ball);
        return shell.run({user.name, "scene.json"}, table);
    }
    write_text(shell.directory / "scene.json", scene);
    write_text(shell.directory / "balls.csv", table);
    return shell.run({"eval", "scene.json"}, "0 0 0\n2 0 -1.5\n");
}

// The table in another form.
using Form = std::string (*)(const User&);

std::string joined(const std::vector<std::string>& cells, const std::string& separator, const std::string& quote = "") {
    std::string line;
    for (const std::string& cell : cells) line += (line.empty() ? "" : separator) + quote + cell + quote;
    return line;
}

std::string table(const User& user, const std::string& separator, const std::string& quote = "",
                  const std::string& end = "\n") {
    std::string text;
    for (const auto* line : {&user.columns, &user.rows[0], &user.rows[1]})
        text += joined(*line, separator, quote) + end;
    return text;
}

std::string upper_case(std::string text) {
    for (char& c : text)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 32);
    return text;
}

const std::vector<std::pair<const char*, Form>> forms{
    {"quoted, as ParaView and R write it", [](const User& u) { return table(u, ",", "\""); }},
    {"the header alone quoted",
     [](const User& u) {
         return joined(u.columns, ",", "\"") + "\n" + joined(u.rows[0], ",") + "\n" + joined(u.rows[1], ",");
     }},
    {"with a byte order mark", [](const User& u) { return "\xef\xbb\xbf" + table(u, ","); }},
    {"with a byte order mark and quotes", [](const User& u) { return "\xef\xbb\xbf" + table(u, ",", "\""); }},
    {"with a header in upper case",
     [](const User& u) {
         return upper_case(joined(u.columns, ",")) + table(u, ",").substr(joined(u.columns, ",").size());
     }},
    {"with CR LF", [](const User& u) { return table(u, ",", "", "\r\n"); }},
    {"with CR LF and quotes", [](const User& u) { return table(u, ",", "\"", "\r\n"); }},
    {"with CR", [](const User& u) { return table(u, ",", "", "\r"); }},
    {"with blanks around commas", [](const User& u) { return table(u, " ,\t "); }},
    {"with blanks around quotes", [](const User& u) { return table(u, " , ", "\""); }},
    {"with semicolons", [](const User& u) { return table(u, ";"); }},
    {"with tabs", [](const User& u) { return table(u, "\t"); }},
    {"with blanks", [](const User& u) { return table(u, "  "); }},
    {"with comments and empty lines",
     [](const User& u) { return "# made by hand\n\n" + table(u, ",", "", "\n \t\n# more\n") + "\n\n\r\n"; }},
    {"with rows of separators",
     [](const User& u) {
         return table(u, ",", "", "\n,,,,,\n") + " ; ;\n" + std::string(u.columns.size(), ';') + "\n";
     }},
    {"with blanks inside quotes",
     [](const User& u) {
         return "\" " + joined(u.columns, " \",\"\t") + "\"\n\"" + joined(u.rows[0], "\",\" ") + " \"\n" +
                joined(u.rows[1], ",");
     }},
    {"with semicolons, and commas in another name",
     [](const User& u) {
         return "rgb (r,g,b);" + joined(u.columns, ";") + "\n;" + joined(u.rows[0], ";") + "\n1,2,3;" +
                joined(u.rows[1], ";");
     }},
    {"without a last line feed", [](const User& u) { return table(u, ",").substr(0, table(u, ",").size() - 1); }},
    {"with signs",
     [](const User& u) {
         std::string text = joined(u.columns, ",") + "\n";
         for (const auto& row : u.rows) {
             for (const std::string& cell : row) text += (cell.starts_with('-') ? "" : "+") + cell + ",";
             text.back() = '\n';
         }
         return text;
     }},
    {"with further columns", [](const User& u) {
         return "\"\",\"a \"\"name\"\"\"," + joined(u.columns, ",") + ",#\n\"1\",\"1,2 \"\"3\"\"\"," +
                joined(u.rows[0], ",") + ",# 3\n\"2\",," + joined(u.rows[1], ",") + ",\n";
     }}};

struct Mistake {
    const char* name;
    std::string (*text)(const User&);
    std::size_t line, column;
    const char* message;
};

// A header, and the first row with something else instead of its first cell, which is "0".
std::string with_first_cell(const User& user, const std::string& cell, const std::string& separator = ",") {
    return joined(user.columns, separator) + "\n" + cell + joined(user.rows[0], separator).substr(1) + "\n";
}

// A column of 0 stands for one that depends on the user.
const std::vector<Mistake> mistakes{
    {"no number", [](const User& u) { return with_first_cell(u, "x"); }, 2, 1, "must be a finite number, but is \"x\""},
    {"no finite number", [](const User& u) { return with_first_cell(u, " inf"); }, 2, 2, "but is \"inf\""},
    {"too large a number", [](const User& u) { return with_first_cell(u, "1e999"); }, 2, 1, "but is \"1e999\""},
    {"a mistake behind a letter of two bytes",
     [](const User& u) { return "n," + joined(u.columns, ",") + "\n\xc3\xa9,x" + joined(u.rows[0], ",").substr(1); }, 2,
     3, "but is \"x\""},
    {"a row that is too short", [](const User& u) { return joined(u.columns, ",") + "\n0"; }, 2, 2, "the row has no "},
    {"an empty cell", [](const User& u) { return with_first_cell(u, " "); }, 2, 2, "the row has no "},
    {"a row that is too long", [](const User& u) { return table(u, ",") + joined(u.rows[0], ",") + ",7\n"; }, 4, 0,
     "cells, but the header has"},
    {"a column twice", [](const User& u) { return u.columns[0] + "," + joined(u.columns, ","); }, 1, 0, "occurs twice"},
    {"a column too few", [](const User& u) { return "# c\r" + u.columns[0] + "," + u.columns[1] + "\n1,2\n"; }, 2, 1,
     "the header lacks the column"},
    {"a quote that stays open",
     [](const User& u) { return joined(u.columns, ",") + ",n\n" + joined(u.rows[0], ",") + ",\"a\n"; }, 2, 0,
     "no closing quote"},
    {"a word behind a quote", [](const User& u) { return with_first_cell(u, "\"0\"1"); }, 2, 4,
     "only a separator may follow"},
    {"a decimal comma", [](const User& u) { return with_first_cell(u, "0,5", ";"); }, 2, 1, "use a decimal point"}};

}  // namespace

TEST_CASE("tables in all their forms are read alike by eval, trace and the nodes of balls") {
    const Shell shell;
    for (const User& user : users()) {
        CAPTURE(user.name);
        const Outcome plain = use(shell, user, table(user, ","));
        REQUIRE_MESSAGE(plain.code == 0, plain.err);
        REQUIRE(std::count(plain.out.begin(), plain.out.end(), '\n') >= 3);
        for (const auto& [name, form] : forms) {
            CAPTURE(name);
            const Outcome o = use(shell, user, form(user));
            CHECK(o.err == "");
            CHECK(o.out == plain.out);
        }
    }
}

TEST_CASE("mistakes in tables are told alike, with line and column, by eval, trace and the nodes of balls") {
    const Shell shell;
    for (const User& user : users()) {
        CAPTURE(user.name);
        for (const Mistake& m : mistakes) {
            CAPTURE(m.name);
            const Outcome o = use(shell, user, m.text(user));
            CAPTURE(o.err);
            CHECK(o.code == 2);
            CHECK(o.err.find(m.message) != std::string::npos);
            const std::string file = user.name == "particles" ? "balls.csv" : "<stdin>";
            const std::string place =
                m.column == 0 ? fmt::format("{}:{}:", file, m.line) : fmt::format("{}:{}:{}: ", file, m.line, m.column);
            CHECK(o.err.find(place) != std::string::npos);
        }
    }
}

TEST_CASE("rows without a header must have all numbers, with one separator between them") {
    const Shell shell;
    write_text(shell.directory / "scene.json", ball);
    for (const char* const row :
         {"0.5 1 2\n", "0.5,1,2\n", "0.5;1;2", "0.5\t1\t2 # there", "\xef\xbb\xbf+0.5 , 1, 2\r\n"}) {
        CAPTURE(row);
        const Outcome o = shell.run({"eval", "scene.json"}, row);
        CHECK(o.err == "");
        CHECK(o.out.find("\n0.5,1,2,vacuum,") != std::string::npos);
    }
    // Four numbers with decimal commas could be taken for six.
    const Outcome commas = shell.run({"trace", "scene.json"}, "0,5 1 2,5 3 4\n");
    CHECK(commas.code == 2);
    CHECK(commas.err.find("<stdin>:1:4: numbers must use a decimal point") == 0);
}

}  // namespace test_tables
