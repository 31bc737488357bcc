// Trees of forty levels, in which every child of a node is the same node of the level below: few nodes that stand for
// billions. A function that walks a tree must visit each node once, or count its steps and give up. One that does
// neither shows as a test that does not end.
#include <doctest/doctest.h>

#include "phasetree/io/write.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/program/program.hpp"
#include "support/random_node.hpp"
#include "tree/node.hpp"

namespace test_shared_shapes {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

constexpr int levels = 40;

struct Shapes {
    Field field;
    Phased object;

    explicit Shapes(Field f) : field(f), object(Set{.phase = Phase{1}, .of = f}) {}
    explicit Shapes(Phased o) : field(Merge{.of = o}), object(o) {}
};

/// Each time that a shape is requested, it is a little further along, or else always in one place.
class Moved {
  public:
    Moved(const Shapes& shapes, bool moves) : shapes_(shapes), moves_(moves) {}
    void operator()(Field& f) { f = moves_ ? warped(next(), shapes_.field) : shapes_.field; }
    void operator()(Phased& o) { o = moves_ ? warped(next(), shapes_.object) : shapes_.object; }

  private:
    Translate next() { return {{0.01f * static_cast<float>(++count_), 0, 0}}; }

    const Shapes& shapes_;
    bool moves_;
    int count_ = 0;
};

/// Replaces all children of a node by `below`. Returns false if it has none.
template <class Node>
bool stand_on(Node& node, const Shapes& below, bool moves) {
    bool has_children = false;
    Moved moved(below, moves);
    for_each_parameter(node, [&](auto& value, const Parameter&) {
        using T = std::remove_cvref_t<decltype(value)>;
        if constexpr (std::is_same_v<T, Field> || std::is_same_v<T, Phased>) {
            moved(value);
            has_children = true;
        } else if constexpr (std::is_same_v<T, std::vector<Field>> || std::is_same_v<T, std::vector<Phased>>) {
            if (value.size() < 2) value.resize(2);
            for (auto& child : value) moved(child);
            has_children = true;
        }
    });
    return has_children;
}

struct Answers {
    int nodes = 0, refused_nodes = 0, programs = 0, refused_programs = 0, written = 0;
};

template <class Node>
void climb(Random& rng, bool moves, Answers& answers) {
    using Handle = std::conditional_t<IsFieldNode<Node>, Field, Phased>;
    CAPTURE(Node::info.name);
    Node node = std::get<Node>(random_rooted<Node>(rng, 3).node()->node);
    Shapes shapes(Field(Sphere{.radius = 0.5f}));
    if constexpr (!IsFieldNode<Node>)
        shapes = Shapes(Under{.of = {Set{.phase = Phase{1}, .of = Sphere{.radius = 0.5f}},
                                     Set{.phase = Phase{2}, .of = Box{.size = glm::vec3(0.9f)}}}});
    for (int level = 0; level < levels; ++level) {
        try {
            if (!stand_on(node, shapes, moves)) return;
            shapes = Shapes(Handle(node));
            ++answers.nodes;
        } catch (const ModelError&) {
            ++answers.refused_nodes;  // too large, unbounded, too many phases …
            break;
        }
    }
    (void)bounds(shapes.object);
    CHECK(statistics(shapes.object).nodes < 10 * levels * 4);
    try {
        (void)record(shapes.object, 50'000);  // a tenth of what is allowed: the test is in a hurry
        ++answers.programs;
    } catch (const ModelError&) {
        ++answers.refused_programs;
    }
    try {
        answers.written += !write_tree({{{"vacuum", "a", "b", "c", "d"}}, shapes.object}).empty();
    } catch (const ModelError&) {
    }
}

}  // namespace

TEST_CASE("of forty levels of any node there is an answer, or it is rejected") {
    Random rng(40);
    for (const bool moves : {false, true}) {
        Answers answers;
        for_each_type(FieldNodes(), [&]<class Node>() { climb<Node>(rng, moves, answers); });
        for_each_type(PhasedNodes(), [&]<class Node>() { climb<Node>(rng, moves, answers); });
        MESSAGE(answers.nodes, " nodes, ", answers.refused_nodes, " refused; ", answers.programs, " programs, ",
                answers.refused_programs, " refused; ", answers.written, " written");
        CHECK(answers.nodes > 1000);
        CHECK(answers.programs > 20);
        CHECK(answers.written > 20);
        if (moves) CHECK(answers.refused_programs > 10);
    }
}

}  // namespace test_shared_shapes
