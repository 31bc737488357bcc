#include "phasetree/nodes/profiles/outline_in_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "phasetree/math/portable.hpp"

namespace phasetree {

namespace {

constexpr std::size_t piece_floats = OutlinePieces::floats;
// The cost of one piece; a simple instruction costs 2.
constexpr unsigned work_of_curved = 200, work_of_straight = 60;

// An outline, or the part of it that is left in a surrounding box.
struct Outline {
    std::span<const float> pieces, heights;
    float half_thickness, sign;

    static Outline whole(const float* data) {
        return {{data + OutlineInBox::head, static_cast<std::size_t>(data[0]) * piece_floats}, {}, data[1], 1};
    }
    static Outline in_box(const float* data) {
        const float* const heights = data + OutlineInBox::Specialised::head;
        const auto count = static_cast<std::size_t>(data[3]);
        return {
            {heights + count, static_cast<std::size_t>(data[0]) * piece_floats}, {heights, count}, data[1], data[2]};
    }
};

// A rectangle in the plane.
struct Rectangle2 {
    glm::dvec2 low, high;

    // The bounding rectangle of a piece, whose curve lies within the hull of its control points.
    static Rectangle2 around(std::span<const float> piece) {
        const glm::dvec2 s(piece[0], piece[1]), b(piece[3], piece[4]), a(piece[5], piece[6]);
        const glm::dvec2 control = s + b, end = s + 2.0 * b + a;
        return {glm::min(s, glm::min(control, end)), glm::max(s, glm::max(control, end))};
    }
    double distance_to(const Rectangle2& other) const {
        const glm::dvec2 gap = glm::max(glm::max(other.low - high, low - other.high), glm::dvec2(0));
        return glm::length(gap);
    }
};

double distance_to_farthest(const Rectangle2& box, const glm::dvec2& p) {
    return glm::length(glm::max(p - box.low, box.high - p));
}

}  // namespace

bool OutlineInBox::specialise(const float* data, const PointRange& range, std::span<const float> of,
                              std::vector<float>& floats) {
    const Outline outline = of.empty() ? Outline::whole(data) : Outline::in_box(of.data());
    const std::size_t count = outline.pieces.size() / piece_floats;
    const glm::dvec2 centre(range.centre[0], range.centre[1]), half(range.half_extents[0], range.half_extents[1]);
    const Rectangle2 box{centre - half, centre + half};
    const auto piece = [&](std::size_t i) { return outline.pieces.subspan(i * piece_floats, piece_floats); };

    // No point of the box is farther from the outline than `nearest`; `rounding` bounds the error of distances.
    double nearest = std::numeric_limits<double>::infinity();
    double size = std::max(glm::length(box.low), glm::length(box.high));
    for (std::size_t i = 0; i < count; ++i) {
        const std::span<const float> p = piece(i);
        const glm::dvec2 s(p[0], p[1]), middle = s + glm::dvec2(p[3], p[4]) + 0.25 * glm::dvec2(p[5], p[6]);
        nearest = std::min({nearest, distance_to_farthest(box, s), distance_to_farthest(box, middle)});
        size = std::max(size, glm::length(s) + 2 * portable::hypot(p[3], p[4]) + portable::hypot(p[5], p[6]));
    }
    const double rounding = 4e-6 * size;

    std::vector<float> kept, heights(outline.heights.begin(), outline.heights.end());
    for (std::size_t i = 0; i < count; ++i) {
        const std::span<const float> p = piece(i);
        const Rectangle2 around = Rectangle2::around(p);
        const bool is_near = !(around.distance_to(box) > nearest + rounding);
        const double low = std::min(p[1], p[2]), high = std::max(p[1], p[2]);
        const bool is_beside = outline.half_thickness == 0 && low <= box.high.y && high > box.low.y &&
                               around.high.x >= box.low.x - rounding;
        const bool is_right_of_all = around.low.x > box.high.x + rounding;
        if (is_near || (is_beside && !is_right_of_all))
            kept.insert(kept.end(), p.begin(), p.end());
        else if (is_right_of_all && outline.half_thickness == 0)
            heights.insert(heights.end(), {p[1], p[2]});
    }

    // Two equal heights cancel. A height below the box flips the sign of all its points, and a height above it of none.
    float sign = outline.sign;
    std::ranges::sort(heights);
    std::vector<float> left;
    for (const float y : heights) {
        if (static_cast<double>(y) > box.high.y) break;
        if (static_cast<double>(y) <= box.low.y)
            sign = -sign;
        else if (!left.empty() && left.back() == y)
            left.pop_back();
        else
            left.push_back(y);
    }
    if (5 * kept.size() > 4 * outline.pieces.size()) {
        // The saving is too small to justify separate data, unless the surrounding box had its own.
        if (of.empty()) return false;
        floats.insert(floats.end(), of.begin(), of.end());
        return true;
    }
    floats.insert(floats.end(), {static_cast<float>(kept.size() / piece_floats), outline.half_thickness, sign,
                                 static_cast<float>(left.size())});
    floats.insert(floats.end(), left.begin(), left.end());
    floats.insert(floats.end(), kept.begin(), kept.end());
    return true;
}

float OutlineInBox::spacing(const float* data) {
    const Outline outline = Outline::whole(data);
    double length = 0;
    for (std::size_t i = 0; i < outline.pieces.size(); i += piece_floats) {
        const float* const p = &outline.pieces[i];
        length += portable::hypot(2.0 * static_cast<double>(p[3]) + static_cast<double>(p[5]),
                                  2.0 * static_cast<double>(p[4]) + static_cast<double>(p[6]));
    }
    return static_cast<float>(length * piece_floats / static_cast<double>(outline.pieces.size()));
}

unsigned OutlineInBox::Specialised::half_instructions(const float* data) {
    const Outline outline = Outline::in_box(data);
    unsigned work = 8 + 4 * static_cast<unsigned>(outline.heights.size());
    for (std::size_t i = 0; i < outline.pieces.size(); i += piece_floats)
        work += OutlinePieces::is_straight(&outline.pieces[i]) ? work_of_straight : work_of_curved;
    return work;
}

bool OutlineInBox::Specialised::is_sound(std::span<const float> of) {
    const auto is_count = [](float v) { return v >= 0 && v <= 1e6f && v == std::floor(v); };
    return of.size() >= head && is_count(of[0]) && of[0] > 0 && is_count(of[3]) && of.size() >= floats(of.data());
}

}  // namespace phasetree
