#pragma once

/// Texts for tests, with letters that occur in no font: blobs, with and without holes, that may overlap.

#include <algorithm>
#include <cmath>

#include "phasetree/nodes/profiles/text_outlines.hpp"
#include "support/random_tree.hpp"

namespace phasetree::tests {

/// A closed curve counter-clockwise around a centre, at about that distance. Some of its parts are straight.
inline TextOutlines::Contour random_contour(Random& rng, const glm::vec2& centre, float radius) {
    TextOutlines::Contour contour;
    const int corners = 3 + rng.below(4);
    const auto at = [&](float turn, float away) {
        const float angle = 6.2831853f * turn / static_cast<float>(corners);
        return centre + away * radius * glm::vec2(std::cos(angle), std::sin(angle));
    };
    for (int i = 0; i < corners; ++i) contour.push_back(at(static_cast<float>(i), rng.uniform(0.8f, 1)));
    for (int i = corners; i > 0; --i) {
        const glm::vec2 start = contour[static_cast<std::size_t>(i) - 1];
        const glm::vec2 end = contour[static_cast<std::size_t>(i) % contour.size()];
        const glm::vec2 control =
            rng.chance(0.4) ? 0.5f * (start + end) : at(static_cast<float>(i) - 0.5f, rng.uniform(0.8f, 1.1f));
        contour.insert(contour.begin() + i, control);
    }
    return contour;
}

/// Each letter is one stroke or two: an outer contour and at most one hole behind it, which runs the other way around.
/// In half of the texts all run clockwise instead of counter-clockwise, and the other way around.
inline TextOutlines random_text(Random& rng) {
    TextOutlines text;
    const bool is_reversed = rng.chance(0.5);
    const auto reversed = [](TextOutlines::Contour c) {
        // The first point, which is on the curve, stays the first.
        std::reverse(c.begin() + 1, c.end());
        return c;
    };
    for (int lines = 1 + rng.below(2); lines > 0; --lines) {
        TextOutlines::Line& line = text.lines.emplace_back();
        for (int letters = 1 + rng.below(3); letters > 0; --letters) {
            TextOutlines::Letter letter{line.width, line.places++, {}};
            // If strokes may overlap, no hole may be in two of them.
            const bool may_overlap = rng.chance(0.5);
            const int strokes = 1 + rng.below(2);
            for (int i = 0; i < strokes; ++i) {
                const float apart = may_overlap ? 0.f : 1.1f * static_cast<float>(i);
                const glm::vec2 centre(rng.uniform(0, 0.4f) + apart, rng.uniform(0, 0.4f));
                const float radius = rng.uniform(0.1f, 0.3f);
                const auto outer = random_contour(rng, centre, radius);
                letter.contours.push_back(is_reversed ? reversed(outer) : outer);
                if (rng.chance(0.5) || (may_overlap && strokes > 1)) continue;
                // The chords of a triangle's corners come as near to its centre as half of the least radius.
                const auto hole = random_contour(rng, centre, 0.3f * radius);
                letter.contours.push_back(is_reversed ? hole : reversed(hole));
            }
            line.letters.push_back(letter);
            line.width += rng.uniform(0.2f, 0.8f);
        }
    }
    return text;
}

}  // namespace phasetree::tests
