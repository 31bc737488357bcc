// Support for tests of rooms. Rooms are folders that include each other in one direction only. A README lists them in a
// block ```rooms, one per line, each before those that are built on it.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace phasetree::tests {

namespace fs = std::filesystem;

// The lines of a file.
inline std::vector<std::string> lines_of(const fs::path& file) {
    std::ifstream in(file);
    REQUIRE_MESSAGE(in.good(), file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

// The first words of the lines of a block ```name.
inline std::vector<std::string> words_of_block(const fs::path& readme, const std::string& name) {
    std::vector<std::string> words;
    bool is_inside = false;
    for (const std::string& line : lines_of(readme)) {
        if (line == "```" + name) {
            is_inside = true;
        } else if (line == "```") {
            is_inside = false;
        } else if (is_inside && !line.empty() && line[0] != ' ') {
            words.push_back(line.substr(0, line.find(' ')));
        }
    }
    REQUIRE_MESSAGE(!words.empty(), readme << " has no block ```" << name);
    return words;
}

// What a file includes in quotes, as it is written.
inline std::vector<std::string> includes_of(const fs::path& file) {
    std::vector<std::string> found;
    const std::string start = "#include \"";
    for (const std::string& line : lines_of(file))
        if (line.starts_with(start)) found.push_back(line.substr(start.size(), line.rfind('"') - start.size()));
    return found;
}

inline std::vector<fs::path> files_below(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

// The first folder of a path; empty for a file that is in none.
inline std::string first_folder(const std::string& path) {
    const std::size_t slash = path.find('/');
    return slash == std::string::npos ? "" : path.substr(0, slash);
}

// The order given in a README, and the number of includes that were checked against it.
class RoomOrder {
  public:
    explicit RoomOrder(const fs::path& readme) : drawn_(words_of_block(readme, "rooms")) {}

    // Checks that every listed room exists, and that every room is listed once.
    void check_is_of(std::set<std::string> there) const {
        there.erase("");
        for (const std::string& room : drawn_)
            CHECK_MESSAGE(there.contains(room), room << " is drawn but is not there");
        for (const std::string& room : there)
            CHECK_MESSAGE(std::ranges::count(drawn_, room) == 1, room << " is there but is not drawn once");
    }
    bool has(const std::string& room) const { return position(room) < drawn_.size(); }
    // Whether a file of the first room may include one of the second.
    void check_arrow(const std::string& from, const std::string& to) {
        CHECK_MESSAGE(has(to), "it must name a file of a room by its path");
        CHECK_MESSAGE(position(to) <= position(from), "room " << to << " comes after " << from);
        ++checked_;
    }
    std::size_t checked() const { return checked_; }

  private:
    std::size_t position(const std::string& room) const {
        return static_cast<std::size_t>(std::ranges::find(drawn_, room) - drawn_.begin());
    }

    std::vector<std::string> drawn_;
    std::size_t checked_ = 0;
};

// Checks a folder whose subfolders are rooms, and whose files name their includes by their paths in the folder.
// Includes that begin with one of `others` lead out of it.
inline std::size_t check_rooms(const fs::path& folder, const fs::path& readme, const std::vector<std::string>& others) {
    RoomOrder order(readme);
    std::set<std::string> there;
    for (const fs::path& file : files_below(folder))
        there.insert(first_folder(file.lexically_relative(folder).string()));
    order.check_is_of(there);
    for (const fs::path& file : files_below(folder)) {
        const std::string name = file.lexically_relative(folder).string();
        for (const std::string& include : includes_of(file)) {
            if (std::ranges::any_of(others, [&](const std::string& other) { return include.starts_with(other); }))
                continue;
            INFO(name << " includes \"" << include << "\"");
            order.check_arrow(first_folder(name), first_folder(include));
        }
    }
    return order.checked();
}

}  // namespace phasetree::tests
