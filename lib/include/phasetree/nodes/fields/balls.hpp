#pragma once

#include "phasetree/math/found_equation.hpp"
#include "phasetree/model/from_file.hpp"
#include "phasetree/nodes/fields/ball_list.hpp"
#include "phasetree/nodes/fields/ball_tree.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

namespace detail {
inline constexpr Parameter file_of_balls{
    "file", "",
    "File of balls: PLY, whose element `vertex` has x, y, z and optionally radius and phase, or CSV with these names "
    "in its first line. Coordinates and radii are lengths in the scene's unit. Give either this or the centres.",
    limits::any, true};
/// The centres and radii of balls, given as lists or in a file. Throws ModelError.
std::vector<glm::vec4> given_balls(std::string_view node, const std::vector<glm::vec3>& centres,
                                   const std::vector<float>& radii, const FromFile<BallList>& file);
}  // namespace detail

/// The union of up to millions of balls, given as data. It is exact outside, and 1-Lipschitz with the right sign
/// inside.
///
/// A hierarchy of boxes finds the ball nearest to a point. In a small box few balls matter; they are the data of the
/// specialised primitive. Where only the sign of the distance is needed, these are the balls that meet the box.
struct Balls {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"balls", "", "min over i of |p − cᵢ| − rᵢ",
                                   "The union of up to sixteen million balls: grains, drops, atoms. Exact outside."};
    /// The maximum number of balls listed for a box.
    static constexpr std::size_t max_in_box = 96;
    /// The maximum number of balls in shaders, which have no search.
    static constexpr std::size_t max_in_shader = 2000;

    std::vector<glm::vec3> centres{};
    std::vector<float> radii{};
    FromFile<BallList> file{};
    std::vector<float> table{};  ///< derived: a balls::Tree
    Bounds box{};                ///< derived

    template <class V>
    static void parameters(V&& v) {
        v(&Balls::centres,
          Parameter{"centres", "m", "Centres of the balls, unless they are in a file.", limits::any, true});
        v(&Balls::radii,
          Parameter{"radii", "m", "Radii of the balls: one number for all, or one per centre. A file may have its own.",
                    limits::positive, true, true});
        v(&Balls::file, detail::file_of_balls);
    }
    /// Throws ModelError if parameters are missing or inconsistent.
    void prepare();

    std::span<const float> data() const { return table; }
    template <class T>
    static T distance(const float* data, const Vec3<T>& p) {
        return found_equation(
            p, [&](const Vec3<float>& q) { return balls::Tree::nearest(data, q); },
            [](const float* ball, const auto& q) { return balls::distance_to(ball, q); },
            [&](const auto& q) { return balls::ShortList::distance(few_balls(data), q); });
    }
    /// The data, if a loop over all balls is acceptable; otherwise throws ModelError.
    static const float* few_balls(const float* data);

    /// The same primitive with only the data that matter in a small box: what LocalPrimitive (model/concepts.hpp) is
    /// for primitives without data.
    struct Specialised {
        std::vector<float> values{};

        std::span<const float> data() const { return values; }
        /// Encloses the values in a box by those of a few balls.
        static std::optional<enclosure::Enclosure> enclosed(const float* data, const Vec3<enclosure::Enclosure>& q,
                                                            const std::array<double, 3>& half);
        static std::size_t floats(const float* data) { return balls::ShortList::floats(data); }
        static unsigned half_instructions(const float* data) {
            return 2 + 4 * static_cast<unsigned>(balls::ShortList::count(data));
        }
        template <class T>
        static T distance(const float* data, const Vec3<T>& p) {
            return balls::ShortList::distance(data, p);
        }
        static bool is_sound(std::span<const float>);
    };
    using Parts = TypeList<Specialised>;
    /// The approximate distance between the centres of neighbours, assuming that the balls fill their box.
    static float spacing(const float* data) { return balls::Tree::spacing(data); }
    /// A rough estimate of the cost of searching for the eight points of a batch; see HasConstantCost for the unit.
    static constexpr unsigned search_half_instructions = 3000;
    static bool specialise(const float* data, const PointRange& range, std::span<const float> of,
                           std::vector<float>& floats) {
        return specialise(data, range, std::numeric_limits<double>::infinity(), of, floats);
    }
    /// The same, where only values up to `farthest` are required: values above it may be wrong as long as they stay
    /// above it.
    static bool specialise(const float* data, const PointRange& range, double farthest, std::span<const float> of,
                           std::vector<float>& floats) {
        return balls::Tree::balls_in(data, {range, farthest, max_in_box}, of, floats);
    }

    double support(const glm::dvec3& d, float level) const { return balls::Tree::support(table.data(), d, level); }
    Bounds bounds(BoundsQuery&, float level) const {
        const Bounds b = box.inflated(level);
        return b.empty() ? Bounds{} : b;
    }
};

}  // namespace phasetree
