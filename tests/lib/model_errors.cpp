// Impossible parameters are rejected in words, and deep trees work up to the depth at which they are rejected.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <limits>

#include "math/dual.hpp"
#include "phasetree/carving/carve.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/io/write.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/program/program.hpp"
#include "phasetree/trace/tracer.hpp"
#include "phasetree/tree/unbounded.hpp"
#include "support/dual_distances.hpp"
#include "support/random_node.hpp"
#include "tree/node.hpp"

namespace test_model_errors {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

template <class Node>
std::string error(Node node) {
    try {
        if constexpr (IsFieldNode<Node>)
            (void)Field(std::move(node));
        else
            (void)Phased(std::move(node));
    } catch (const ModelError& e) {
        return e.what();
    }
    return "no error";
}

const Field ball = Sphere{};
const Phased object = Set{.phase = Phase{1}, .of = Sphere{}};

}  // namespace

TEST_CASE("errors name the node, the parameter and what is wrong") {
    CHECK(error(Sphere{.radius = 0}) == "sphere: \"radius\" must be positive, but is 0");
    CHECK(error(Sphere{.radius = -1.5f}) == "sphere: \"radius\" must be positive, but is -1.5");
    CHECK(error(Sphere{.radius = not_a_number}) == "sphere: \"radius\" must be a finite number");
    CHECK(error(Sphere{.radius = infinity}) == "sphere: \"radius\" must be a finite number");
    CHECK(error(Box{.size = {1, 0, 1}}) == "box: \"size\" must be positive, but is 0");
    CHECK(error(Box{.size = {1, 1, not_a_number}}) == "box: \"size\" must be a finite number");
    CHECK(error(RoundedBox{.size = {1, 1, 1}, .radius = 0.6f}) ==
          "rounded_box: the radius is more than half the shortest edge");
    CHECK(error(RoundedBox{.size = {1, 1, 1}, .radius = -0.1f}) ==
          "rounded_box: \"radius\" must be zero or more, but is -0.1");
    CHECK(error(CappedCone{.radius_bottom = 0, .radius_top = 0, .height = 1}) == "capped_cone: both radii are zero");
    CHECK(error(Plane{.normal = {0, 0, 0}}) == "plane: the normal must not be zero");
    CHECK(error(Union{}) == "union: \"of\" must not be empty");
    CHECK(error(Union{.of = {ball, Field()}}) == "union: \"of\" has an empty entry");
    CHECK(error(Offset{}) == "offset: \"of\" is missing");
    CHECK(error(Under{}) == "under: \"of\" must not be empty");
    CHECK(error(Set{.phase = vacuum, .of = ball}) == "set: \"phase\" must be a phase other than the vacuum");
    CHECK(error(Set{.phase = Phase{64}, .of = ball}) == "set: \"phase\" must be a phase other than the vacuum");
    CHECK(error(ThinShell{.of = ball, .shell = Phase{2}, .inside = Phase{2}}) ==
          "thin_shell: the wall and the interior must be different phases");
    CHECK(error(Change{.of = object, .from = Phase{1}, .to = Phase{1}, .shape = {}}) ==
          "change: a phase cannot be changed into itself");
    CHECK(error(Remove{.of = object, .gone = PhaseSet::of(vacuum)}) == "remove: the vacuum cannot be removed");
    CHECK(error(Merge{.of = object, .phases = PhaseSet::of(Phase{2})}) ==
          "merge: the object has none of the phases to merge");
    CHECK(error(WarpedField<Rotate>{{Rotate{.axis = {0, 0, 0}, .angle = 1}, ball, {}}}) ==
          "rotate: the axis must not be zero");
    CHECK(error(WarpedField<Scale>{{Scale{.factor = 0}, ball, {}}}) == "scale: \"factor\" must be positive, but is 0");
    CHECK(error(WarpedField<Twist>{{Twist{.rate = 10}, Plane{}, {}}}) ==
          "twist: the child is unbounded because of its \"plane\" (at plane); intersect it with a box: "
          "{\"intersection\": {\"of\": [{\"plane\": …}, {\"box\": …}]}}");
    CHECK(error(WarpedField<Twist>{{Twist{.rate = 1e6f}, ball, {}}}) ==
          "twist: more than 800 turns from the origin to an end of the object");
    CHECK(error(WarpedField<Translate>{{Translate{.by = {0, infinity, 0}}, ball, {}}}) ==
          "translate: \"by\" must be a finite number");
}

namespace {

std::vector<float> excluded_by(const Limits& limits) {
    std::vector<float> bad{not_a_number, infinity, -infinity};
    if (limits.low > limits::any.low)
        bad.push_back(limits.low_open ? limits.low : std::nextafter(limits.low, -infinity));
    if (limits.high < limits::any.high)
        bad.push_back(limits.high_open ? limits.high : std::nextafter(limits.high, infinity));
    return bad;
}

void check_refused(const std::string& error, std::string_view node, std::string_view parameter, float value) {
    CAPTURE(node);
    CAPTURE(parameter);
    CAPTURE(value);
    CHECK(error.find("\"" + std::string(parameter) + "\" must be ") != std::string::npos);
}

}  // namespace

TEST_CASE("every numeric parameter of every node refuses what its limits exclude, and NaN and infinity") {
    Random rng(81);
    const auto check = [&]<class Node>() {
        Node good;
        for_each_parameter(good, [&](auto& value, const Parameter& p) { fill<Node>(rng, value, p, 1); });
        int index = 0;
        for_each_parameter(good, [&](auto& value, const Parameter& p) {
            using Value = std::remove_cvref_t<decltype(value)>;
            if constexpr (std::is_same_v<Value, float> || std::is_same_v<Value, glm::vec3>) {
                for (const float b : excluded_by(p.limits)) {
                    Node node = good;
                    int i = 0;
                    for_each_parameter(node, [&](auto& v, const Parameter&) {
                        if (i++ != index) return;
                        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(v)>, float>) v = b;
                        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(v)>, glm::vec3>) v[1] = b;
                    });
                    check_refused(error(node), Node::info.name, p.name, b);
                }
            }
            ++index;
        });
    };
    for_each_type(FieldNodes(), check);
    for_each_type(PhasedNodes(), check);
}

namespace {

struct Answers {
    std::size_t built = 0, refused = 0, unusable = 0;
    std::string which;  ///< the first tree that is unusable
};

void look_at_centre(const Phased& a, Answers& answers) {
    ++answers.built;
    const InterfaceTracer tracer(a);
    Evaluator::Workspace w;
    const Phases<float> phi = tracer.evaluator().distances(tracer.bounds().centre(), w);
    bool bad = !(tracer.resolution() > 0) || !std::isfinite(tracer.resolution());
    for_each_phase(phi.present, [&](int i) { bad = bad || std::isnan(phi[i]); });
    if (bad && answers.unusable++ == 0) answers.which = write_tree({{{"vacuum", "1", "2", "3", "4"}}, a});
}

}  // namespace

TEST_CASE("extreme but legal numbers give finite values or an error, never NaN") {
    // The smallest and the largest floats that the limits allow, in every number at once or one at a time.
    Random rng(82);
    Answers answers;
    const auto check = [&]<class Node>() {
        for (int n = 0; n < 300; ++n) {
            Node node;
            for_each_parameter(node, [&](auto& value, const Parameter& p) { fill<Node>(rng, value, p, 1); });
            const auto extreme = [&](float& v, const Parameter& p) {
                const float choices[] = {1e-45f, 1e-40f, 1e-30f, 1e-20f, 1e-10f, 1e10f, 1e18f, 1e30f, 3e38f, 0.f};
                const float e = choices[rng.below(10)] * (rng.chance(0.5) ? 1.f : -1.f);
                if (rng.chance(0.5) && p.limits.contains(e)) v = e;
            };
            for_each_parameter(node, [&](auto& value, const Parameter& p) {
                using Value = std::remove_cvref_t<decltype(value)>;
                if constexpr (std::is_same_v<Value, float>) extreme(value, p);
                if constexpr (std::is_same_v<Value, glm::vec3>)
                    for (int i = 0; i < 3; ++i) extreme(value[i], p);
            });
            try {
                if constexpr (IsFieldNode<Node>)
                    look_at_centre(Set{.phase = Phase{1}, .of = Field(node)}, answers);
                else
                    look_at_centre(Phased(node), answers);
            } catch (const ModelError&) {
                ++answers.refused;
            }
        }
    };
    for_each_type(FieldNodes(), check);
    for_each_type(PhasedNodes(), check);
    MESSAGE(answers.built, " built, ", answers.refused, " refused, ", answers.unusable, " with NaN: ", answers.which);
    CHECK(answers.unusable == 0);
}

namespace {

/// The node around itself until the tree is as deep as that.
template <class Node>
auto chain(std::size_t depth) {
    using Handle = std::conditional_t<IsFieldNode<Node>, Field, Phased>;
    Random rng(83);
    Handle current;
    if constexpr (IsFieldNode<Node>)
        current = Sphere{};
    else
        current = ThinShell{.of = Sphere{}, .shell = Phase{1}, .inside = Phase{2}};
    while (current.node()->depth < depth) {
        Node node;
        for_each_parameter(node, [&](auto& value, const Parameter& p) {
            using Value = std::remove_cvref_t<decltype(value)>;
            if constexpr (std::is_same_v<Value, Handle>)
                value = current;
            else if constexpr (std::is_same_v<Value, std::vector<Handle>>)
                value = {current};
            else if constexpr (std::is_same_v<Value, PhaseSet>)
                value = PhaseSet{p.optional ? 0u : 16u};
            else if constexpr (std::is_same_v<Value, float>)
                value = p.optional ? value : p.limits.contains(0.f) ? 0.f : p.unit == "m" ? 1e-4f : 1.f;
            else if constexpr (std::is_same_v<Value, glm::vec3>) {
                if (!p.optional) fill<Node>(rng, value, p, 1);
            } else if constexpr (std::is_same_v<Value, int>)
                value = 1;  // one copy of a copy, else they are 2⁴⁰⁰
            else if constexpr (std::is_same_v<Value, std::vector<glm::vec3>>)
                value = std::vector<glm::vec3>(p.optional ? 0 : 1, glm::vec3(0.001f));
            else if constexpr (std::is_same_v<Value, std::vector<float>>)
                value = std::vector<float>(p.optional ? 0 : 1, p.unit == "m" ? 1e-4f : 1.f);
            else if constexpr (std::is_same_v<Value, std::vector<Phase>>)
                value = {Phase{1}};  // as many as there are numbers
            else
                fill<Node>(rng, value, p, 1);
        });
        if constexpr (std::is_same_v<Node, Change>) {
            node.from = Phase{1};
            node.to = Phase{2};
        }
        if constexpr (std::is_same_v<Node, Interface>) {
            node.phase_a = Phase{1};
            node.phase_b = Phase{2};
        }
        if constexpr (std::is_same_v<Node, CloseGaps>) node.of_phases = {Phase{1}, Phase{2}};
        // A blob evaluates its skeletons at thousands of points while it is prepared.
        if constexpr (std::is_same_v<Node, Blob>) {
            if (current.node()->depth == 20) break;
        }
        if constexpr (requires { node.surface; }) node.surface = Sphere{};
        // The other children must not be the chain again, or the tree has 2⁴⁰⁰ branches.
        if constexpr (requires { node.volume; }) node.volume = Sphere{};
        if constexpr (requires { node.proxy; }) node.proxy = Sphere{};
        if constexpr (IsEndlessGrid<Node>) {
            if (!bounds(current).finite()) break;
            node.spacing = glm::vec3(1.1f * bounds(current).extent().x + 0.01f, 0, 0);
        }
        // The box around a twisted box is √2 wider, so a chain of twists ends where floats do.
        if constexpr (NeedsBoundedChild<Node>) {
            if (bounds(current).diagonal() > 1e15f) break;
        }
        current = node;
    }
    return current;
}

template <class Node>
concept HasChildOfItsKind = requires(Node n) {
    n.of;
    requires std::is_same_v<decltype(n.of), std::conditional_t<IsFieldNode<Node>, Field, Phased>> ||
        std::is_same_v<decltype(n.of), std::vector<std::conditional_t<IsFieldNode<Node>, Field, Phased>>>;
};

void check_answers(const Phased& a) {
    (void)bounds(a);
    (void)statistics(a);
    const glm::vec3 p{0.1f, 0.2f, 0.3f};
    const Evaluator evaluator(record(a));
    Evaluator::Workspace w;
    CHECK(evaluator.label(p, w) == label(distances(a, p)));
    (void)dual_distances(a, p);
}

}  // namespace

TEST_CASE("a tree as deep as the limit is walked, recorded, bounded and destroyed") {
    const auto check = [&]<class Node>() {
        if constexpr (HasChildOfItsKind<Node>) {
            CAPTURE(Node::info.name);
            const auto deep = chain<Node>(max_tree_depth - 1);
            CHECK((NeedsBoundedChild<Node> || std::is_same_v<Node, Blob> || deep.node()->depth == max_tree_depth - 1));
            Phased a;
            if constexpr (IsFieldNode<Node>)
                a = Set{.phase = Phase{1}, .of = deep};
            else
                a = deep;
            check_answers(a);
        }
    };
    for_each_type(FieldNodes(), check);
    for_each_type(PhasedNodes(), check);
}

TEST_CASE("a deeper tree is rejected") {
    const auto grow = [](std::size_t depth) {
        Field f = Sphere{};
        for (std::size_t i = 1; i < depth; ++i) f = Offset{.of = f, .amount = 0};
        return f;
    };
    CHECK(grow(max_tree_depth).node()->depth == max_tree_depth);
    CHECK_THROWS_WITH_AS((void)grow(max_tree_depth + 1),
                         fmt::format("the tree is deeper than {} nodes", max_tree_depth).c_str(), ModelError);
}

TEST_CASE("a node that needs a bounded child names what makes the child unbounded") {
    const Field halves = Union{.of = {ball, Plane{}}};
    const Phased solid = Set{.phase = Phase{1}, .of = halves};
    const std::string intersect =
        "; intersect it with a box: {\"intersection\": {\"of\": [{\"plane\": …}, {\"box\": …}]}}";
    CHECK(error(WarpedField<Bend>{{Bend{.rate = 10}, halves, {}}}) ==
          "bend: the child is unbounded because of its \"plane\" (at union.of[1].plane)" + intersect);
    CHECK(error(FieldEndlessGrid{{.of = halves, .spacing = {1, 0, 0}}}) ==
          "endless_grid: the child is unbounded because of its \"plane\" (at union.of[1].plane)" + intersect);
    CHECK(error(PhasedEndlessGrid{{.of = solid, .spacing = {1, 0, 0}}}) ==
          "endless_grid: the child is unbounded because of its \"plane\" (at set.of.union.of[1].plane)" + intersect);
    CHECK(error(FieldBoundingVolume{{.of = halves, .volume = {}}}) ==
          "bounding_volume: the child is unbounded because of its \"plane\" (at union.of[1].plane), so it has no "
          "bounding box; give a \"volume\"");
    FieldScatter scatter;
    scatter.of = ball;
    scatter.surface = halves;
    CHECK(error(scatter) ==
          "scatter: the surface is unbounded because of its \"plane\" (at union.of[1].plane)" + intersect);
}

TEST_CASE("an object that cannot be traced says so") {
    const auto why = [](const Phased& a) -> std::string {
        try {
            const InterfaceTracer tracer(a);
        } catch (const ModelError& e) {
            return e.what();
        }
        return "no error";
    };
    CHECK(why(object) == "no error");
    CHECK(why(Set{.phase = Phase{1}, .of = Plane{}}) ==
          "the object is unbounded because of its \"plane\" (at set.of.plane); intersect it with a box: "
          "{\"intersection\": {\"of\": [{\"plane\": …}, {\"box\": …}]}}");
    CHECK(why(Set{.phase = Phase{1}, .of = Offset{.of = ball, .amount = -2}}) == "the object is empty");
}

TEST_CASE("the nodes that make an object unbounded are found") {
    const auto paths = [](const auto& tree) {
        std::string all;
        for (const UnboundedPart& part : unbounded_parts(tree)) all += (all.empty() ? "" : " ") + part.path;
        return all;
    };
    const Field plane = Plane{}, other = Plane{.normal = {0, 0, -1}}, side = Plane{.normal = {1, 0, 0}};
    CHECK(paths(ball) == "");
    CHECK(paths(plane) == "plane");
    CHECK(paths(Field(Union{.of = {ball, plane}})) == "union.of[1].plane");
    // The shape subtracted from a ball may be unbounded, but not the shape from which a ball is subtracted.
    CHECK(paths(Field(Difference{.from = ball, .subtract = {plane}})) == "");
    CHECK(paths(Field(Difference{.from = plane, .subtract = {ball, side}})) == "difference.from.plane");
    // A node whose children are bounded, or are each needed, is itself the reason.
    CHECK(paths(Field(FieldEndlessGrid{{.of = Sphere{.radius = 0.2f}, .spacing = {1, 0, 0}}})) == "endless_grid");
    CHECK(paths(Field(Union{.of = {ball, Intersection{.of = {plane, side}}}})) == "union.of[1].intersection");
    // A shared node is reported once, and there are at most three.
    CHECK(paths(Field(Union{.of = {plane, plane}})) == "union.of[0].plane");
    CHECK(paths(Field(Union{.of = {plane, other, side, Plane{.offset = 1}}})) ==
          "union.of[0].plane union.of[1].plane union.of[2].plane");
    const Phased both = Over{.of = {Set{.phase = Phase{2}, .of = ball}, Set{.phase = Phase{1}, .of = plane}}};
    CHECK(paths(both) == "over.of[1].set.of.plane");
    CHECK(how_to_bound(unbounded_parts(plane).front()) ==
          "intersect it with a box: {\"intersection\": {\"of\": [{\"plane\": …}, {\"box\": …}]}}");
    CHECK_THROWS_WITH_AS((void)carve(plane), doctest::Contains("because of its \"plane\" (at plane)"), UnboundedError);
    // Many unbounded parts, none of which is the reason: the search gives up early.
    std::vector<Field> many;
    for (int i = 0; i < 3000; ++i) many.push_back(Plane{.normal = {1, 0, 0.001f * static_cast<float>(i)}});
    CHECK(paths(Field(Intersection{.of = many})) == "intersection");
}

}  // namespace test_model_errors
