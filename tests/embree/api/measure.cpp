// Measures and proofs through the C99 interface: the same numbers as in C++, witnesses, and wrong arguments.
#include <array>

#include "embree/api/api.hpp"
#include "phasetree/measuring/measure.hpp"
#include "phasetree/measuring/prove.hpp"

namespace test_measure {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

constexpr auto none = PHASETREE_ERROR_NONE, invalid = PHASETREE_ERROR_INVALID_ARGUMENT;
constexpr std::size_t count_of_phases = 5;
constexpr PhasetreePhaseSet glass = 1 << 1, water = 1 << 2, metal = 1 << 3, sand = 1 << 4;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void check_equal(const PhasetreeMeasured& a, const Measured& b) {
    CHECK(a.low == b.low);
    CHECK(a.high == b.high);
    CHECK(a.estimate == b.estimate);
}

void check_equal(const PhasetreeBody& a, const Body& b) {
    check_equal(a.volume, b.volume);
    check_equal(a.mass, b.mass);
    for (std::size_t i = 0; i < 3; ++i) {
        check_equal(a.centre[i], b.centre[i]);
        check_equal(a.inertia[i], b.inertia[i][i]);
    }
    check_equal(a.inertia[3], b.inertia[0][1]);
    check_equal(a.inertia[4], b.inertia[0][2]);
    check_equal(a.inertia[5], b.inertia[1][2]);
}

PhasetreeMeasureOptions coarse() {
    PhasetreeMeasureOptions options;
    phasetreeInitMeasureOptions(&options);
    options.tolerance = 0.05;
    return options;
}

PhasetreeStatement statement(PhasetreeStatementKind kind, PhasetreePhaseSet phases, double at_least = 0) {
    PhasetreeStatement s;
    phasetreeInitStatement(&s, kind, phases);
    s.atLeast = at_least;
    return s;
}

}  // namespace

TEST_CASE("measures are those of C++") {
    const embree::Tree tree = object_tree();
    const std::array<double, count_of_phases> densities{nan, 2500, nan, 7800, nan};
    PhasetreeMeasureOptions options = coarse();
    options.densities = densities.data();
    double done = 0;
    options.progress = [](void* user, double fraction) { *static_cast<double*>(user) = fraction; };
    options.progressUserPtr = &done;
    std::array<PhasetreeMeasuredPhase, count_of_phases> phases{};
    PhasetreeBody all;
    PhasetreeMeasureEnd end;
    REQUIRE(phasetreeMeasureTree(tree.get(), &options, phases.data(), &all, &end) == none);
    MeasureOptions same{.tolerance = 0.05};
    same.densities = {{Phase{1}, 2500.0}, {Phase{3}, 7800.0}};
    const MeasureResult expected = measure(object(), same);
    REQUIRE(expected.phases.size() == 4);
    check_equal(phases[0].body.volume, expected.vacuum);
    for (const MeasuredPhase& p : expected.phases) {
        const PhasetreeMeasuredPhase& found = phases[p.phase.index];
        check_equal(found.body, p.body);
        for (std::size_t i = 0; i < 3; ++i) {
            check_equal(found.boxLow[i], p.box_low[i]);
            check_equal(found.boxHigh[i], p.box_high[i]);
        }
    }
    check_equal(all, *expected.all);
    CHECK(end == PHASETREE_MEASURE_END_TOLERANCE);
    CHECK(done == 1);
    CHECK(phases[1].body.mass.estimate == doctest::Approx(2500 * phases[1].body.volume.estimate));
}

TEST_CASE("measuring refuses wrong arguments, and gives what is known when it is cancelled") {
    const embree::Tree tree = object_tree();
    std::array<PhasetreeMeasuredPhase, count_of_phases> phases{};
    phases[1].body.volume.low = 77;
    const auto measured = [&](const PhasetreeMeasureOptions& options) {
        return phasetreeMeasureTree(tree.get(), &options, phases.data(), nullptr, nullptr);
    };
    PhasetreeMeasureOptions options = coarse();
    expect_error(phasetreeMeasureTree(nullptr, &options, phases.data(), nullptr, nullptr),
                 PHASETREE_ERROR_INVALID_HANDLE, "tree is NULL");
    expect_error(phasetreeMeasureTree(tree.get(), &options, nullptr, nullptr, nullptr), invalid, "phases is NULL");
    options.tolerance = 0;
    expect_error(measured(options), invalid, "tolerance");
    options = coarse();
    options.seconds = nan;
    expect_error(measured(options), invalid, "time");
    options = coarse();
    const std::array<double, count_of_phases> negative{0, 1, -1, 1, 1};
    options.densities = negative.data();
    expect_error(measured(options), invalid, "options->densities[2] is -1");
    const embree::Tree endless =
        embree::Tree::from_text(R"({"phases": {"a": {}}, "tree": {"set": {"phase": "a", "of": {"plane": {}}}}})");
    expect_error(phasetreeMeasureTree(endless.get(), nullptr, phases.data(), nullptr, nullptr),
                 PHASETREE_ERROR_INVALID_TREE, "unbounded");
    CHECK(phases[1].body.volume.low == 77);

    options = coarse();
    options.cancelled = [](void*) { return true; };
    PhasetreeMeasureEnd end;
    PhasetreeBody all;
    REQUIRE(phasetreeMeasureTree(tree.get(), &options, phases.data(), &all, &end) == none);
    CHECK(end == PHASETREE_MEASURE_END_CANCELLED);
    CHECK(phases[1].body.volume.low <= phases[1].body.volume.high);
    CHECK(all.volume.high == 0);

    // A phase that the tree does not use has no volume, and its density does not matter.
    const embree::Tree unused = embree::Tree::from_text(
        R"({"phases": {"a": {}, "b": {}}, "tree": {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}}})");
    const std::array<double, 3> ones{1, 1, 1};
    options = coarse();
    options.densities = ones.data();
    REQUIRE(phasetreeMeasureTree(unused.get(), &options, phases.data(), &all, nullptr) == none);
    CHECK(phases[2].body.volume.high == 0);
    CHECK(std::isinf(phases[2].body.centre[0].high));
    CHECK(all.volume.low <= 4.18879);
    CHECK(all.volume.high >= 4.18879);
}

TEST_CASE("proofs are those of C++") {
    const embree::Tree tree = object_tree();
    PhasetreeStatement closed = statement(PHASETREE_STATEMENT_CLOSED, glass);
    closed.inside = water;
    PhasetreeStatement volume = statement(PHASETREE_STATEMENT_VOLUME, glass | water, 1);
    const std::array<double, count_of_phases> weights{0, 2, 1, 0, 0};
    volume.weights = weights.data();
    volume.atMost = 10;
    PhasetreeStatement tight = statement(PHASETREE_STATEMENT_TIGHT_BOUNDS, 0);
    tight.atMost = 1.5;
    const std::vector<PhasetreeStatement> statements{
        statement(PHASETREE_STATEMENT_PRESENT, metal),
        statement(PHASETREE_STATEMENT_CONNECTED, metal),
        closed,
        statement(PHASETREE_STATEMENT_APART, water | sand, 0.02),
        statement(PHASETREE_STATEMENT_APART, water | sand, 0.5),
        statement(PHASETREE_STATEMENT_TOUCHING, metal | sand),
        statement(PHASETREE_STATEMENT_WALL, glass, 0.2),
        volume,
        statement(PHASETREE_STATEMENT_NO_DEAD_NODES, 0),
        tight,
    };
    const std::vector<Statement> same{
        IsPresent{Phase{3}},
        IsConnected{Phase{3}},
        IsClosed{{glass}, {water}},
        AreApart{Phase{2}, Phase{4}, 0.02},
        AreApart{Phase{2}, Phase{4}, 0.5},
        AreTouching{Phase{3}, Phase{4}},
        IsThick{Phase{1}, 0.2},
        HasVolume{{{Phase{1}, 2.0}, {Phase{2}, 1.0}}, 1, 10},
        HasNoDeadNodes{},
        HasTightBounds{1.5},
    };
    PhasetreeProveOptions options;
    phasetreeInitProveOptions(&options);
    options.resolution = 0.05;
    ProveOptions same_options;
    same_options.resolution = 0.05;
    const std::vector<Proof> expected = prove(object(), same, same_options);
    std::vector<PhasetreeProof> proofs(statements.size());
    std::vector<PhasetreeWitness> witnesses(1000);
    std::size_t count = 0;
    REQUIRE(phasetreeProveStatements(tree.get(), statements.data(), statements.size(), &options, proofs.data(),
                                     witnesses.data(), witnesses.size(), &count) == none);
    std::size_t at = 0, proved = 0, refuted = 0;
    for (std::size_t i = 0; i < proofs.size(); ++i) {
        CAPTURE(i);
        CHECK(static_cast<int>(proofs[i].verdict) == static_cast<int>(expected[i].verdict));
        CHECK(proofs[i].reason == expected[i].reason);
        CHECK(proofs[i].resolution == expected[i].resolution);
        CHECK(proofs[i].firstWitness == at);
        REQUIRE(proofs[i].witnessCount == expected[i].witnesses.size());
        for (const Witness& w : expected[i].witnesses) {
            CHECK(vec(witnesses[at].point) == w.point);
            CHECK(witnesses[at++].phase == w.phase.index);
        }
        proved += proofs[i].verdict == PHASETREE_VERDICT_PROVED;
        refuted += proofs[i].verdict == PHASETREE_VERDICT_REFUTED;
    }
    CHECK(count == at);
    CHECK(count > 4);
    CHECK(proved >= 3);
    CHECK(refuted >= 3);
    check_equal(proofs[7].measured, expected[7].measured);
    CHECK(proofs[0].measured.high == 0);

    // With too little space, the first ones arrive, and the number of all.
    std::vector<PhasetreeWitness> few(3, PhasetreeWitness{{7, 7, 7}, 77});
    REQUIRE(phasetreeProveStatements(tree.get(), statements.data(), statements.size(), &options, proofs.data(),
                                     few.data(), 2, &count) == none);
    CHECK(count == at);
    CHECK(few[1].phase == witnesses[1].phase);
    CHECK(few[2].phase == 77);
}

TEST_CASE("proving refuses wrong arguments, and can be cancelled") {
    const embree::Tree tree = object_tree();
    PhasetreeProof proof{};
    proof.resolution = 77;
    const auto proved = [&](const PhasetreeStatement& s, const PhasetreeProveOptions* options = nullptr) {
        return phasetreeProveStatements(tree.get(), &s, 1, options, &proof, nullptr, 0, nullptr);
    };
    const PhasetreeStatement good = statement(PHASETREE_STATEMENT_PRESENT, glass);
    expect_error(phasetreeProveStatements(nullptr, &good, 1, nullptr, &proof, nullptr, 0, nullptr),
                 PHASETREE_ERROR_INVALID_HANDLE, "tree is NULL");
    expect_error(phasetreeProveStatements(tree.get(), nullptr, 1, nullptr, &proof, nullptr, 0, nullptr), invalid,
                 "statements is NULL");
    expect_error(phasetreeProveStatements(tree.get(), &good, 1, nullptr, nullptr, nullptr, 0, nullptr), invalid,
                 "proofs is NULL");
    expect_error(phasetreeProveStatements(tree.get(), &good, 1, nullptr, &proof, nullptr, 1, nullptr), invalid,
                 "witnesses is NULL");
    CHECK(phasetreeProveStatements(tree.get(), nullptr, 0, nullptr, nullptr, nullptr, 0, nullptr) == none);
    expect_error(proved(statement(PHASETREE_STATEMENT_PRESENT, 0)), invalid, "statement 0 has 0 phases");
    expect_error(proved(statement(PHASETREE_STATEMENT_APART, glass)), invalid, "statement 0 has 1 phases");
    expect_error(proved(statement(PHASETREE_STATEMENT_PRESENT, PhasetreePhaseSet{1} << 63)), invalid,
                 "statement 0 has phase 63, which does not exist; the tree has 5");
    expect_error(proved(statement(PHASETREE_STATEMENT_WALL, glass, nan)), invalid, "statement 0: the thickness");
    expect_error(proved(statement(PHASETREE_STATEMENT_CLOSED, glass)), invalid, "statement 0: \"closed\" needs walls");
    expect_error(proved(statement(PHASETREE_STATEMENT_VOLUME, 0)), invalid, "statement 0 has no phases");
    expect_error(proved(statement(static_cast<PhasetreeStatementKind>(9), glass)), invalid, "statement 0 has kind 9");
    PhasetreeProveOptions options;
    phasetreeInitProveOptions(&options);
    options.resolution = -1;
    expect_error(proved(good, &options), invalid, "the resolution");
    CHECK(proof.resolution == 77);
    phasetreeInitProveOptions(&options);
    options.cancelled = [](void*) { return true; };
    REQUIRE(proved(statement(PHASETREE_STATEMENT_WALL, glass, 1e-4), &options) == none);
    CHECK(proof.verdict == PHASETREE_VERDICT_UNDECIDED);
    CHECK(std::string(proof.reason) == "interrupted");
}

}  // namespace test_measure
