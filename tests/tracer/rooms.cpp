// The path tracer's rooms depend on each other in one direction, which tracer/README.md draws.
#include <doctest/doctest.h>

#include "source_directory.hpp"
#include "support/rooms.hpp"

namespace test_rooms {

using namespace phasetree::tests;

TEST_CASE("every room of the path tracer is drawn, and includes only what is drawn before it") {
    const fs::path tracer = fs::path(source_directory()) / "tracer";
    CHECK(check_rooms(tracer / "src", tracer / "README.md", {"phasetree/", "phasetree_support/", "embree_core/"}) >
          200);
}

}  // namespace test_rooms
