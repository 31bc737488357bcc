#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace phasetree {

/// A text as a font draws it, laid out in lines. The unit is the font's em, the size of its letters: capitals are about
/// 0.7 of it high. x is along the line from its beginning, y is up from the line.
struct TextOutlines {
    /// A closed outline by its points, one on the curve, then a control point of a quadratic Bézier curve, and so on.
    /// The outer ones of a font's letter run one way around and its holes the other way.
    using Contour = std::vector<glm::vec2>;

    struct Letter {
        float x = 0;    ///< where it stands in its line
        int place = 0;  ///< how many letters and spaces are before it
        std::vector<Contour> contours{};
    };
    struct Line {
        float width = 0;
        int places = 0;  ///< how many letters and spaces it has
        std::vector<Letter> letters{};
    };
    std::vector<Line> lines{};

    std::size_t bytes() const {
        std::size_t sum = std::span(lines).size_bytes();
        for (const Line& line : lines) {
            sum += std::span(line.letters).size_bytes();
            for (const Letter& letter : line.letters)
                for (const Contour& contour : letter.contours) sum += sizeof contour + std::span(contour).size_bytes();
        }
        return sum;
    }
};

}  // namespace phasetree
