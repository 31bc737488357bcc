#include "phasetree/nodes/fields/mesh_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "nodes/mesh_tree_view.hpp"
#include "phasetree/math/portable.hpp"

namespace phasetree::mesh {

namespace {

constexpr std::size_t tallest = 64;  // never reached, because the tree is balanced

// Calls f with each piece of this kind in a leaf; pieces of one kind are contiguous.
template <class Kind, class F>
void for_each_piece(const TreeView& view, const float* leaf, F&& f) {
    constexpr auto kind = static_cast<std::size_t>(Kind::kind);
    const float* piece = view.pieces[kind] + static_cast<std::size_t>(leaf[PieceTree::first + 2 * kind]) * Kind::floats;
    for (auto left = static_cast<std::size_t>(leaf[PieceTree::first + 2 * kind + 1]); left > 0; --left) {
        f(piece);
        piece += Kind::floats;
    }
}

template <class Number>
Number squared_distance_to_box(const float* node, const Number* p) {
    Number sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Number below = static_cast<Number>(node[PieceTree::low + i]) - p[i];
        const Number above = p[i] - static_cast<Number>(node[PieceTree::high + i]);
        const Number away = std::max(std::max(below, above), Number{0});
        sum += away * away;
    }
    return sum;
}

// An upper bound on the rounding errors of distances from p to pieces. It depends on the size of the box and on the
// distance of p from it.
template <class Number>
Number margin(const float* box, const Number* p) {
    Number sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
        sum += std::abs(p[i] - static_cast<Number>(box[i])) + 2 * static_cast<Number>(box[3 + i]);
    return sum * static_cast<Number>(2e-6);
}

// Visits the leaves, near ones first, whose boxes are no farther from p than limit(), which may decrease meanwhile.
template <class Number, class Limit, class Visit>
void for_each_leaf(const TreeView& view, const Number* p, const Limit& limit, const Visit& visit) {
    struct Entry {
        std::size_t node;
        Number squared;
    };
    std::array<Entry, tallest> stack;
    std::size_t depth = 0;
    stack[depth++] = {0, squared_distance_to_box(view.node(0), p)};
    while (depth > 0) {
        const Entry entry = stack[--depth];
        const Number most = limit();
        if (!(entry.squared <= most * most)) continue;
        const float* node = view.node(entry.node);
        const auto second = static_cast<std::size_t>(node[PieceTree::second_child]);
        if (second == 0) {
            if (!visit(node)) return;
            continue;
        }
        Entry near{entry.node + 1, squared_distance_to_box(view.node(entry.node + 1), p)};
        Entry far{second, squared_distance_to_box(view.node(second), p)};
        if (far.squared < near.squared) std::swap(near, far);
        stack[depth++] = far;
        stack[depth++] = near;
    }
}

// Bounds of the distance from the points of a box to a piece.
struct InBox {
    double least;      // lower bound over the whole box
    double at_centre;  // upper bound at the centre
};

struct BoxOfPoints {
    std::array<double, 3> centre, half_extents;
    double radius, margin;

    double along(const float* direction, const float* origin) const {
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i)
            sum += static_cast<double>(direction[i]) * (centre[i] - static_cast<double>(origin[i]));
        return sum;
    }
    double half_width_along(const float* direction) const {
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) sum += std::abs(static_cast<double>(direction[i])) * half_extents[i];
        return sum;
    }
    double distance_to(const float* origin, const float* vector, double t) const {
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double along = vector ? t * static_cast<double>(vector[i]) : 0;
            const double away = centre[i] - static_cast<double>(origin[i]) - along;
            sum += away * away;
        }
        return std::sqrt(sum);
    }

    static constexpr double never = std::numeric_limits<double>::infinity();

    template <class Kind>
    InBox of(const float* piece) const {
        if constexpr (std::is_same_v<Kind, Face>) {
            const double height = along(piece + Face::normal, piece + Face::corner);
            double beside = 0;  // distance of the centre from the prism, by the side that it is farthest beyond
            for (std::size_t side = 0; side < 3; ++side) {
                const float* inward = piece + Face::inward + 3 * side;
                double within = along(inward, piece + Face::corner);
                if (side == 1) within -= static_cast<double>(piece[Face::opposite]);
                if (within + half_width_along(inward) < -margin) return {never, never};
                beside = std::max(beside, -within);
            }
            const double lower = std::max(std::abs(height) - half_width_along(piece + Face::normal), 0.0);
            return {std::max(lower, portable::hypot(height, beside) - radius), beside > 0 ? never : std::abs(height)};
        } else if constexpr (std::is_same_v<Kind, Edge>) {
            const float *end = piece + Edge::end, *vector = piece + Edge::vector;
            const auto inverse = static_cast<double>(piece[Edge::inverse]);
            const double t = along(vector, end) * inverse, change = half_width_along(vector) * inverse;
            const double slack = margin * std::sqrt(inverse);
            if (t + change < -slack || t - change > 1 + slack) return {never, never};
            const double distance = distance_to(end, vector, std::clamp(t, 0.0, 1.0));
            return {distance - radius, distance};
        } else {
            const double distance = distance_to(piece + Vertex::position, nullptr, 0);
            return {distance - radius, distance};
        }
    }
};

}  // namespace

FoundPiece PieceTree::nearest(const float* data, const Vec3<float>& point) {
    const TreeView view(data);
    const float p[] = {point.x, point.y, point.z};
    const float slack = margin(data + piece_kinds, p);
    FoundPiece found;
    float least = nowhere, limit = farthest;
    for_each_leaf(
        view, p, [&] { return limit; },
        [&](const float* leaf) {
            const float before = least;
            for_each_kind([&]<class Kind>() {
                for_each_piece<Kind>(view, leaf, [&](const float* piece) {
                    const float squared = Kind::tell(piece, point).squared;
                    // All pieces are in one array, kind after kind, so the lower address identifies the first of two.
                    if (!(squared < least || (squared == least && found.piece && piece < found.piece))) return;
                    least = squared;
                    found = {piece, Kind::kind};
                });
            });
            if (least < before) limit = std::sqrt(least) + slack;
            return true;
        });
    return found;
}

bool PieceTree::pieces_in(const float* tree, const PointRange& range, std::span<const float> around, std::size_t most,
                          std::vector<float>& floats) {
    BoxOfPoints box{range.centre, range.half_extents,
                    portable::hypot(range.half_extents[0], range.half_extents[1], range.half_extents[2]), 0};
    box.margin = margin(tree + piece_kinds, box.centre.data()) + 2e-6 * box.radius;
    if (!(box.margin < 1e12)) return false;

    // First find an upper bound on the distance at the centre, then all pieces that can be at most that far away
    // somewhere.
    struct Candidate {
        const float* piece;
        PieceKind kind;
        double least;
    };
    std::vector<Candidate> candidates;
    double upper = BoxOfPoints::never;
    const auto consider = [&]<class Kind>(const float* piece) {
        const InBox known = box.of<Kind>(piece);
        if (known.least == BoxOfPoints::never) return;
        upper = std::min(upper, known.at_centre);
        candidates.push_back({piece, Kind::kind, known.least});
    };
    const auto farthest_in_box = [&] { return upper + box.radius + 2 * box.margin; };
    const auto remove_far = [&] {
        std::erase_if(candidates, [&](const Candidate& c) { return c.least > farthest_in_box(); });
    };
    if (around.empty()) {
        const TreeView view(tree);
        bool is_too_many = false;
        for_each_leaf(
            view, box.centre.data(), [&] { return farthest_in_box() + box.radius; },
            [&](const float* leaf) {
                for_each_kind([&]<class Kind>() {
                    for_each_piece<Kind>(view, leaf,
                                         [&](const float* piece) { consider.template operator()<Kind>(piece); });
                });
                // Near leaves come first, so if many candidates remain after some leaves, they are likely to stay.
                if (candidates.size() > 4 * most) {
                    remove_far();
                    is_too_many = candidates.size() > 2 * most;
                }
                return !is_too_many;
            });
        if (is_too_many) return false;
    } else {
        const float* piece = around.data() + PieceList::head;
        for_each_kind([&]<class Kind>() {
            for (std::size_t left = PieceList::count(around.data(), Kind::kind); left > 0; --left) {
                consider.template operator()<Kind>(piece);
                piece += Kind::floats;
            }
        });
    }
    remove_far();
    if (candidates.size() > most || candidates.empty()) return false;
    std::ranges::sort(candidates, {}, &Candidate::piece);
    std::array<float, piece_kinds> counts{};
    for (const Candidate& c : candidates) ++counts[static_cast<std::size_t>(c.kind)];
    floats.insert(floats.end(), counts.begin(), counts.end());
    const float* const mesh_box = tree + piece_kinds;
    floats.insert(floats.end(), mesh_box, mesh_box + box_floats);
    for (const Candidate& c : candidates)
        floats.insert(floats.end(), c.piece, c.piece + piece_floats[static_cast<std::size_t>(c.kind)]);
    return true;
}

}  // namespace phasetree::mesh
