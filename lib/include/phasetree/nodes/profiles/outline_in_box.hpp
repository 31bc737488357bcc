#pragma once

#include <span>
#include <vector>

#include "phasetree/math/found_equation.hpp"
#include "phasetree/math/point_range.hpp"
#include "phasetree/nodes/profiles/outline_pieces.hpp"

namespace phasetree {

/// An outline as a primitive with data: the number of pieces, half the thickness (0 for a filled outline), and the
/// pieces (OutlinePieces). In a small box, few pieces matter.
///
/// Only a few pieces can be the nearest. Whether a point is inside depends on all pieces to its right; but of the
/// pieces to the right of the whole box, only the heights of their ends matter. Pieces meet at their ends, so most of
/// these heights cancel. The remaining ones within the heights of the box are stored. Each flips inside and outside for
/// all points at or above it.
struct OutlineInBox {
    static constexpr std::size_t head = 2;  ///< floats of a whole outline before its pieces

    /// The data of the specialised primitive: the number of pieces, half the thickness, a sign, the number of heights,
    /// the heights, and the pieces. The sign is −1 if, without these pieces, the lowest points of the box would be
    /// inside, and otherwise 1.
    struct Specialised {
        static constexpr std::size_t head = 4;
        static constexpr EnclosedBy enclosed_by = EnclosedBy::value_at_centre;
        std::vector<float> values{};

        std::span<const float> data() const { return values; }
        static std::size_t floats(const float* data) {
            return head + static_cast<std::size_t>(data[3]) + static_cast<std::size_t>(data[0]) * OutlinePieces::floats;
        }
        static unsigned half_instructions(const float* data);
        template <class T>
        static T distance(const float* data, const Vec3<T>& p) {
            const auto count = static_cast<int>(data[0]), heights = static_cast<int>(data[3]);
            const float* const pieces = data + head + heights;
            const bool is_line = data[1] > 0;
            const auto sign_without_pieces = [&]<class U>(const Vec3<U>& q) {
                U sign(data[2]);
                for (const float* y = data + head; y != pieces; ++y) sign = select(less(q.y, U(*y)), sign, -sign);
                return sign;
            };
            return equation_for_derivatives(
                       p,
                       [&](const Vec3<float>& q) {
                           return OutlinePieces::find(pieces, count, is_line, q, sign_without_pieces(q));
                       },
                       [](const OutlinePieces::Found& found, const auto& q) {
                           return OutlinePieces::distance_by(found, q);
                       },
                       [&](const auto& q) {
                           return OutlinePieces::distance(pieces, count, is_line, q, sign_without_pieces(q));
                       }) -
                   data[1];
        }
        static bool is_sound(std::span<const float>);
    };

    template <class T>
    static T distance(const float* data, const Vec3<T>& p) {
        const auto count = static_cast<int>(data[0]);
        const float* const pieces = data + head;
        const bool is_line = data[1] > 0;
        return equation_for_derivatives(
                   p, [&](const Vec3<float>& q) { return OutlinePieces::find(pieces, count, is_line, q, 1); },
                   [](const OutlinePieces::Found& found, const auto& q) {
                       return OutlinePieces::distance_by(found, q);
                   },
                   [&]<class U>(const Vec3<U>& q) {
                       return OutlinePieces::distance(pieces, count, is_line, q, U(1.f));
                   }) -
               data[1];
    }
    /// A rough estimate of the cost of a letter with forty pieces for the eight points of a batch; see HasConstantCost
    /// for the unit.
    static constexpr unsigned search_half_instructions = 6000;
    /// The mean length of a piece.
    static float spacing(const float* data);
    static bool specialise(const float* data, const PointRange& range, std::span<const float> of,
                           std::vector<float>& floats);
};

}  // namespace phasetree
