// The walk that defines the meaning of a tree (tree/walk.hpp), with numbers that remember their primitive. For each
// primitive met, the nodes above it are stored as a list whose common parts are shared between paths.
#include "phasetree/tree/value_source.hpp"

#include <algorithm>

#include "tree/sourced.hpp"
#include "tree/walk.hpp"

namespace phasetree {

namespace {

using tree::Source;
using tree::Sourced;

// some tenths of a second
constexpr std::size_t most_steps = 2'000'000;

class SourceWalk {
  public:
    using Scalar = Sourced;
    using Point = Vec3<Sourced>;

    Sourced field(const Field& f, const Point& p) {
        return std::visit(
            [&](const auto& n) {
                using N = std::remove_cvref_t<decltype(n)>;
                const Below below(*this, {f.node(), N::info.name});
                if constexpr (Primitive<N> || DataPrimitive<N>)
                    return primitive(n, p);
                else
                    return n.evaluate(*this, p);
            },
            f.node()->node);
    }
    Phases<Sourced> phases(const Phased& a, const Point& p) {
        return std::visit(
            [&](const auto& n) {
                const Below below(*this, {a.node(), std::remove_cvref_t<decltype(n)>::info.name});
                return n.evaluate(*this, p);
            },
            a.node()->node);
    }
    template <class P>
    Sourced primitive(const P& primitive, const Point& p) {
        return {Walk<float>().primitive(primitive, {p.x.value(), p.y.value(), p.z.value()}), Source{here_}};
    }
    Sourced one_lipschitz(const Sourced& value, const Point&) const { return value; }
    template <PointMap M>
    Point map(const M& m, const Point& p, float /*lipschitz*/) const {
        return m(p);
    }

    std::vector<NodeOnPath> path_to(Source source) const {
        std::vector<NodeOnPath> path;
        for (std::int32_t i = source.index; i != Source::none; i = steps_[i].above) path.push_back(steps_[i].node);
        std::ranges::reverse(path);
        return path;
    }

  private:
    struct Step {
        NodeOnPath node;
        std::int32_t above;
    };

    // The walk is below a node as long as this object lives.
    struct Below {
        Below(SourceWalk& w, NodeOnPath node) : walk(w), above(w.here_) {
            if (w.steps_.size() == most_steps)
                throw ModelError("the tree expands to too many nodes, because every use of a shape repeats it");
            w.steps_.push_back({node, above});
            w.here_ = static_cast<std::int32_t>(w.steps_.size()) - 1;
        }
        ~Below() { walk.here_ = above; }
        Below(const Below&) = delete;
        Below& operator=(const Below&) = delete;

        SourceWalk& walk;
        std::int32_t above;
    };

    std::vector<Step> steps_;
    std::int32_t here_ = Source::none;
};
static_assert(EvaluationDomain<SourceWalk>);

}  // namespace

std::vector<NodeOnPath> value_source(const Phased& object, const glm::vec3& p, Phase component) {
    SourceWalk walk;
    const Phases<Sourced> values = walk.phases(object, {Sourced(p.x), Sourced(p.y), Sourced(p.z)});
    if (!values.has(component.index)) return {};
    return walk.path_to(values[component.index].source());
}

}  // namespace phasetree
