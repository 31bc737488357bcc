#include "support/analytic_roots.hpp"

#include <algorithm>
#include <stdexcept>

#include "support/set_algebra.hpp"
#include "support/set_algebra/transforms.hpp"
#include "tree/node.hpp"

namespace phasetree::tests::analytic {

namespace {

struct Root {
    double t;
    dvec3 normal;  ///< of the surface, in world space, either way
};

// A ray in a node's space, and the rotation of directions back to world space.
struct Ray {
    dvec3 o, d;
    dvec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< the node's axes in world space

    dvec3 at(double t) const { return o + t * d; }
    dvec3 world(const dvec3& n) const { return glm::normalize(n.x * axes[0] + n.y * axes[1] + n.z * axes[2]); }
};

using Roots = std::vector<Root>;

void plane_roots(const Ray& r, const dvec3& n, double offset, Roots& out) {
    const double slope = glm::dot(r.d, n);
    if (slope != 0) out.push_back({(offset - glm::dot(r.o, n)) / slope, r.world(n)});
}
void sphere_roots(const Ray& r, double radius, Roots& out) {
    solve(glm::dot(r.d, r.d), glm::dot(r.o, r.d), glm::dot(r.o, r.o) - radius * radius, [&](double t) {
        out.push_back({t, r.world(r.at(t))});
    });
}
// ρ = a + b z: a cylinder or a cone about the z axis.
void cone_roots(const Ray& r, double a, double b, Roots& out) {
    const double k = a + b * r.o.z, l = b * r.d.z;
    solve(r.d.x * r.d.x + r.d.y * r.d.y - l * l, r.o.x * r.d.x + r.o.y * r.d.y - k * l,
          r.o.x * r.o.x + r.o.y * r.o.y - k * k, [&](double t) {
              const dvec3 p = r.at(t);
              out.push_back({t, r.world({p.x, p.y, -b * (a + b * p.z)})});
          });
}

void roots(const Field&, const Ray&, Roots&);
void roots(const Phased&, const Ray&, Roots&);

Ray through(const Translate& w, Ray r) {
    r.o = oracle::back(w, r.o);
    return r;
}
Ray through(const Rotate& w, Ray r) {
    const Rotate forth{.axis = w.axis, .angle = -w.angle};
    Ray q{oracle::back(w, r.o), oracle::back(w, r.d)};
    for (int i = 0; i < 3; ++i) {
        dvec3 e(0);
        e[i] = 1;
        const dvec3 turned = oracle::back(forth, e);
        q.axes[i] = turned.x * r.axes[0] + turned.y * r.axes[1] + turned.z * r.axes[2];
    }
    return q;
}
Ray through(const Scale& w, Ray r) {
    r.o /= static_cast<double>(w.factor);
    r.d /= static_cast<double>(w.factor);  // t stays
    return r;
}

// The node's own surfaces. For a node with children, those of the children. Other nodes do not occur in these scenes.
template <class Node>
void own_roots(const Node& n, const Ray& r, Roots& out) {
    if constexpr (std::is_same_v<Node, Sphere>) {
        sphere_roots(r, n.radius, out);
    } else if constexpr (std::is_same_v<Node, Plane>) {
        plane_roots(r, dvec3(n.normal), n.offset, out);
    } else if constexpr (std::is_same_v<Node, Box>) {
        for (int i = 0; i < 3; ++i) {
            dvec3 e(0);
            e[i] = 1;
            plane_roots(r, e, n.size[i] / 2.0, out);
            plane_roots(r, e, -n.size[i] / 2.0, out);
        }
    } else if constexpr (std::is_same_v<Node, Cylinder> || std::is_same_v<Node, CappedCone>) {
        double bottom, top;
        if constexpr (std::is_same_v<Node, Cylinder>)
            bottom = top = n.radius;
        else
            bottom = n.radius_bottom, top = n.radius_top;
        cone_roots(r, (bottom + top) / 2, (top - bottom) / n.height, out);
        plane_roots(r, {0, 0, 1}, n.height / 2.0, out);
        plane_roots(r, {0, 0, 1}, -n.height / 2.0, out);
    } else if constexpr (std::is_same_v<Node, ThinShell>) {
        const auto* ball = std::get_if<Sphere>(&n.of.node()->node);
        if (!ball) throw std::logic_error("the oracle knows thin shells of spheres only");
        sphere_roots(r, static_cast<double>(ball->radius) + n.half_thickness, out);
        sphere_roots(r, static_cast<double>(ball->radius) - n.half_thickness, out);
    } else if constexpr (requires { through(n.warp, r); }) {
        roots(n.of, through(n.warp, r), out);
    } else if constexpr (std::is_same_v<Node, Union> || std::is_same_v<Node, Intersection> ||
                         std::is_same_v<Node, Difference> || std::is_same_v<Node, Merge> || std::is_same_v<Node, Set> ||
                         std::is_same_v<Node, Under> || std::is_same_v<Node, Over> ||
                         std::is_same_v<Node, IntersectShape> || std::is_same_v<Node, SubtractShape> ||
                         std::is_same_v<Node, Change> || std::is_same_v<Node, Remove>) {
        for_each_child(n, [&](const auto& child) { roots(child, r, out); });
    } else {
        throw std::logic_error("the oracle has no roots for this node");
    }
}
void roots(const Field& f, const Ray& r, Roots& out) {
    std::visit([&](const auto& n) { own_roots(n, r, out); }, f.node()->node);
}
void roots(const Phased& a, const Ray& r, Roots& out) {
    std::visit([&](const auto& n) { own_roots(n, r, out); }, a.node()->node);
}

}  // namespace

std::vector<Piece> exact_pieces(const Phased& object, const dvec3& o, const dvec3& d, double length) {
    Roots all;
    roots(object, Ray{o, d}, all);
    std::erase_if(all, [&](const Root& r) { return !(r.t > 0 && r.t < length); });
    std::sort(all.begin(), all.end(), [](const Root& a, const Root& b) { return a.t < b.t; });
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i <= all.size(); ++i) {
        const double low = i == 0 ? 0 : all[i - 1].t, high = i == all.size() ? length : all[i].t;
        if (!(high > low)) continue;
        const Phase l = tests::label(object, o + 0.5 * (low + high) * d);
        if (pieces.empty() || pieces.back().phase != l)
            pieces.push_back({low, l, i == 0 ? dvec3(0) : all[i - 1].normal});
    }
    return pieces;
}

}  // namespace phasetree::tests::analytic
