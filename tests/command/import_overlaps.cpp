// `phasetree import` where clear objects overlap or leave gaps.
#include "imports.hpp"

namespace test_import_overlaps {

using namespace phasetree::tests;
using namespace phasetree::tests::imports;

TEST_CASE("overlaps: priorities come first, then containment, then matter, then the file") {
    const Import shell;
    const auto phases = [&](const std::vector<std::pair<std::string, Vector>>& boxes, const std::vector<Vector>& points,
                            const std::vector<int>& priorities = {}) {
        Gltf g;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const auto& [name, range] = boxes[i];
            const Json extras = i < priorities.size() && priorities[i] != 0
                                    ? Json{{"extras", {{"phasetree_priority", priorities[i]}}}}
                                    : Json::object();
            g.node("node", g.mesh(box({range[0], 0, 0}, {range[1], range[2], range[2]}), g.clear(name, 1.5f)), extras);
        }
        (void)shell.import_well(g);
        return shell.phases_at(points);
    };
    const std::vector<Vector> both{{1.5f, 0.5f, 0.5f}};
    CHECK(phases({{"water", {0, 2, 1}}, {"glass", {1, 3, 1}}}, both) == "glass");
    CHECK(phases({{"glass", {0, 2, 1}}, {"water", {1, 3, 1}}}, both) == "glass");
    CHECK(phases({{"water", {0, 2, 1}}, {"air", {1, 3, 1}}}, both) == "air");
    CHECK(phases({{"air", {0, 2, 1}}, {"glass", {1, 3, 1}}}, both) == "glass");
    CHECK(phases({{"glass", {0, 2, 1}}, {"ice", {1, 3, 1}}}, both) == "glass");
    CHECK(phases({{"ice", {0, 2, 1}}, {"glass", {1, 3, 1}}}, both) == "ice");
    CHECK(phases({{"ice", {0, 2, 1}}, {"glass", {1, 3, 1}}}, both, {0, 1}) == "glass");
    CHECK(phases({{"water", {0, 2, 1}}, {"glass", {1, 3, 1}}}, both, {1, 0}) == "water");
    // What lies within the other is kept, even a liquid within a solid.
    CHECK(phases({{"glass", {0, 3, 3}}, {"water", {1, 2, 1}}}, both) == "water");
    CHECK(phases({{"glass", {0, 3, 3}}, {"water", {1, 2, 1}}}, both, {1, 0}) == "glass");
    CHECK(phases({{"Glass of water", {0, 2, 1}}, {"Orange_juices", {1, 3, 1}}}, both) == "Glass of water");
    CHECK(phases({{"OrangeJuice", {0, 2, 1}}, {"Water glass", {1, 3, 1}}}, both) == "Water glass");
    // Plurals in "es" are recognised: otherwise, their index would make the lenses a liquid like the water.
    Gltf plural;
    plural.node("water", plural.mesh(box({0, 0, 0}, {2, 1, 1}), plural.clear("water", 1.33f)));
    plural.node("lenses", plural.mesh(box({1, 0, 0}, {3, 1, 1}), plural.clear("lenses", 1.34f)));
    (void)shell.import_well(plural);
    CHECK(shell.phases_at(both) == "lenses");
    // An index is a hint only for names that say nothing.
    Gltf g;
    g.node("a", g.mesh(box({0, 0, 0}, {2, 1, 1}), g.clear("x", 1.34f)));
    g.node("b", g.mesh(box({1, 0, 0}, {3, 1, 1}), g.clear("y", 1.5f)));
    g.node("c", g.mesh(box({2.5f, 0, 0}, {4, 1, 1}), g.clear("z", 1.0f)));
    const Outcome o = shell.import_well(g);
    CHECK(has(o.out, "\"a\" and \"b\" overlap by up to 0.4"));
    CHECK(has(o.out, "\"b\" wins (solid over gas)\n"));
    CHECK(shell.phases_at({{1.5f, 0.5f, 0.5f}, {2.7f, 0.5f, 0.5f}, {3.5f, 0.5f, 0.5f}}) == "y y z");
    // Rules that contradict each other: liquid within a solid, and a gas through both.
    Gltf circle;
    circle.node("block", circle.mesh(box({0, 0, 0}, {9, 9, 9}), circle.clear("glass", 1.5f)));
    circle.node("core", circle.mesh(box({3, 3, 3}, {6, 6, 6}), circle.clear("water", 1.33f)));
    circle.node("hose", circle.mesh(box({4, 4, 4}, {5, 5, 12}), circle.clear("air", 1.0f)));
    CHECK(has(shell.import_well(circle).err, "although the rule (gas over liquid) says otherwise"));
}

TEST_CASE("phasetree_matter says what an object is made of, whatever its name and index") {
    const Import shell;
    const auto matters = [&](const Json& of_node, const Json& of_material) {
        Gltf g;
        g.node("Water",
               g.mesh(box({0, 0, 0}, {2, 1, 1}), g.clear("Glass", 1.33f, Json::object(), {{"extras", of_material}})),
               {{"extras", of_node}});
        g.node("Cup", g.mesh(box({1, 0, 0}, {3, 1, 1}), g.clear("Cup", 1.5f)));
        return shell.import_well(g);
    };
    const std::string liquid = "\"Cup\" wins (solid over liquid)\n", earlier = "\"Water\" wins (earlier in the file)\n";
    CHECK(has(matters(Json::object(), Json::object()).out, liquid));
    CHECK(has(matters({{"phasetree_matter", "solid"}}, Json::object()).out, earlier));
    CHECK(has(matters(Json::object(), {{"phasetree_matter", "solid"}}).out, earlier));
    CHECK(has(matters({{"phasetree_matter", "liquid"}}, {{"phasetree_matter", "solid"}}).out, liquid));
    CHECK(has(matters({{"phasetree_matter", "gas"}}, Json::object()).out, "\"Cup\" wins (solid over gas)\n"));
    CHECK(matters({{"phasetree_matter", "gas"}}, Json::object()).err == "");
    // Unknown values are reported, and change nothing.
    const Outcome unknown = matters({{"phasetree_matter", "plasma"}}, Json::object());
    CHECK(has(
        unknown.err,
        "\"Water\" has the phasetree_matter \"plasma\", which is not \"solid\", \"liquid\" or \"gas\"; it is ignored"));
    CHECK(has(unknown.out, liquid));
}

TEST_CASE("a thin gap is reported with its width, unless something fills it") {
    const Import shell;
    Gltf g;
    g.node("Cup", g.mesh(cup({-10, 0, -10}, {10, 20, 10}, 2), g.clear("glass", 1.5f)));
    g.node("Drink", g.mesh(box({-7.9f, 2.1f, -7.9f}, {7.9f, 12, 7.9f}), g.clear("water", 1.33f)));
    g.node("Cube", g.mesh(box({7.5f, 5, -1}, {7.8f, 7, 1}), g.clear("ice", 1.31f)));
    const Outcome o = shell.import_well(g);
    CHECK(has(o.out, "\"Cup\" and \"Drink\" have a gap of 0.1 to 0.1 m along"));
    CHECK(has(o.out, "\"Cube\" wins (within the other)\n"));
    CHECK_FALSE(has(o.out, "\"Cup\" and \"Cube\""));
    // The liquid flows to the glass.
    CHECK(has(o.out, "gaps narrower than 0.2 m between the phases water, glass are closed; --keep-gaps keeps them\n"));
    const std::vector<Vector> across_wall{{7.85f, 6, 3}, {7.95f, 6, 3}, {8.05f, 6, 3}, {7.95f, 15, 3}};
    CHECK(shell.phases_at(across_wall) == "water water glass vacuum");
    const Json closed = shell.scene()["tree"]["close_gaps"];
    CHECK(closed["phases"] == Json::parse(R"(["water", "glass"])"));
    CHECK(closed["gap"] == 0.2);
    const Outcome kept = shell.import_well(g, {"--keep-gaps"});
    CHECK(has(kept.out, "have a gap of 0.1 to 0.1 m along"));
    CHECK_FALSE(has(kept.out, "closed"));
    CHECK(shell.phases_at(across_wall) == "water vacuum glass vacuum");
    CHECK(shell.scene()["tree"].contains("over"));
}

TEST_CASE("a gap wider than the wall of the glass is measured from within") {
    const Import shell;
    Gltf g;
    g.node("Cup", g.mesh(cup({-40, 0, -40}, {40, 80, 40}, 0.6f), g.clear("glass", 1.5f)));
    g.node("Wine", g.mesh(box({-38.7f, 1.3f, -38.7f}, {38.7f, 50, 38.7f}), g.clear("wine", 1.34f)));
    const Outcome o = shell.import_well(g);
    CHECK(has(o.out, "\"Cup\" and \"Wine\" have a gap of 0.7 to 0.7 m along"));
    const double closed = shell.scene()["tree"]["close_gaps"]["gap"].get<double>();
    CHECK(closed >= 1.4);
    CHECK(closed <= 1.6);  // near edges, gaps are up to a tenth wider
}

TEST_CASE("gaps are left alone between solids, at a small part of surfaces, and within a phase") {
    const Import shell;
    Gltf panes;
    panes.node("a", panes.mesh(box({0, 0, 0}, {1, 1, 0.01f}), panes.clear("glass", 1.5f)));
    panes.node("b", panes.mesh(box({0, 0, 0.02f}, {1, 1, 0.03f}), panes.clear("acrylic", 1.49f)));
    CHECK_FALSE(has(shell.import_well(panes).out, "closed"));
    Gltf g;
    // Two cubes side by side, shifted so that they face each other at a fiftieth of their surfaces.
    g.node("a", g.mesh(box({0, 0, 0}, {1, 1, 1}), g.clear("glass", 1.5f)));
    g.node("b", g.mesh(box({1.01f, 0.88f, 0}, {2.01f, 1.88f, 1}), g.clear("water", 1.33f)));
    CHECK_FALSE(has(shell.import_well(g).out, "closed"));
    Gltf same;
    const std::size_t glass = same.clear("glass", 1.5f);
    same.node("a", same.mesh(box({0, 0, 0}, {1, 1, 1}), glass));
    same.node("b", same.mesh(box({1.01f, 0, 0}, {2.01f, 1, 1}), glass));
    const Outcome o = shell.import_well(same);
    CHECK(has(o.out, "have a gap of 0.01 to 0.01 m"));
    CHECK_FALSE(has(o.out, "closed"));
}

}  // namespace test_import_overlaps
