// Hidden parts of a scene: the text without them, and their pointers after the text has changed.
#include "studio/hidden_parts.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace test_hidden_parts {

using namespace phasetree;
using namespace phasetree::tracer::studio;

namespace {

using Pointers = std::vector<std::string>;

// A ball of glass, and a box of wood with a hole, on a floor below two lights.
const std::string scene = R"({"version": 1,
  "phases": {"glass": {"clear": {"ior": 1.5}}, "wood": {"diffuse": {"color": [0.6, 0.3, 0.1]}}},
  "shapes": {"ball": {"sphere": {"radius": 0.5}}},
  "tree": {"over": [
    {"set": {"phase": "glass", "of": "ball"}},  // a comment
    {"set": {"phase": "wood", "of": {"difference": {
      "from": {"box": {"size": [1, 2, 3]}},
      "subtract": [{"sphere": {"radius": 0.25}}, {"translate": {"by": [0, 0, 1], "of": "ball"}}]}}}}
  ]},
  "meshes": [{"floor": {"height": -1}}],
  "lights": [{"constant": {"radiance": [1, 1, 1]}}, {"sun": {"irradiance": [2, 2, 2]}}]})";

const Vocabulary& vocabulary() {
    static const Vocabulary words;
    return words;
}

// A member of the scene without hidden parts. Checks that everything else keeps its offset.
nlohmann::json left(const char* key, const Pointers& hidden) {
    const std::string text = text_without(Document::from_text(scene), vocabulary(), hidden);
    REQUIRE(text.size() == scene.size());
    for (std::size_t i = 0; i < text.size(); ++i) REQUIRE((text[i] == scene[i] || text[i] == ' '));
    (void)Document::from_text(text);
    return nlohmann::json::parse(text, nullptr, true, true)[key];
}

nlohmann::json json(const char* text) {
    return nlohmann::json::parse(text);
}

Pointers moved(const std::string& to, const Pointers& pointers, const std::string& from = scene) {
    return pointers_after(Document::from_text(from), Document::from_text(to), pointers);
}

std::string replaced(std::string text, const std::string& old, const std::string& by) {
    const std::size_t at = text.find(old);
    REQUIRE(at != std::string::npos);
    return text.replace(at, old.size(), by);
}

}  // namespace

TEST_CASE("a hidden item of a list is removed with one comma") {
    CHECK(left("tree", {}).at("over").size() == 2);
    CHECK(left("tree", {"/tree/over/1"}) == json(R"({"over": [{"set": {"phase": "glass", "of": "ball"}}]})"));
    CHECK(left("tree", {"/tree/over/0"}).at("over").size() == 1);
    CHECK(left("lights", {"/lights/0"}) == json(R"([{"sun": {"irradiance": [2, 2, 2]}}])"));
    CHECK(left("lights", {"/lights/1"}) == json(R"([{"constant": {"radiance": [1, 1, 1]}}])"));
    CHECK(left("lights", {"/lights/0", "/lights/1"}) == json("[]"));
    CHECK(left("meshes", {"/meshes/0"}) == json("[]"));
}

TEST_CASE("a node without an operand is replaced by its main operand or removed") {
    const char* const subtracted = "/tree/over/1/set/of/difference/subtract/";
    const std::string first = subtracted + std::string("0"), second = subtracted + std::string("1");
    const auto wood = [](const Pointers& hidden) { return left("tree", hidden).at("over").at(1).at("set").at("of"); };
    CHECK(wood({first}).at("difference").at("subtract").size() == 1);
    CHECK(wood({first, second}) == json(R"({"box": {"size": [1, 2, 3]}})"));
    // Hiding the operand of `translate` hides the `translate`, too.
    CHECK(wood({second + "/translate/of"}) == wood({second}));
    CHECK(left("tree", {"/tree/over/1/set/of/difference/from"}).at("over").size() == 1);
    CHECK(left("tree", {"/tree/over/0/set/of"}).at("over").size() == 1);
}

TEST_CASE("a hidden shape is hidden wherever it is used") {
    CHECK(left("tree", {"/shapes/ball"}) ==
          json(R"({"over": [{"set": {"phase": "wood", "of": {"difference": {"from": {"box": {"size": [1, 2, 3]}},
                  "subtract": [{"sphere": {"radius": 0.25}}]}}}}]})"));
}

TEST_CASE("a shape is hidden with the only shape that it uses") {
    const std::string text = replaced(
        replaced(scene, R"("shapes": {)", R"("shapes": {"moved": {"translate": {"by": [1, 0, 0], "of": "ball"}}, )"),
        R"("glass", "of": "ball")", R"("glass", "of": "moved")");
    const auto hidden = nlohmann::json::parse(text_without(Document::from_text(text), vocabulary(), {"/shapes/ball"}),
                                              nullptr, true, true);
    REQUIRE(hidden.at("tree").at("over").size() == 1);
    CHECK(hidden.at("tree").at("over")[0].at("set").at("phase") == "wood");
}

TEST_CASE("pointers to nothing are ignored, and something must remain") {
    CHECK(left("tree", {"", "/", "x", "/tree/over/9", "/phases/glass", "/camera"}).at("over").size() == 2);
    for (const Pointers& all : {Pointers{"/tree"}, Pointers{"/tree/over/0", "/tree/over/1"}})
        CHECK_THROWS_WITH_AS(text_without(Document::from_text(scene), vocabulary(), all),
                             doctest::Contains("every part of the object is hidden"), SceneError);
}

TEST_CASE("the same parts stay hidden when the text changes") {
    const Pointers box{"/tree/over/1"}, sun{"/lights/1"};
    SUBCASE("before and behind them") {
        const std::string longer = replaced(scene, R"("radius": 0.5)", R"("radius": 0.50001)");
        CHECK(moved(longer, box) == box);
        CHECK(moved(replaced(scene, "[2, 2, 2]", "[3, 3, 3]"), box) == box);
    }
    SUBCASE("inside") {
        CHECK(moved(replaced(scene, "[1, 2, 3]", "[1, 2, 4]"), box) == box);
        CHECK(moved(replaced(scene, "[2, 2, 2]", "[3]"), sun) == sun);
    }
    SUBCASE("in their list") {
        const std::string constant = R"({"constant": {"radiance": [1, 1, 1]}}, )";
        CHECK(moved(replaced(scene, constant, ""), sun) == Pointers{"/lights/0"});
        CHECK(moved(scene, {"/lights/0"}, replaced(scene, constant, "")) == sun);
        CHECK(moved(replaced(scene, constant, ""), {"/lights/0"}).empty());
        const std::string turned = replaced(replaced(scene, constant, ""), "[2, 2, 2]}}",
                                            R"([2, 2, 2]}}, {"constant": {"radiance": [1, 1, 1]}})");
        CHECK(moved(turned, sun) == Pointers{"/lights/0"});
        CHECK(moved(turned, {"/lights/0"}) == sun);
    }
    SUBCASE("in all places where a phase is named") {
        CHECK(moved(replaced(replaced(scene, R"("wood")", R"("oak")"), R"("phase": "wood")", R"("phase": "oak")"),
                    box) == box);
    }
    SUBCASE("entirely") {
        CHECK(moved("{}", box).empty());
    }
}

}  // namespace test_hidden_parts
