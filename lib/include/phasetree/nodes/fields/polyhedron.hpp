#pragma once

#include <vector>

#include "phasetree/math/convex_polyhedron.hpp"
#include "phasetree/math/support.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree {

/// The intersection of half-spaces, as one instruction. Sphere Carving produces such solids
/// (phasetree/carving/carve.hpp), for example as the volume of a bounding_volume. Exact inside; outside, a lower bound
/// beyond edges.
struct Polyhedron {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{"polyhedron", "", "max over i of nᵢ·p − hᵢ",
                                   "A convex polyhedron: the intersection of half-spaces."};
    static constexpr std::size_t max_planes = 256;
    std::vector<glm::vec3> normals{};
    std::vector<float> offsets{};
    std::vector<float> table{};  ///< derived: the number of planes, and for each a unit normal n and h

    template <class V>
    static void parameters(V&& v) {
        v(&Polyhedron::normals, Parameter{"normals", "", "Outward normals of the planes, of any length but 0."});
        v(&Polyhedron::offsets,
          Parameter{"offsets", "m",
                    "Distance h of each plane from the origin along its normal; one number for all, or one per plane.",
                    limits::any, false, true});
    }
    void prepare() {
        if (normals.size() > max_planes) throw ModelError("polyhedron: more than 256 planes");
        if (offsets.size() != 1 && offsets.size() != normals.size())
            throw ModelError("polyhedron: \"offsets\" needs one entry per normal, or one for all");
        table = {static_cast<float>(normals.size())};
        for (std::size_t i = 0; i < normals.size(); ++i) {
            const double length = glm::length(glm::dvec3(normals[i]));
            if (!(length > 0)) throw ModelError("polyhedron: a normal is zero");
            const float offset = offsets[offsets.size() == 1 ? 0 : i];
            if (!(std::abs(offset) < 1e9f)) throw ModelError("polyhedron: a plane is too far from the origin");
            // Rounded down in length, so that the field is 1-Lipschitz.
            const glm::vec3 n(glm::dvec3(normals[i]) * ((1 - 1e-7) / length));
            table.insert(table.end(), {n.x, n.y, n.z, offset});
        }
    }
    static constexpr unsigned half_instructions = 120;
    static constexpr EnclosedBy enclosed_by = EnclosedBy::value_at_centre;
    std::span<const float> data() const { return table; }
    template <class T>
    static T distance(const float* data, const Vec3<T>& p) {
        const int count = static_cast<int>(*data++);
        T farthest = dot(p, glm::vec3(data[0], data[1], data[2])) - data[3];
        for (int i = 1; i < count; ++i) {
            data += 4;
            farthest = max(farthest, dot(p, glm::vec3(data[0], data[1], data[2])) - data[3]);
        }
        return farthest;
    }
    /// The planes are moved outward by the level, and their intersection is cut to a cube much larger than their
    /// distance from the origin. The farthest point in a direction is then either a corner of the solid, or a corner
    /// on the cube; in the latter case the solid is unbounded there.
    Bounds bounds(BoundsQuery& q, float level) const {
        float far = 1e-6f;
        std::vector<HalfSpace> planes;
        for (std::size_t i = 0; i < normals.size(); ++i) {
            const float* plane = table.data() + 1 + 4 * i;
            const glm::dvec3 n(plane[0], plane[1], plane[2]);
            const double length = glm::length(n);
            planes.push_back({n / length, (static_cast<double>(plane[3]) + static_cast<double>(level)) / length});
            far = std::max(far, std::abs(plane[3]) + std::abs(level));
        }
        const auto cube = 1e3 * static_cast<double>(far), margin = 1e-6 * static_cast<double>(far);
        const ConvexPolyhedron solid(Bounds::centred(glm::vec3(static_cast<float>(cube))), planes);
        if (solid.empty()) return {};
        std::vector<glm::dvec3> corners, on_cube;
        for (const glm::dvec3& p : solid.mesh().corners)
            (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > 0.999 * cube ? on_cube : corners).push_back(p);
        const auto support = [&](const glm::dvec3& d) {
            const double reach = detail::hull_support(d, corners) + glm::length(d) * margin;
            return detail::hull_support(d, on_cube) > reach ? std::numeric_limits<double>::infinity() : reach;
        };
        Bounds box;
        for (int i = 0; i < 3; ++i) {
            glm::dvec3 d(0);
            d[i] = 1;
            box.high[i] = static_cast<float>(support(d));
            box.low[i] = static_cast<float>(-support(-d));
        }
        return q.placed(box.inflated(2e-7f * far), support);
    }
};

}  // namespace phasetree
