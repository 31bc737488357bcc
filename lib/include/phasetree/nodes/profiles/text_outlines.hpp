#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "phasetree/model/from_file.hpp"

namespace phasetree {

/// A text laid out in lines, as outlines of a font. The unit is the font's em: capitals are about 0.7 em high. x runs
/// along the line from its start, y upwards from the baseline.
struct TextOutlines {
    /// A closed outline: alternately a point on the curve and a control point of a quadratic Bézier curve. A letter's
    /// outer contours run in one direction and its holes in the other.
    using Contour = std::vector<glm::vec2>;

    struct Letter {
        float x = 0;    ///< position in its line
        int place = 0;  ///< number of letters and spaces before it
        std::vector<Contour> contours{};
    };
    struct Line {
        float width = 0;
        int places = 0;  ///< number of letters and spaces
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

template <>
struct FileFormat<TextOutlines> {
    static constexpr std::string_view no_reader = "this program cannot read fonts";
};

}  // namespace phasetree
