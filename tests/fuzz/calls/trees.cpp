// Trees are created from texts, edited, reference-counted and queried.
#include <cstdint>
#include <cstring>
#include <vector>

#include "fuzz/calls/calls.hpp"

namespace phasetree::fuzz {

namespace {

constexpr const char* texts[] = {
    R"({"phases": {"a": {}}, "tree": {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}}})",
    R"({"phases": {"a": {}, "b": {}}, "shapes": {"s": {"sphere": {"radius": 0.5}}}, "tree": {"under": [
        {"set": {"phase": "a", "of": {"box": {"size": [1, 1, 1]}}}}, {"set": {"phase": "b", "of": "s"}}]}})",
    R"({"phases": {"a": {}, "b": {}, "c": {}}, "tree": {"thin_shell": {"of": {"torus": {"major": 1, "minor": 0.3}},
        "shell": "a", "inside": "b", "half_thickness": 0.05}}})",
    R"({"phases": {"a": {}}, "tree": {"set": {"phase": "a", "of": {"plane": {}}}}})",
    R"({"phases": {"a": {}}, "tree": {"set": {"phase": "a", "of": {"height_map": {"file": "h", "size": [1, 1],
        "height": 0.5}}}}})",
    R"({"phases": {"a": {}}, "tree": {"set": {"phase": "b", "of": {"sphere": {"radius": 1}}}}})",
    "{",
    "",
};
constexpr const char* paths[] = {"/tree/set/of/sphere/radius",
                                 "/shapes/s/sphere/radius",
                                 "/tree",
                                 "",
                                 "/",
                                 "/nowhere",
                                 "/tree/under/0",
                                 "tree",
                                 "/~2",
                                 "/phases"};
constexpr const char* values[] = {"0.5", "2", "-1", "1e39", "{\"sphere\": {\"radius\": 1}}", "null", "[", "", "\"a\""};

const char* read_image(void* user, const char*, PhasetreeImage image) {
    const auto kind = reinterpret_cast<std::uintptr_t>(user);
    if (kind == 0) return "no such file";
    if (kind == 1) return nullptr;
    if (phasetreeNewImageValues(image, 0, 5) || phasetreeNewImageValues(nullptr, 5, 5)) broken("sizes are checked");
    float* const heights = phasetreeNewImageValues(image, 3, 2);
    for (int i = 0; i < 6; ++i) heights[i] = static_cast<float>(i) / 6;
    return nullptr;
}

}  // namespace

void Calls::new_tree() {
    const PhasetreeFileReader reader{c_.rarely() ? nullptr : read_image,
                                     reinterpret_cast<void*>(std::uintptr_t{c_.below(3)})};
    const PhasetreeFileReader* const with = c_.below(3) == 0 ? nullptr : &reader;
    const char* const name = c_.below(2) == 0 ? nullptr : "scene.json";
    const char* const text = c_.of(texts);
    const std::size_t length = std::strlen(text) - (c_.rarely() && *text != 0 ? 1 : 0);
    PhasetreeTree made = nullptr;
    PhasetreeTree* const to = c_.or_null(&made);
    const auto error = c_.rarely() ? phasetreeNewTreeFromFile(version(), c_.or_null("/nowhere"), with, to)
                                   : phasetreeNewTreeFromText(version(), c_.or_null(text), length, name, with, to);
    check(error);
    promised((error == PHASETREE_ERROR_NONE) == (made != nullptr), "a handle comes with success and only then");
    if (made) trees_.push_back({made, 1});
}

void Calls::new_edited_tree() {
    const PhasetreeTree of = tree();
    PhasetreeTree made = nullptr;
    const char* const path = c_.or_null(c_.of(paths));
    const char* const value = c_.or_null(c_.of(values));
    const auto error = phasetreeNewEditedTree(of, path, value, c_.or_null(&made));
    check_with(of, error);
    if (error == PHASETREE_ERROR_NONE) trees_.push_back({made, 1});
}

void Calls::count_tree() {
    const PhasetreeTree of = tree();
    const bool more = c_.below(3) == 0;
    count(trees_, of, more ? phasetreeRetainTree(of) : phasetreeReleaseTree(of), more ? 1 : -1);
}

void Calls::ask_tree() {
    const PhasetreeTree of = tree();
    unsigned phases = 0, phase = 0;
    const char* name = nullptr;
    RTCBounds bounds;
    check_with(of, phasetreeGetTreePhaseCount(of, c_.or_null(&phases)));
    check_with(of, phasetreeGetTreePhaseName(of, c_.below(5), c_.or_null(&name)));
    check_with(of, phasetreeGetTreePhaseByName(of, c_.or_null(name ? name : "b"), c_.or_null(&phase)));
    check_with(of, phasetreeGetTreeBounds(of, c_.or_null(&bounds)));
    PhasetreeCarveOptions options;
    phasetreeInitCarveOptions(&options);
    options.maxPlanes = c_.below(12);
    options.tolerance = 0.02f;
    options.maxEvaluations = c_.below(300);
    PhasetreePlane planes[12];
    unsigned count = 0;
    PhasetreeCarvedBounds carved;
    check_with(of, phasetreeCarveTree(of, c_.below(16), &options, c_.or_null(planes), c_.or_null(&count),
                                      c_.or_null(&carved)));
    ask_tree_precisely(of);
    measure_tree(of);
}

// Numbers of any size, and some that are not finite.
void Calls::ask_tree_precisely(PhasetreeTree of) {
    double points[6];
    for (double& x : points) x = static_cast<double>(c_.number());
    unsigned phases[2];
    double distances[2];
    check_with(of, phasetreeLocate(of, c_.or_null(points), c_.below(3), c_.or_null(phases)));
    check_with(of, phasetreeGetSafeDistances(of, c_.or_null(points), c_.below(3), c_.or_null(distances)));
    PhasetreePreciseRay ray{};
    for (int i = 0; i < 3; ++i) {
        ray.origin[i] = static_cast<double>(c_.number());
        ray.direction[i] = static_cast<double>(c_.number());
    }
    ray.tMax = static_cast<double>(c_.number());
    ray.carried = c_.below(2) == 0 ? PHASETREE_UNKNOWN_PHASE : c_.below(5);
    PhasetreePreciseCrossing crossing;
    const auto stop = [](void*) { return true; };
    check_with(of, phasetreeFindCrossings(of, c_.or_null(&ray), c_.below(2), c_.or_null(&crossing),
                                          c_.rarely() ? +stop : nullptr, nullptr));
}

// With few boxes, because trees may be complex.
void Calls::measure_tree(PhasetreeTree of) {
    std::vector<double> numbers(PHASETREE_MAX_PHASES, static_cast<double>(c_.number()));
    std::vector<PhasetreeMeasuredPhase> phases(PHASETREE_MAX_PHASES);
    PhasetreeMeasureOptions measuring;
    phasetreeInitMeasureOptions(&measuring);
    measuring.tolerance = c_.rarely() ? static_cast<double>(c_.number()) : 0.5;
    measuring.maxBoxes = c_.below(100);
    measuring.densities = c_.or_null(numbers.data());
    PhasetreeBody all;
    PhasetreeMeasureEnd end;
    check_with(of, phasetreeMeasureTree(of, c_.rarely() ? &measuring : nullptr, nullptr, &all, &end));
    check_with(of, phasetreeMeasureTree(of, &measuring, phases.data(), c_.or_null(&all), c_.or_null(&end)));
    PhasetreeStatement statements[2];
    for (PhasetreeStatement& s : statements) {
        phasetreeInitStatement(&s, static_cast<PhasetreeStatementKind>(c_.below(10)), c_.below(16));
        s.inside = c_.below(16);
        s.atLeast = static_cast<double>(c_.number());
        s.weights = c_.or_null(numbers.data());
    }
    PhasetreeProveOptions proving;
    phasetreeInitProveOptions(&proving);
    proving.resolution = c_.rarely() ? static_cast<double>(c_.number()) : 0;
    proving.maxBoxes = c_.below(200);
    proving.seconds = 0.01;
    PhasetreeProof proofs[2];
    PhasetreeWitness witnesses[3];
    std::size_t witness_count = 0;
    check_with(of, phasetreeProveStatements(of, c_.or_null(statements), c_.below(3), &proving, c_.or_null(proofs),
                                            c_.or_null(witnesses), c_.below(4), c_.or_null(&witness_count)));
}

}  // namespace phasetree::fuzz
