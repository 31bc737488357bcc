#include "phasetree/nodes/profiles/text.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace phasetree {

namespace {

using Contour = TextOutlines::Contour;
using Pieces = std::vector<float>;

constexpr std::size_t most_contours_of_letter = 256;
constexpr float largest = 1e9f;  // limit of all coordinates, in metres

// Points along a contour. They only serve to compute areas and to test which contour is inside which, so no finer
// approximation of the curves is needed.
std::vector<glm::dvec2> points_along(const Contour& contour) {
    constexpr int steps = 8;
    std::vector<glm::dvec2> points;
    for_each_curve(contour, [&](const QuadraticCurve& curve) {
        for (int i = 0; i < steps; ++i) points.push_back(curve.at(static_cast<double>(i) / steps));
    });
    return points;
}

// Positive for a contour that runs counter-clockwise.
double signed_area(std::span<const glm::dvec2> points) {
    double twice = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec2 a = points[i], b = points[(i + 1) % points.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * twice;
}

bool is_around(std::span<const glm::dvec2> points, const glm::dvec2& p) {
    bool inside = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec2 a = points[i], b = points[(i + 1) % points.size()];
        if ((a.y <= p.y) != (b.y <= p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
    return inside;
}

struct Traced {
    const Contour* contour;
    std::vector<glm::dvec2> points;
    double area;
    bool is_outer = false;
};

// The contours of each stroke of a letter: an outer contour and its holes. A hole belongs to the smallest outer contour
// around it; a hole that is in none is dropped. The orientation of outer contours differs between fonts; the largest
// contour is always an outer one.
std::vector<std::vector<const Contour*>> strokes_of(const TextOutlines::Letter& letter) {
    std::vector<Traced> all;
    for (const Contour& contour : letter.contours) {
        std::vector<glm::dvec2> points = points_along(contour);
        const double area = signed_area(points);
        if (area != 0) all.push_back({&contour, std::move(points), area});
    }
    // Sort by size, smallest first.
    std::ranges::stable_sort(all, {}, [](const Traced& t) { return std::abs(t.area); });
    std::vector<std::vector<const Contour*>> strokes;
    std::vector<std::size_t> stroke_of(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i].is_outer = (all[i].area > 0) == (all.back().area > 0);
        if (!all[i].is_outer) continue;
        stroke_of[i] = strokes.size();
        strokes.push_back({all[i].contour});
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].is_outer) continue;
        for (std::size_t j = i + 1; j < all.size(); ++j)
            if (all[j].is_outer &&
                std::ranges::all_of(all[i].points, [&](const glm::dvec2& p) { return is_around(all[j].points, p); })) {
                strokes[stroke_of[j]].push_back(all[i].contour);
                break;
            }
    }
    return strokes;
}

}  // namespace

void Text::prepare() {
    strokes.clear();
    box = {};
    std::size_t pieces = 0;
    float y = 0;
    for (const TextOutlines::Line& line : file.content->lines) {
        const float width = line.width + spacing * static_cast<float>(std::max(0, line.places - 1));
        for (const TextOutlines::Letter& letter : line.letters) {
            if (letter.contours.size() > most_contours_of_letter)
                throw ModelError("text: a letter of the font has more than 256 outlines");
            const glm::vec2 at{letter.x + spacing * static_cast<float>(letter.place) - align * width, y};
            for (const std::vector<const Contour*>& stroke : strokes_of(letter)) {
                Pieces table{0.f, 0.f};
                std::size_t count = 0;
                for (const Contour* contour : stroke) {
                    Contour placed = *contour;
                    for (glm::vec2& p : placed) {
                        p = size * (at + p);
                        if (!(std::abs(p.x) <= largest && std::abs(p.y) <= largest))
                            throw ModelError("text: it reaches beyond 1e9 m from the origin");
                    }
                    for_each_curve(placed, [&](const QuadraticCurve& curve) {
                        count += OutlinePieces::append(curve, table);
                        box = unite(box, curve.bounds());
                    });
                }
                if (count == 0) continue;
                table[0] = static_cast<float>(count);
                pieces += count;
                strokes.push_back({std::make_shared<const Pieces>(std::move(table))});
                if (strokes.size() > max_strokes || pieces > max_pieces)
                    throw ModelError("text: its letters have more than 4096 outlines, or 65536 curves");
            }
        }
        y -= line_height;
    }
    if (strokes.empty()) throw ModelError("text: none of its letters has an outline");
}

}  // namespace phasetree
