// The library's rooms depend on each other in one direction, which lib/README.md draws: this test reads every #include
// of the library and fails on one that leads to a later room. It also fails on a public header that no user would find.
#include <doctest/doctest.h>

#include "source_directory.hpp"
#include "support/rooms.hpp"

namespace test_rooms {

using namespace phasetree::tests;

namespace {

const fs::path library = fs::path(source_directory()) / "lib", readme = library / "README.md";
const fs::path public_half = library / "include" / "phasetree", private_half = library / "src";

// The room of a path relative to one of the halves, or of an include; empty for a file that is in none.
std::string room_of(const std::string& path) {
    const std::string start = "phasetree/";
    return first_folder(path.starts_with(start) ? path.substr(start.size()) : path);
}

}  // namespace

TEST_CASE("every room of the library is drawn, and every drawn room is there") {
    std::set<std::string> there;
    for (const fs::path& half : {public_half, private_half})
        for (const fs::path& file : files_below(half)) there.insert(room_of(file.lexically_relative(half).string()));
    RoomOrder(readme).check_is_of(there);
}

TEST_CASE("a file includes only what is in its own room or in a room that is drawn before") {
    RoomOrder order(readme);
    for (const fs::path& half : {public_half, private_half})
        for (const fs::path& file : files_below(half)) {
            const std::string name = file.lexically_relative(library).string();
            const std::string room = room_of(file.lexically_relative(half).string());
            // Only phasetree.hpp, which gathers what users need, and version.cpp are outside of rooms.
            if (room.empty()) continue;
            for (const std::string& include : includes_of(file)) {
                if (include == "phasetree/version.hpp" || include.starts_with("phasetree_support/")) continue;
                INFO(name << " includes \"" << include << "\"");
                order.check_arrow(room, room_of(include));
                if (half == public_half)
                    CHECK_MESSAGE(include.starts_with("phasetree/"), "a public header needs a private one");
            }
        }
    CHECK(order.checked() > 300);
}

TEST_CASE("every public header is one that users include, or is included by one") {
    std::set<std::string> reached;
    std::vector<std::string> next;
    for (const std::string& entry : words_of_block(readme, "headers")) {
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

}  // namespace test_rooms
