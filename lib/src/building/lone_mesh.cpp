#include "building/lone_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "kernel/faces.hpp"
#include "nodes/mesh_faces.hpp"
#include "phasetree/nodes/fields/mesh.hpp"
#include "program/dispatch.hpp"
#include "rewriting/affine_map_of.hpp"

namespace phasetree::building {

using kernel::most_faces;
using program::ProgramOutput;
using rewriting::affine_map_of;

namespace {

// A convex polygon: a triangle from which at most six planes have cut corners.
struct Polygon {
    std::array<glm::dvec3, 9> vertex;
    std::size_t count = 0;

    void add(const glm::dvec3& v) { vertex[count++] = v; }
};

// The part of a polygon where sign · coordinate ≤ sign · limit.
Polygon cut(const Polygon& whole, int axis, double sign, double limit) {
    Polygon rest;
    for (std::size_t i = 0; i < whole.count; ++i) {
        const glm::dvec3 &a = whole.vertex[i], &b = whole.vertex[(i + 1) % whole.count];
        const double below_a = sign * (limit - a[axis]), below_b = sign * (limit - b[axis]);
        if (below_a >= 0) rest.add(a);
        if ((below_a > 0 && below_b < 0) || (below_a < 0 && below_b > 0))
            rest.add(a + (below_a / (below_a - below_b)) * (b - a));
    }
    return rest;
}

// The box around the part of a triangle in a box; empty if they do not touch.
Bounds part_in_box(const FaceCorners& face, const Bounds& box) {
    Polygon part;
    for (const glm::vec3& v : face.corner) part.add(glm::dvec3(v));
    for (int axis = 0; axis < 3; ++axis) {
        part = cut(part, axis, 1, static_cast<double>(box.high[axis]));
        part = cut(part, axis, -1, static_cast<double>(box.low[axis]));
    }
    Bounds around;
    for (std::size_t i = 0; i < part.count; ++i) {
        const glm::vec3 p(part.vertex[i]);
        around = unite(around, {p, p});
    }
    return around;
}

// A box in the mesh's space around the image of a box in the object's space.
Bounds in_mesh_space(const AffineMap::Inverse& to_object, const Bounds& box) {
    const glm::dmat3 to_mesh = glm::inverse(to_object.matrix);
    Bounds image;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 p(to_mesh * (glm::dvec3(box.corner(i)) - to_object.by));
        image = unite(image, {p, p});
    }
    float largest = 0;
    for (int axis = 0; axis < 3; ++axis)
        largest = std::max({largest, std::abs(image.low[axis]), std::abs(image.high[axis])});
    return image.inflated(1e-6f * largest);
}

}  // namespace

std::optional<LoneMesh> lone_mesh(const WorkingProgram& program, std::span<const float> constants) {
    const std::span<const ProgramOutput> outputs = program.outputs;
    if (outputs.size() != 2 || outputs[0].value != outputs[1].value) return std::nullopt;
    bool is_first_outside = outputs[0].negate;  // the component of the outside is minus the distance
    std::uint32_t value = outputs[0].value;
    for (;; value = program.code[value].a) {
        const Instruction& in = program.code[value];
        if (in.op == program::op_of<Mesh>()) break;
        if (in.op == Op::negate) {
            is_first_outside = !is_first_outside;
        } else if (in.op == Op::multiply_constant && constants[in.data] != 0) {
            if (constants[in.data] < 0) is_first_outside = !is_first_outside;
        } else {
            return std::nullopt;
        }
    }
    const float* const data = &constants[program.code[value].data];
    // The faces of a wall are half its thickness away from the triangles.
    if (data[mesh::piece_kinds + mesh::half_thickness] > 0) return std::nullopt;
    LoneMesh mesh{data, {glm::dmat3(1), glm::dvec3(0)}, is_first_outside};
    for (std::uint32_t point = program.code[value].a; point != 0; point = program.code[point].a) {
        const Instruction& in = program.code[point];
        const auto map = affine_map_of(in.op, &constants[in.data]);
        if (!map) return std::nullopt;
        const AffineMap::Inverse back = map->inverse();
        mesh.to_object = {back.matrix * mesh.to_object.matrix, back.matrix * mesh.to_object.by + back.by};
    }
    if (!(std::abs(glm::determinant(mesh.to_object.matrix)) > 0)) return std::nullopt;
    return mesh;
}

std::optional<FacesInBox> faces_in_box(const LoneMesh& mesh, const Bounds& box, Arena& arena) {
    std::array<FaceCorners, most_faces> found;
    std::size_t count = 0;
    bool is_too_many = false;
    const AffineMap::Inverse& map = mesh.to_object;
    // A mirror reverses triangles.
    const bool is_reversed = mesh.is_first_phase_outside != (glm::determinant(map.matrix) > 0);
    Bounds around;
    mesh::for_each_face_near(mesh.tree, in_mesh_space(map, box), [&](const std::array<glm::vec3, 3>& corners) {
        FaceCorners face;
        for (std::size_t i = 0; i < 3; ++i) face.corner[i] = glm::vec3(map.matrix * glm::dvec3(corners[i]) + map.by);
        if (is_reversed) std::swap(face.corner[1], face.corner[2]);
        const Bounds part = part_in_box(face, box);
        if (part.empty()) return true;
        around = unite(around, part);
        is_too_many = count == most_faces;
        if (!is_too_many) found[count++] = face;
        return !is_too_many;
    });
    if (is_too_many) return std::nullopt;
    return FacesInBox{arena.copy(std::span<const FaceCorners>(found.data(), count)), around};
}

}  // namespace phasetree::building
