#pragma once

#include <string>
#include <vector>

#include "phasetree/math/found_equation.hpp"
#include "phasetree/math/portable.hpp"
#include "phasetree/model/from_file.hpp"
#include "phasetree/nodes/fields/mesh_tree.hpp"
#include "phasetree/nodes/fields/profile.hpp"
#include "phasetree/nodes/fields/triangle_mesh.hpp"

namespace phasetree {

/// The solid within a triangulated surface, exact on both sides; or a wall along the surface.
///
/// A clean surface is used as it is: closed, all triangles facing outward, not crossing itself, and not touching itself
/// along edges. Any other is repaired first (lib/src/nodes/mesh_repair): the result is the boundary of the set of
/// points around which the surface winds. Triangles inside that solid, and parts that enclose nothing, are dropped.
/// Either way, the nearest piece of the surface determines the sign of the distance (mesh_pieces.hpp).
///
/// Where two sheets of the surface are closer than the rounding of floats, either may be taken as the nearest, and the
/// sign is uncertain even far from both.
///
/// A wall needs no solid: the surface is used with all its holes, crossings and loose parts. The distance is the
/// unsigned one to the surface, less half of the thickness: exact outside. Open edges and convex edges of the wall are
/// rounded, with a radius of half of the thickness.
///
/// A hierarchy of boxes finds the nearest piece. In a small box few pieces can be nearest; they are the data of the
/// specialised primitive.
struct Mesh {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"mesh", "",
                                   "± min over the triangles of |p − nearest point|; "
                                   "with a thickness, min … − thickness/2",
                                   "The solid inside a surface of triangles, exact; or a wall along the surface."};
    static constexpr std::size_t max_pieces_in_box = 64;

    FromFile<TriangleMesh> file{};
    std::string rule{"winding_number"};
    float thickness = 0;
    std::vector<float> table{};        ///< derived: a PieceTree
    std::vector<glm::vec3> corners{};  ///< derived: the vertices of the repaired surface; empty if the file is clean
    Bounds box{};                      ///< derived

    template <class V>
    static void parameters(V&& v) {
        v(&Mesh::file,
          Parameter{
              "file", "",
              "Mesh file: OBJ, PLY or STL. Coordinates are used as they are, as lengths in the scene's unit. Place "
              "the mesh by wrapping the node in `scale`, `rotate` and `translate`; a file whose y axis points up "
              "needs {\"rotate\": {\"axis\": [1, 0, 0], \"angle\": 90, \"of\": …}}. Materials, colours, normals and "
              "texture coordinates of the file are ignored: the phases define the materials. Triangles are "
              "counter-clockwise seen from outside. Vertices that differ only by rounding are merged. Holes are "
              "closed, parts that intersect are joined, and parts that are inside out are flipped. A surface that "
              "encloses nothing is rejected unless it has a `thickness`; so are parts that coincide within rounding. "
              "Walls and gaps thinner than a millionth "
              "of the mesh's size may "
              "be confused."});
        v(&Mesh::rule,
          ChoiceParameter{{.name = "rule",
                           .unit = "",
                           .description = "Which points are inside, by how often the surface winds around them: "
                                          "\"winding_number\": at least once, the union of all parts; \"even_odd\": an "
                                          "odd number of times, so a part within another is a cavity; \"non_zero\": "
                                          "at least once, in either direction. All three are the same for a "
                                          "closed mesh whose parts do not overlap.",
                           .optional = true},
                          rules});
        v(&Mesh::thickness,
          Parameter{
              "thickness", "m",
              "Thickness of a wall along the surface, half of it on either side. Use it for an open sheet, or for "
              "a closed surface that is to be hollow. The mesh is used as it is, without repairs, and `rule` is "
              "ignored. Open edges and convex edges of the wall are rounded, with a radius of half of the "
              "thickness. 0: the solid inside the surface.",
              limits::non_negative, true});
    }
    static std::vector<std::string_view> rules() { return {"winding_number", "even_odd", "non_zero"}; }
    /// Throws ModelError if a coordinate or an index is invalid, if there are too many triangles, if parts cannot be
    /// separated, or if the surface encloses nothing and there is no thickness. Large meshes take seconds; see
    /// PreparationWatch.
    void prepare();

    std::size_t derived_bytes() const { return std::span(table).size_bytes() + std::span(corners).size_bytes(); }
    std::span<const float> data() const { return table; }
    template <class T>
    static T distance(const float* data, const Vec3<T>& p) {
        return found_equation(
            p, [&](const Vec3<float>& q) { return mesh::PieceTree::nearest(data, q); },
            [&](const mesh::FoundPiece& found, const auto& q) {
                return mesh::distance_to(found, data + mesh::piece_kinds, q);
            },
            [&](const auto& q) { return mesh::PieceList::distance(few_pieces(data), q); });
    }

    /// The data, if a loop over all pieces is acceptable; otherwise throws ModelError.
    static const float* few_pieces(const float* data);
    static constexpr std::size_t max_pieces_in_shader = 2000;

    /// The same primitive with only the data that matter in a small box: what LocalPrimitive (model/concepts.hpp) is
    /// for primitives without data.
    struct Specialised {
        std::vector<float> values{};

        std::span<const float> data() const { return values; }
        static std::size_t floats(const float* data) { return mesh::PieceList::floats(data); }
        static unsigned half_instructions(const float* data) {
            const auto count = [&](mesh::PieceKind k) {
                return static_cast<unsigned>(mesh::PieceList::count(data, k));
            };
            return 8 + 10 * count(mesh::PieceKind::face) + 11 * count(mesh::PieceKind::edge) +
                   5 * count(mesh::PieceKind::vertex);
        }
        template <class T>
        static T distance(const float* data, const Vec3<T>& p) {
            return mesh::PieceList::distance(data, p);
        }
        static bool is_sound(std::span<const float>);
    };
    using Parts = TypeList<Specialised>;
    /// The approximate distance between the centres of neighbouring triangles, assuming that their total area is about
    /// that of a sphere that fits in the mesh's box.
    static float spacing(const float* data) {
        const float* box = data + mesh::piece_kinds;
        const auto triangles = static_cast<float>(mesh::PieceList::count(data, mesh::PieceKind::face));
        return 2 * portable::hypot(box[3], box[4], box[5]) / std::sqrt(triangles);
    }
    /// A rough estimate of the cost of searching for the eight points of a batch; see HasConstantCost for the unit.
    static constexpr unsigned search_half_instructions = 3000;
    static bool specialise(const float* data, const PointRange& range, std::span<const float> of,
                           std::vector<float>& floats) {
        return mesh::PieceTree::pieces_in(data, range, of, max_pieces_in_box, floats);
    }

    double support(const glm::dvec3& d, float level) const;
    Bounds bounds(BoundsQuery&, float level) const {
        const Bounds b = box.inflated(level);
        return b.empty() ? Bounds{} : b;
    }
};

}  // namespace phasetree
