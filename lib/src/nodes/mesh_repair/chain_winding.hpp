#pragma once

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <optional>

#include "nodes/box_tree.hpp"
#include "nodes/mesh_repair/chain.hpp"
#include "phasetree/math/portable.hpp"

namespace phasetree::mesh {

/// How often a closed chain winds around points, by the crossings of rays.
class ChainWinding {
  public:
    /// The chain must outlive this, and keep its triangles.
    explicit ChainWinding(const Chain& chain) : chain_(chain), tree_(boxes(chain), 4) {}

    /// The winding number around p of the triangles that satisfy counts(triangle), which must form a closed chain.
    /// Exact, unless p is within rounding of a triangle.
    template <class Counts>
    std::int64_t around(const glm::dvec3& p, const Counts& counts) const {
        for (int attempt = 0; attempt < attempts; ++attempt)
            if (const auto found = along_ray(p, direction(attempt), counts)) return *found;
        return std::llround(by_solid_angles(p, counts));
    }
    /// The winding number of the whole chain, which must be closed, just in front of the middle of a triangle.
    std::int64_t in_front_of(std::uint32_t triangle) const {
        const glm::dvec3 p = chain_.middle(triangle), n = chain_.normal(triangle);
        const auto counts = [&](std::uint32_t t) { return t != triangle; };
        for (int attempt = 0; attempt < attempts; ++attempt) {
            const glm::dvec3 d = direction(attempt);
            if (const auto found = along_ray(p, glm::dot(d, n) < 0 ? -d : d, counts)) return *found;
        }
        // A point on a triangle sees none of its solid angle. So the sum lies halfway between the winding numbers in
        // front and behind, which differ by `times`.
        return std::llround(by_solid_angles(p, counts) - 0.5 * chain_.triangles[triangle].times);
    }

  private:
    static constexpr int attempts = 16;
    // Any directions will do, as long as no mesh is likely to be aligned with them.
    static glm::dvec3 direction(int attempt) {
        const double turn = 2.39996 * attempt + 0.3;
        return {std::cos(turn), std::sin(turn), 0.137 + 0.051 * attempt};
    }
    static std::vector<Bounds> boxes(const Chain& chain) {
        std::vector<Bounds> boxes(chain.triangles.size());
        for (std::size_t t = 0; t < boxes.size(); ++t) boxes[t] = chain.box(t);
        return boxes;
    }
    // Returns nullopt if the ray comes too close to an edge for a reliable result.
    template <class Counts>
    std::optional<std::int64_t> along_ray(const glm::dvec3& p, const glm::dvec3& d, const Counts& counts) const {
        std::int64_t winding = 0;
        bool is_in_doubt = false;
        const auto is_met = [&](const Bounds& box) {
            double enter = 0, leave = std::numeric_limits<double>::infinity();
            for (int i = 0; i < 3; ++i) {
                const double low = (static_cast<double>(box.low[i]) - 1 - p[i]) / d[i];
                const double high = (static_cast<double>(box.high[i]) + 1 - p[i]) / d[i];
                enter = std::max(enter, std::min(low, high));
                leave = std::min(leave, std::max(low, high));
            }
            return !is_in_doubt && enter <= leave;
        };
        tree_.for_each_leaf(is_met, [&](std::uint32_t first, std::uint32_t count) {
            for (std::uint32_t i = first; i < first + count; ++i) {
                const std::uint32_t t = tree_.order[i];
                if (!counts(t)) continue;
                const auto crossing = crossing_of(t, p, d);
                if (!crossing) is_in_doubt = true;
                winding += crossing.value_or(0) * chain_.triangles[t].times;
            }
        });
        if (is_in_doubt) return std::nullopt;
        return winding;
    }
    // 1 if the ray leaves through the triangle, −1 if it enters, 0 if it misses the triangle; nullopt if that is in
    // doubt.
    std::optional<int> crossing_of(std::uint32_t t, const glm::dvec3& p, const glm::dvec3& d) const {
        std::array<glm::dvec3, 3> q;
        for (std::size_t k = 0; k < 3; ++k) q[k] = chain_.corner(t, k) - p;
        std::array<double, 3> turn;
        double size = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 &a = q[k], &b = q[(k + 1) % 3];
            turn[k] = glm::dot(d, glm::cross(a, b));
            size = std::max(size, glm::length(a) * glm::length(b));
        }
        const auto [least, most] = std::minmax({turn[0], turn[1], turn[2]});
        const double rounding_error = 1e-12 * size;
        if (least < -rounding_error && most > rounding_error) return 0;
        const glm::dvec3 n = chain_.normal(t);
        const double height = glm::dot(n, q[0]), along = glm::dot(n, d);
        if (along != 0 && height / along < 0) return 0;
        if (least < rounding_error && most > -rounding_error) return std::nullopt;
        return most > 0 ? 1 : -1;
    }
    template <class Counts>
    double by_solid_angles(const glm::dvec3& p, const Counts& counts) const {
        double sum = 0;
        for (std::uint32_t t = 0; t < chain_.triangles.size(); ++t) {
            if (!counts(t)) continue;
            const glm::dvec3 a = chain_.corner(t, 0) - p, b = chain_.corner(t, 1) - p, c = chain_.corner(t, 2) - p;
            const double u = glm::length(a), v = glm::length(b), w = glm::length(c);
            sum += chain_.triangles[t].times *
                   portable::atan2(glm::dot(a, glm::cross(b, c)),
                                   u * v * w + glm::dot(a, b) * w + glm::dot(b, c) * u + glm::dot(c, a) * v);
        }
        return sum / (2 * std::numbers::pi);
    }

    const Chain& chain_;
    BoxTree tree_;
};

}  // namespace phasetree::mesh
