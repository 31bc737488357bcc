#pragma once

#include <memory>
#include <string>
#include <vector>

#include "phasetree/model/from_file.hpp"
#include "phasetree/nodes/profiles/outline_in_box.hpp"
#include "phasetree/nodes/profiles/text_outlines.hpp"

namespace phasetree {

/// A letter is the union of its strokes; a stroke is an outer contour without its holes (TextOutlines). Overlapping
/// strokes of a letter, which occur in some fonts, therefore form one solid. Within a stroke, contours must not cross.
struct Text {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{
        "text", "", "min over the letters of ± min over their curves of |p − B(t)|",
        "Text in a font, for extruding; the same at every z, exact where no two letters overlap. The baseline of the "
        "first line is at y = 0, and further lines follow below."};
    static constexpr std::size_t max_strokes = 4096, max_pieces = 1 << 16;

    /// The primitive of one stroke, a filled outline.
    struct Stroke {
        std::shared_ptr<const std::vector<float>> table{};

        std::span<const float> data() const { return *table; }
        template <class T>
        static T distance(const float* data, const Vec3<T>& p) {
            return OutlineInBox::distance(data, p);
        }
        using Specialised = OutlineInBox::Specialised;
        static float spacing(const float* data) { return OutlineInBox::spacing(data); }
        static constexpr unsigned search_half_instructions = OutlineInBox::search_half_instructions;
        static bool specialise(const float* data, const PointRange& range, std::span<const float> of,
                               std::vector<float>& floats) {
            return OutlineInBox::specialise(data, range, of, floats);
        }
    };
    using Parts = TypeList<Stroke>;  // Bezier lists Specialised

    std::string text{};
    FromFile<TextOutlines> file{};
    float size = 1, align = 0, spacing = 0, line_height = 1.2f;
    std::vector<Stroke> strokes{};  ///< derived
    Bounds box{};                   ///< derived, at z = 0

    template <class V>
    static void parameters(V&& v) {
        v(&Text::text, Parameter{"text", "", "The text; \\n begins a new line."});
        v(&Text::file, Parameter{"file", "", "Font file: TrueType or OpenType (.ttf, .otf)."});
        v(&Text::size,
          Parameter{"size", "m", "Em size of the font; capitals are about 0.7 em high.", limits::positive, true});
        v(&Text::align,
          Parameter{"align", "", "Alignment of each line: 0 puts its beginning at x = 0, 0.5 its middle, 1 its end.",
                    limits::fraction, true});
        v(&Text::spacing,
          Parameter{
              "spacing", "em", "Additional space after each letter; may be negative.", {.low = -1, .high = 100}, true});
        v(&Text::line_height, Parameter{"line_height", "em", "Distance between lines.", limits::positive, true});
    }
    /// The part of the file that is read.
    std::string part_of_file() const { return text; }
    void prepare();
    std::size_t derived_bytes() const {
        std::size_t bytes = std::span(strokes).size_bytes();
        for (const Stroke& s : strokes) bytes += s.data().size_bytes();
        return bytes;
    }
    template <class D>
    typename D::Scalar evaluate(D& d, const typename D::Point& p) const {
        auto nearest = d.primitive(strokes.front(), p);
        for (const Stroke& s : std::span(strokes).subspan(1)) nearest = min(nearest, d.primitive(s, p));
        return nearest;
    }
    Bounds bounds(BoundsQuery& q, float level) const {
        const float rounding = 2e-7f * (glm::length(box.centre()) + box.diagonal());
        return q.placed(detail::at_every_height(box, rounding + level));
    }
};

}  // namespace phasetree
