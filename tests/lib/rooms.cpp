// The library's rooms depend on each other in one direction, which lib/README.md draws: this test reads every #include
// of the library and fails on one that leads to a later room. It also fails on a public header that no user would find.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "source_directory.hpp"

namespace fs = std::filesystem;

namespace {

const fs::path library = fs::path(source_directory()) / "lib";
const fs::path public_half = library / "include" / "phasetree", private_half = library / "src";

// The lines of a file.
std::vector<std::string> lines_of(const fs::path& file) {
    std::ifstream in(file);
    REQUIRE_MESSAGE(in.good(), file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

// The first words of the lines of a block ```name in lib/README.md.
std::vector<std::string> words_of_block(const std::string& name) {
    std::vector<std::string> words;
    bool is_inside = false;
    for (const std::string& line : lines_of(library / "README.md")) {
        if (line == "```" + name) {
            is_inside = true;
        } else if (line == "```") {
            is_inside = false;
        } else if (is_inside && !line.empty() && line[0] != ' ') {
            words.push_back(line.substr(0, line.find(' ')));
        }
    }
    REQUIRE_MESSAGE(!words.empty(), "lib/README.md has no block ```" << name);
    return words;
}

// What a file includes in quotes, as it is written.
std::vector<std::string> includes_of(const fs::path& file) {
    std::vector<std::string> found;
    const std::string start = "#include \"";
    for (const std::string& line : lines_of(file))
        if (line.starts_with(start)) found.push_back(line.substr(start.size(), line.rfind('"') - start.size()));
    return found;
}

// The room of a path relative to one of the halves, or of an include; empty for a file that is in none.
std::string room_of(std::string path) {
    if (path.starts_with("phasetree/")) path = path.substr(std::string("phasetree/").size());
    const std::size_t slash = path.find('/');
    return slash == std::string::npos ? "" : path.substr(0, slash);
}

std::vector<fs::path> files_below(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

}  // namespace

TEST_CASE("every room of the library is drawn, and every drawn room is there") {
    const std::vector<std::string> drawn = words_of_block("rooms");
    std::set<std::string> there;
    for (const fs::path& half : {public_half, private_half})
        for (const fs::path& file : files_below(half)) there.insert(room_of(file.lexically_relative(half).string()));
    there.erase("");
    for (const std::string& room : drawn) CHECK_MESSAGE(there.contains(room), room << " is drawn but is not there");
    for (const std::string& room : there)
        CHECK_MESSAGE(std::ranges::count(drawn, room) == 1, room << " is there but is not drawn once");
}

TEST_CASE("a file includes only what is in its own room or in a room that is drawn before") {
    const std::vector<std::string> drawn = words_of_block("rooms");
    const auto position = [&](const std::string& room) { return std::ranges::find(drawn, room) - drawn.begin(); };
    std::size_t checked = 0;
    for (const fs::path& half : {public_half, private_half})
        for (const fs::path& file : files_below(half)) {
            const std::string name = file.lexically_relative(library).string();
            const std::string room = room_of(file.lexically_relative(half).string());
            // Only phasetree.hpp, which gathers what users need, and version.cpp are outside of rooms.
            if (room.empty()) continue;
            for (const std::string& include : includes_of(file)) {
                if (include == "phasetree/version.hpp" || include.starts_with("phasetree_support/")) continue;
                const std::string target = room_of(include);
                INFO(name << " includes \"" << include << "\"");
                CHECK_MESSAGE(position(target) < static_cast<std::ptrdiff_t>(drawn.size()),
                              "it must name a file of a room by its path");
                CHECK_MESSAGE(position(target) <= position(room), "room " << target << " comes after " << room);
                if (half == public_half)
                    CHECK_MESSAGE(include.starts_with("phasetree/"), "a public header needs a private one");
                ++checked;
            }
        }
    CHECK(checked > 300);
}

TEST_CASE("every public header is one that users include, or is included by one") {
    std::set<std::string> reached;
    std::vector<std::string> next;
    for (const std::string& entry : words_of_block("headers")) {
        if (!entry.ends_with('/')) next.push_back(entry);
        for (const fs::path& file : files_below(library / "include")) {
            const std::string name = file.lexically_relative(library / "include").string();
            if (entry.ends_with('/') && name.starts_with(entry)) next.push_back(name);
        }
    }
    while (!next.empty()) {
        const std::string header = next.back();
        next.pop_back();
        if (!reached.insert(header).second) continue;
        for (const std::string& include : includes_of(library / "include" / header)) next.push_back(include);
    }
    for (const fs::path& file : files_below(library / "include")) {
        const std::string name = file.lexically_relative(library / "include").string();
        CHECK_MESSAGE(reached.contains(name), name << " is internal: it belongs in lib/src");
    }
}
