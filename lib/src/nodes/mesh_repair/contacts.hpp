#pragma once

#include "nodes/mesh_repair/chain.hpp"

namespace phasetree::mesh {

/// A point at which an edge, from `a` to `b` > `a`, has to be divided.
struct EdgeContact {
    std::uint32_t a, b;
    glm::dvec3 at;
};
/// A point at which a triangle has to be divided.
struct FaceContact {
    std::uint32_t triangle;
    glm::dvec3 at;
};
/// A segment between two such points along which a triangle meets another one. Its parts should be edges, too.
struct SegmentContact {
    std::uint32_t triangle;
    glm::dvec3 from, to;
};
struct Contacts {
    std::vector<EdgeContact> edges;
    std::vector<FaceContact> faces;
    std::vector<SegmentContact> segments;

    std::size_t size() const { return edges.size() + faces.size() + segments.size(); }
};

/// Find where two triangles cross or touch outside the vertices and edges that they share: vertices close to an edge or
/// to the interior of the other triangle, edges that pass each other closely, and edges that pierce the interior. All
/// results are lattice points. Numerical errors are far less than `touching`.
void find_contacts(const Chain&, std::uint32_t one, std::uint32_t other, Contacts&);

/// Whether a triangle is so thin that a corner touches the opposite edge.
void find_own_contact(const Chain&, std::uint32_t triangle, Contacts&);

}  // namespace phasetree::mesh
