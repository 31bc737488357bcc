// The plugin's rooms depend on each other in one direction, which plugins/embree/README.md draws.
#include <doctest/doctest.h>

#include "source_directory.hpp"
#include "support/rooms.hpp"

namespace test_rooms {

using namespace phasetree::tests;

TEST_CASE("every room of the plugin is drawn, and includes only what is drawn before it") {
    const fs::path root = source_directory(), plugin = root / "plugins" / "embree";
    RoomOrder order(plugin / "README.md");
    std::set<std::string> there;
    for (const fs::path& half : {root / "lib" / "embree", plugin / "src"})
        for (const fs::path& file : files_below(half)) {
            if (file.extension() == ".md") continue;
            const std::string name = file.lexically_relative(half).string();
            there.insert(first_folder(name));
            for (const std::string& include : includes_of(file)) {
                if (include.starts_with("phasetree/") || include == "phasetree_embree.h") continue;
                INFO(name << " includes \"" << include << "\"");
                order.check_arrow(first_folder(name), first_folder(include));
            }
        }
    order.check_is_of(there);
    CHECK(order.checked() > 30);
}

}  // namespace test_rooms
