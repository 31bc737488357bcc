#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "io/node_source.hpp"
#include "phasetree/io/write.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/program/program.hpp"
#include "support/random_tree.hpp"

namespace test_round_trip {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

bool equal_programs(const Program& a, const Program& b) {
    const auto same = [](const Instruction& x, const Instruction& y) {
        return x.op == y.op && x.a == y.a && x.b == y.b && x.data == y.data;
    };
    return std::equal(a.instructions.begin(), a.instructions.end(), b.instructions.begin(), b.instructions.end(),
                      same) &&
           a.constants == b.constants &&
           std::equal(a.outputs.begin(), a.outputs.end(), b.outputs.begin(), b.outputs.end(),
                      [](const Output& x, const Output& y) { return x.phase == y.phase && x.value == y.value; });
}

}  // namespace

TEST_CASE("a tree of any node, written and read again, records into the same program") {
    const PhaseNames names{{"vacuum", "a", "b \"quoted\"", "c\\d", "é"}};
    std::set<std::string_view> names_of_nodes_with_files;
    const auto add_name = [&]<class Node>() {
        if constexpr (io::MadeFromFile<Node>) names_of_nodes_with_files.insert(Node::info.name);
    };
    for_each_type(PlainFields(), add_name);
    for_each_type(Objects(), add_name);
    int read = 0;
    for (const NodeKind& kind : node_kinds()) {
        Random rng = random_for(91, kind);
        CAPTURE(kind.name);
        int of_kind = 0;
        for (int n = 0; n < 12; ++n) {
            const SceneTree tree{names, kind.object(rng, 2 + n % 3)};
            std::string text;
            try {
                text = write_tree(tree);
            } catch (const ModelError& e) {
                // What no file holds cannot be named in one.
                REQUIRE(std::string(e.what()) == "\"file\" was not read from a file");
                continue;
            }
            CAPTURE(text);
            const SceneTree again = read_tree(Document::from_text(text));
            REQUIRE(again.phases.names == names.names);
            REQUIRE(equal_programs(record(again.object), record(tree.object)));
            ++of_kind;
        }
        CHECK((of_kind > 0 || names_of_nodes_with_files.contains(kind.name)));
        read += of_kind;
    }
    CHECK(read > 500);
}

TEST_CASE("a negative zero stays negative") {
    const Field moved = warped(Translate{{0, -0.f, 0}}, Field(Sphere{}));
    const std::string text = write_tree({{{"vacuum", "a"}}, Set{.phase = Phase{1}, .of = moved}});
    CAPTURE(text);
    CHECK(text.find("[0, -0.0, 0]") != std::string::npos);
    CHECK(write_tree(read_tree(Document::from_text(text))) == text);
}

TEST_CASE("a shared shape is written once") {
    const Field ball = Sphere{.radius = 2};
    const Phased object = Under{.of = {Set{.phase = Phase{1}, .of = ball}, Set{.phase = Phase{2}, .of = ball}}};
    const std::string text = write_tree({{{"vacuum", "a", "b"}}, object});
    CHECK(text.find("\"shapes\"") != std::string::npos);
    CHECK(text.find("sphere", text.find("sphere") + 1) == std::string::npos);
    const SceneTree again = read_tree(Document::from_text(text));
    CHECK(statistics(again.object).nodes == statistics(object).nodes);
}

TEST_CASE("a phase without a name cannot be written") {
    CHECK_THROWS(write_tree({{{"vacuum", "a"}}, Set{.phase = Phase{2}, .of = Sphere{}}}));
}

}  // namespace test_round_trip
