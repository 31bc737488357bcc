// What a host can get and store for each phase: the scene's material as JSON, and a number and a pointer of its own.
#include "embree/api/api.hpp"
#include "phasetree/io/write.hpp"

namespace test_materials {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

const char* const scene_text = R"({
    // "phases": {"not": {"this": 1}},
    "phases": {
        "glass": {"clear": {"ior": 1.5 /* of "BK7" */, "color": "#fff" // a comment
            }},
        "odd } name": {"note": "// no comment /* either \" } \\", "list": [{}, [1, 2]]},
        "plain": {},
        "number": 0, "text": "clear", "nothing": null, "list": [{"diffuse": 1}]},
    "tree": {"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}}})";

}  // namespace

TEST_CASE("each phase's material is the scene's own text without comments") {
    const embree::Tree tree = embree::Tree::from_text(scene_text);
    REQUIRE(tree.phase_count() == 8);
    CHECK_FALSE(tree.phase_material(PHASETREE_VACUUM));
    const auto glass = tree.phase_material(tree.phase("glass")), odd = tree.phase_material(tree.phase("odd } name"));
    REQUIRE(glass);
    CHECK(*glass == "{\"clear\": {\"ior\": 1.5 , \"color\": \"#fff\" \n            }}");
    CHECK(*odd == R"({"note": "// no comment /* either \" } \\", "list": [{}, [1, 2]]})");
    CHECK(tree.phase_material(tree.phase("plain")) == "{}");
    for (const char* name : {"number", "text", "nothing", "list"}) CHECK_FALSE(tree.phase_material(tree.phase(name)));
    // What any reader of JSON gets from it is the same.
    const Document all = Document::from_text(scene_text), own = Document::from_text(*glass);
    CHECK(own.root().find("clear")->find("ior")->number() ==
          all.root().find("phases")->find("glass")->find("clear")->find("ior")->number());

    const embree::Tree edited = tree.edited("/phases/glass/clear/ior", "1.33");
    CHECK(edited.phase_material(1)->find("1.33") != std::string::npos);
    CHECK(tree.phase_material(1) == glass);
}

TEST_CASE("a tree that was built in C++ has no materials, and one written as a scene has grey ones") {
    const SceneTree built{{{"vacuum", "glass", "water", "metal", "sand"}}, object()};
    const embree::Tree tree = embree::Tree::of(built), written = embree::Tree::from_text(write_tree(built));
    for (unsigned phase = 0; phase < 5; ++phase) {
        CHECK_FALSE(tree.phase_material(phase));
        CHECK(written.phase_material(phase).has_value() == (phase > 0));
    }
}

TEST_CASE("materials that are asked for wrongly") {
    const embree::Tree tree = object_tree();
    const char* json = "as before";
    expect_error(phasetreeGetTreePhaseMaterial(nullptr, 1, &json), PHASETREE_ERROR_INVALID_HANDLE, "tree is NULL");
    expect_error(phasetreeGetTreePhaseMaterial(tree.get(), 5, &json), PHASETREE_ERROR_INVALID_ARGUMENT,
                 "phase 5 does not exist");
    expect_error(phasetreeGetTreePhaseMaterial(tree.get(), 1, nullptr), PHASETREE_ERROR_INVALID_ARGUMENT, "json");
    PhasetreeTree freed = nullptr;
    REQUIRE(phasetreeNewTreeFromText(PHASETREE_API_VERSION, object_text, std::strlen(object_text), nullptr, nullptr,
                                     &freed) == PHASETREE_ERROR_NONE);
    REQUIRE(phasetreeReleaseTree(freed) == PHASETREE_ERROR_NONE);
    expect_error(phasetreeGetTreePhaseMaterial(freed, 1, &json), PHASETREE_ERROR_INVALID_HANDLE, "released");
    CHECK(std::string(json) == "as before");
}

TEST_CASE("a number and a pointer of the application's own for each phase") {
    Device device;
    embree::Geometry geometry(device, object_tree());
    int mine[PHASETREE_MAX_PHASES] = {};
    for (unsigned phase = 0; phase < PHASETREE_MAX_PHASES; ++phase) {
        CHECK(geometry.phase_user_data(phase).integer == 0);
        CHECK(geometry.phase_user_data(phase).pointer == nullptr);
        geometry.set_phase_user_data(phase, {std::int64_t{phase} - (std::int64_t{1} << 40), mine + phase});
    }
    // They are the geometry's: another tree leaves them.
    geometry.set_tree(embree::Tree::from_text(scene_text));
    for (unsigned phase = 0; phase < PHASETREE_MAX_PHASES; ++phase) {
        CHECK(geometry.phase_user_data(phase).integer == std::int64_t{phase} - (std::int64_t{1} << 40));
        CHECK(geometry.phase_user_data(phase).pointer == mine + phase);
    }
    CHECK(embree::Geometry(device, object_tree()).phase_user_data(1).pointer == nullptr);
    CHECK(phasetreeGetGeometryPhaseUserData(geometry.get(), 3, nullptr, nullptr) == PHASETREE_ERROR_NONE);

    std::int64_t integer = 7;
    void* pointer = mine;
    expect_error(phasetreeSetGeometryPhaseUserData(geometry.get(), 64, 0, nullptr), PHASETREE_ERROR_INVALID_ARGUMENT,
                 "phase is 64");
    expect_error(phasetreeGetGeometryPhaseUserData(geometry.get(), PHASETREE_UNKNOWN_PHASE, &integer, &pointer),
                 PHASETREE_ERROR_INVALID_ARGUMENT, "phase is");
    PhasetreeGeometry freed = nullptr;
    {
        const embree::Geometry gone(device, object_tree());
        freed = gone.get();
    }
    for (const PhasetreeGeometry bad : {static_cast<PhasetreeGeometry>(nullptr), freed}) {
        expect_error(phasetreeSetGeometryPhaseUserData(bad, 1, 0, nullptr), PHASETREE_ERROR_INVALID_HANDLE, "geometry");
        expect_error(phasetreeGetGeometryPhaseUserData(bad, 1, &integer, &pointer), PHASETREE_ERROR_INVALID_HANDLE,
                     "geometry");
    }
    CHECK(integer == 7);
    CHECK(pointer == mine);
}

}  // namespace test_materials
