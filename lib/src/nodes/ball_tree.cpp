#include "phasetree/nodes/fields/ball_tree.hpp"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "phasetree/math/portable.hpp"

namespace phasetree::balls {

namespace {

constexpr std::size_t most_in_leaf = 8;
constexpr std::size_t tallest = 64;                // never reached, because the tree is balanced
constexpr std::size_t few = std::size_t{1} << 15;  // fewer balls do not get a task of their own

// The number of balls in a node's first child.
std::size_t half(std::size_t count) {
    return count / 2;
}

// The number of nodes of a tree over this many balls. On each level, every node has either n or n + 1 balls.
std::size_t nodes_over(std::size_t count) {
    std::size_t sum = 0, n = count, with_n = 1, with_one_more = 0;
    for (;;) {
        sum += with_n + with_one_more;
        const std::size_t dividing_n = n > most_in_leaf ? with_n : 0;
        const std::size_t dividing_more = n + 1 > most_in_leaf ? with_one_more : 0;
        if (dividing_n + dividing_more == 0) return sum;
        // n is divided into n/2 twice, or into (n − 1)/2 and (n + 1)/2.
        const bool is_odd = n % 2 == 1;
        with_n = is_odd ? dividing_n : 2 * dividing_n + dividing_more;
        with_one_more = is_odd ? dividing_n + 2 * dividing_more : dividing_more;
        n /= 2;
    }
}

// The locations of a tree's balls and nodes among its floats.
struct TreeView {
    const float* balls;
    float largest;
    const float* nodes;

    explicit TreeView(const float* data)
        : balls(data + ShortList::head), largest(data[ShortList::floats(data)]), nodes(data + nodes_at(data)) {}
    static std::size_t nodes_at(const float* data) { return ShortList::floats(data) + 2; }
    const float* node(std::size_t i) const { return nodes + i * Tree::node_floats; }
    const float* ball(std::size_t i) const { return balls + i * ball_floats; }
};

std::size_t index_at(const float* node, std::size_t member) {
    return static_cast<std::size_t>(node[member]);
}

// Writes the nodes over a range of balls, sorting the balls.
class Writer {
  public:
    Writer(std::vector<glm::vec4>& balls, float* nodes) : balls_(balls), nodes_(nodes) {}

    void write(std::size_t node, std::size_t first, std::size_t count) {
        float* const to = nodes_ + node * Tree::node_floats;
        const auto range = std::span(balls_).subspan(first, count);
        if (count <= most_in_leaf) {
            std::ranges::sort(range, comes_before);  // makes the tree independent of the order of the balls
            Bounds box;
            float radius = 0;
            for (const glm::vec4& b : range) {
                box = unite(box, {glm::vec3(b), glm::vec3(b)});
                radius = std::max(radius, b.w);
            }
            set(to, box, radius, count, first);
            return;
        }
        divide(range);
        const std::size_t first_child = node + 1, second_child = first_child + nodes_over(half(count));
        const auto write_first = [&] { write(first_child, first, half(count)); };
        const auto write_second = [&] { write(second_child, first + half(count), count - half(count)); };
        if (count > few)
            tbb::parallel_invoke(write_first, write_second);
        else
            write_first(), write_second();
        const float *a = nodes_ + first_child * Tree::node_floats, *b = nodes_ + second_child * Tree::node_floats;
        set(to, unite(box_of(a), box_of(b)), std::max(a[Tree::radius], b[Tree::radius]), 0, second_child);
    }

    static Bounds box_of(const float* node) {
        const float *low = node + Tree::low, *high = node + Tree::high;
        return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
    }

  private:
    static bool comes_before(const glm::vec4& a, const glm::vec4& b) {
        for (int i = 0; i < 4; ++i)
            if (a[i] != b[i]) return a[i] < b[i];
        return false;
    }
    // Partitions a range into halves along the axis along which the centres extend farthest.
    static void divide(std::span<glm::vec4> range) {
        Bounds box;
        for (const glm::vec4& b : range) box = unite(box, {glm::vec3(b), glm::vec3(b)});
        const glm::vec3 e = box.extent();
        const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
        std::ranges::nth_element(range, range.begin() + static_cast<std::ptrdiff_t>(half(range.size())),
                                 [axis](const glm::vec4& a, const glm::vec4& b) {
                                     return a[axis] != b[axis] ? a[axis] < b[axis] : comes_before(a, b);
                                 });
    }
    static void set(float* node, const Bounds& box, float radius, std::size_t count, std::size_t link) {
        for (int i = 0; i < 3; ++i) {
            const auto k = static_cast<std::size_t>(i);
            node[Tree::low + k] = box.low[i];
            node[Tree::high + k] = box.high[i];
        }
        node[Tree::radius] = radius;
        node[Tree::count] = static_cast<float>(count);
        node[Tree::link] = static_cast<float>(link);
    }

    std::vector<glm::vec4>& balls_;
    float* nodes_;
};

// A lower bound on the signed distance from a box, or from a point, to the balls below a node.
template <class Number>
Number least_distance(const float* node, const std::array<Number, 3>& p, const std::array<Number, 3>& half_extents) {
    Number sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Number below = static_cast<Number>(node[Tree::low + i]) - p[i];
        const Number above = p[i] - static_cast<Number>(node[Tree::high + i]);
        const Number away = std::max(std::max(below, above) - half_extents[i], Number{0});
        sum += away * away;
    }
    return std::sqrt(sum) - static_cast<Number>(node[Tree::radius]);
}

// Visits the leaves, near ones first, that are no farther from p than limit(), which may decrease meanwhile. Stops when
// a visit returns false.
template <class Number, class Limit, class Visit>
void for_each_leaf(const TreeView& view, const std::array<Number, 3>& p, const std::array<Number, 3>& half_extents,
                   const Limit& limit, const Visit& visit) {
    struct Entry {
        std::size_t node;
        Number least;
    };
    const auto entry = [&](std::size_t node) { return Entry{node, least_distance(view.node(node), p, half_extents)}; };
    std::array<Entry, tallest> stack;
    std::size_t depth = 0;
    stack[depth++] = entry(0);
    while (depth > 0) {
        const Entry top = stack[--depth];
        if (!(top.least <= limit())) continue;
        const float* node = view.node(top.node);
        if (node[Tree::count] != 0) {
            if (!visit(node)) return;
            continue;
        }
        Entry near = entry(top.node + 1), far = entry(index_at(node, Tree::link));
        if (far.least < near.least) std::swap(near, far);
        stack[depth++] = far;
        stack[depth++] = near;
    }
}

// An upper bound on the rounding error of the distance from p to a ball.
template <class Number>
Number margin(float largest, const std::array<Number, 3>& p) {
    const Number far = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    return static_cast<Number>(2e-6) * (far + static_cast<Number>(largest));
}

// Bounds of the distance from the points of a box to a ball.
struct InBox {
    double least, most;
};
InBox in_box(const float* ball, const PointRange& box) {
    double near = 0, far = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double away = std::abs(box.centre[i] - static_cast<double>(ball[i]));
        const double least = std::max(away - box.half_extents[i], 0.0), most = away + box.half_extents[i];
        near += least * least;
        far += most * most;
    }
    const auto radius = static_cast<double>(ball[3]);
    return {std::sqrt(near) - radius, std::sqrt(far) - radius};
}

// The balls found so far that may be nearest somewhere in a box.
class Candidates {
  public:
    Candidates(const Tree::Wanted& wanted, double margin) : wanted_(wanted), margin_(margin) {}

    void consider(const float* ball) {
        const InBox known = in_box(ball, wanted_.box);
        upper_ = std::min(upper_, known.most);
        if (!nearest_ || known.least < least_) {
            nearest_ = ball;
            least_ = known.least;
        }
        if (known.least <= limit()) found_.push_back({ball, known.least});
    }
    /// Balls that are farther than this everywhere in the box do not matter.
    double limit() const { return std::min(upper_, wanted_.farthest) + margin_; }
    std::size_t size() const { return found_.size(); }
    void remove_far() {
        std::erase_if(found_, [&](const Candidate& c) { return c.least > limit(); });
    }
    /// Appends the balls in the order of their addresses. If there are none, the nearest ball considered so far
    /// represents them.
    void append_to(std::vector<float>& floats) {
        remove_far();
        if (found_.empty() && nearest_) found_.push_back({nearest_, least_});
        std::ranges::sort(found_, {}, &Candidate::ball);
        floats.push_back(static_cast<float>(found_.size()));
        for (const Candidate& c : found_) floats.insert(floats.end(), c.ball, c.ball + ball_floats);
    }

  private:
    struct Candidate {
        const float* ball;
        double least;
    };
    const Tree::Wanted& wanted_;
    double margin_;
    double upper_ = std::numeric_limits<double>::infinity();  // of the distance to the nearest ball, over the whole box
    const float* nearest_ = nullptr;
    double least_ = 0;
    std::vector<Candidate> found_;
};

}  // namespace

const float* Tree::nearest(const float* data, const Vec3<float>& point) {
    const TreeView view(data);
    const std::array p{point.x, point.y, point.z};
    const float slack = margin(view.largest, p);
    const float* found = nullptr;
    float least = std::numeric_limits<float>::infinity();
    for_each_leaf(
        view, p, {}, [&] { return least + slack; },
        [&](const float* leaf) {
            const float* ball = view.ball(index_at(leaf, link));
            for (std::size_t left = index_at(leaf, count); left > 0; --left, ball += ball_floats) {
                const float distance = distance_to(ball, point);
                if (!(distance < least || (distance == least && (!found || ball < found)))) continue;
                least = distance;
                found = ball;
            }
            return true;
        });
    return found ? found : view.balls;  // If coordinates are infinite, all balls are equally far away.
}

bool Tree::balls_in(const float* tree, const Wanted& wanted, std::span<const float> around,
                    std::vector<float>& floats) {
    const TreeView view(tree);
    const auto &centre = wanted.box.centre, &half_extents = wanted.box.half_extents;
    const double slack =
        2 * (margin(view.largest, centre) + 2e-6 * std::max({half_extents[0], half_extents[1], half_extents[2]}));
    Candidates candidates(wanted, slack);
    if (!around.empty()) {
        const float* ball = around.data() + ShortList::head;
        for (std::size_t left = ShortList::count(around.data()); left > 0; --left, ball += ball_floats)
            candidates.consider(ball);
        candidates.append_to(floats);
        return true;
    }
    if (!(slack < 1e12)) return false;
    bool is_too_many = false, is_any = false;
    for_each_leaf(
        view, centre, half_extents,
        // Until a ball is found, also search for one that is too far away.
        [&] { return is_any ? candidates.limit() : std::numeric_limits<double>::infinity(); },
        [&](const float* leaf) {
            is_any = true;
            const float* ball = view.ball(index_at(leaf, link));
            for (std::size_t left = index_at(leaf, count); left > 0; --left, ball += ball_floats)
                candidates.consider(ball);
            // Near leaves come first, so if many candidates remain after some leaves, they are likely to stay.
            if (candidates.size() > 4 * wanted.most) {
                candidates.remove_far();
                is_too_many = candidates.size() > 2 * wanted.most;
            }
            return !is_too_many;
        });
    if (is_too_many) return false;
    candidates.remove_far();
    if (candidates.size() > wanted.most) return false;
    candidates.append_to(floats);
    return true;
}

float Tree::spacing(const float* data) {
    const float* root = TreeView(data).node(0);
    double volume = 1;
    for (std::size_t i = 0; i < 3; ++i)
        volume *= static_cast<double>(root[high + i]) - static_cast<double>(root[low + i]) +
                  2 * static_cast<double>(root[radius]);
    return static_cast<float>(portable::cbrt(volume / static_cast<double>(ShortList::count(data))));
}

double Tree::support(const float* data, const glm::dvec3& d, float more) {
    const TreeView view(data);
    const double length = glm::length(d);
    // An upper bound for a node, from its box. The search is ordered by it and ends with it.
    const auto bound = [&](const float* node) {
        const Bounds box = Writer::box_of(node);
        double sum = length * static_cast<double>(node[radius] + more);
        for (int i = 0; i < 3; ++i)
            sum += std::max(d[i] * static_cast<double>(box.low[i]), d[i] * static_cast<double>(box.high[i]));
        return sum;
    };
    double most = -std::numeric_limits<double>::infinity();
    std::array<std::size_t, tallest> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const std::size_t at = stack[--depth];
        const float* node = view.node(at);
        if (!(bound(node) > most)) continue;
        if (node[count] == 0) {
            std::size_t near = at + 1, far = index_at(node, link);
            if (bound(view.node(far)) > bound(view.node(near))) std::swap(near, far);
            stack[depth++] = far;
            stack[depth++] = near;
            continue;
        }
        const float* ball = view.ball(index_at(node, link));
        for (std::size_t left = index_at(node, count); left > 0; --left, ball += ball_floats)
            most = std::max(most, glm::dot(d, glm::dvec3(ball[0], ball[1], ball[2])) +
                                      length * static_cast<double>(ball[3] + more));
    }
    return most;
}

std::vector<float> make_tree(std::vector<glm::vec4> balls) {
    const std::size_t nodes = nodes_over(balls.size());
    std::vector<float> table(ShortList::head + balls.size() * ball_floats + 2 + nodes * Tree::node_floats);
    table[0] = static_cast<float>(balls.size());
    float* const nodes_to = table.data() + TreeView::nodes_at(table.data());
    Writer(balls, nodes_to).write(0, 0, balls.size());
    float largest = 0;
    float* to = table.data() + ShortList::head;
    for (const glm::vec4& b : balls) {
        for (int i = 0; i < 4; ++i) *to++ = b[i];
        largest = std::max({largest, std::abs(b.x), std::abs(b.y), std::abs(b.z), b.w});
    }
    to[0] = largest;
    to[1] = static_cast<float>(nodes);
    return table;
}

Bounds bounds_of(const float* tree) {
    glm::vec3 low, high;
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 axis(0);
        axis[i] = 1;
        // The box contains the exact one, however floats are rounded.
        const double most = Tree::support(tree, axis, 0), least = -Tree::support(tree, -axis, 0);
        high[i] = std::nextafter(static_cast<float>(most), std::numeric_limits<float>::infinity());
        low[i] = std::nextafter(static_cast<float>(least), -std::numeric_limits<float>::infinity());
    }
    return {low, high};
}

}  // namespace phasetree::balls
