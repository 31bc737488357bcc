// No function of the project is longer than 100 lines. Files are formatted, so what a brace closes began at the last
// line that is indented as little as the brace.
#include <doctest/doctest.h>

#include <array>
#include <string_view>

#include "source_directory.hpp"
#include "support/rooms.hpp"

namespace test_function_lengths {

using namespace phasetree::tests;

namespace {

constexpr std::size_t longest = 100;

std::size_t indentation_of(const std::string& line) {
    return line.find_first_not_of(' ');
}

// Whether a line begins something other than code: a namespace, a type, a list of values.
bool begins_no_function(const std::string& line) {
    const std::string_view text = std::string_view(line).substr(indentation_of(line));
    for (const std::string_view word :
         {"namespace", "struct", "class", "enum", "union", "extern", "template <", "typedef"})
        if (text.starts_with(word) && text.find('(') == std::string_view::npos) return true;
    return line.find("= {") != std::string::npos || text == "{";
}

// Lines of raw string literals are emptied, because their indentation is arbitrary.
std::vector<std::string> code_of(const fs::path& file) {
    std::vector<std::string> lines = lines_of(file);
    std::string end;
    for (std::string& line : lines) {
        if (!end.empty()) {
            const std::size_t at = line.find(end);
            if (at == std::string::npos) {
                line.clear();
                continue;
            }
            line = std::string(at + end.size(), ' ') + line.substr(at + end.size());
            end.clear();
        }
        const std::size_t start = line.rfind("R\"");
        if (start == std::string::npos) continue;
        const std::size_t open = line.find('(', start);
        if (open == std::string::npos) continue;
        const std::string closing = ")" + line.substr(start + 2, open - start - 2) + "\"";
        if (line.find(closing, open) == std::string::npos) end = closing;
    }
    return lines;
}

// Complains of every block of code that is too long, and gives the number of blocks.
std::size_t check_blocks(const fs::path& file) {
    const std::vector<std::string> lines = code_of(file);
    std::size_t blocks = 0;
    for (std::size_t last = 0; last < lines.size(); ++last) {
        const std::size_t indentation = indentation_of(lines[last]);
        if (indentation == std::string::npos || lines[last][indentation] != '}') continue;
        // What is in a namespace is not indented.
        if (lines[last].starts_with("}  // namespace")) continue;
        ++blocks;
        for (std::size_t first = last; first-- > 0;) {
            const std::size_t at = indentation_of(lines[first]);
            if (at == std::string::npos || at > indentation || lines[first][at] == '#') continue;
            if (last - first + 1 > longest && !begins_no_function(lines[first]))
                FAIL_CHECK(file.string() << ":" << first + 1 << ": " << last - first + 1 << " lines");
            break;
        }
    }
    return blocks;
}

}  // namespace

TEST_CASE("no function is longer than 100 lines") {
    const std::set<std::string> kinds{".cpp", ".hpp", ".inl", ".c", ".h"};
    std::size_t blocks = 0;
    for (const char* const folder : {"lib", "tracer", "plugins", "benchmarks", "tests"})
        for (const fs::path& file : files_below(fs::path(source_directory()) / folder))
            if (kinds.contains(file.extension().string())) blocks += check_blocks(file);
    CHECK(blocks > 5'000);
}

}  // namespace test_function_lengths
