#pragma once

/// Copies: a point is in a copy if the copy's inverse transform maps it into the child.

#include "support/set_algebra/components.hpp"

namespace phasetree::tests::oracle {

struct Copy {
    dvec3 by;
    double turn, scale;  ///< turn in degrees
    std::optional<glm::dmat3> frame{};

    dvec3 back(const dvec3& p) const {
        if (frame) return glm::transpose(*frame) * (p - by) / scale;
        const double a = -glm::radians(turn);
        const dvec3 q = p - by;
        return dvec3(q.x * std::cos(a) - q.y * std::sin(a), q.x * std::sin(a) + q.y * std::cos(a), q.z) / scale;
    }
};
template <class Child>
std::vector<Copy> copies(const Instances<Child>& n) {
    std::vector<Copy> all;
    for (const glm::vec3& v : n.positions) {
        const std::size_t i = all.size();
        const double turn = n.turns.empty() ? 0 : n.turns[n.turns.size() == 1 ? 0 : i];
        const double scale = n.scales.empty() ? 1 : n.scales[n.scales.size() == 1 ? 0 : i];
        all.push_back({dvec3(v), turn, scale});
    }
    return all;
}
template <class Child>
std::vector<Copy> copies(const PolarArray<Child>& n) {
    std::vector<Copy> all;
    for (int i = 0; i < n.count; ++i) all.push_back({dvec3(0), static_cast<double>(n.angle) * i / n.count, 1});
    return all;
}
/// The last along z is the last of all, then along y.
template <class Child>
std::vector<Copy> copies(const Grid<Child>& n) {
    std::vector<Copy> all;
    for (int i = 0; i < n.count_x * n.count_y * n.count_z; ++i) {
        const dvec3 index(i % n.count_x, i / n.count_x % n.count_y, i / (n.count_x * n.count_y));
        all.push_back({index * dvec3(n.spacing), 0, 1});
    }
    return all;
}
inline dvec3 spiral(int i, double rho, double z) {
    const double a = i * 3.14159265358979323846 * (3 - std::sqrt(5.0));
    return {rho * std::cos(a), rho * std::sin(a), z};
}
template <class Child>
std::vector<Copy> copies(const FibonacciDisk<Child>& n) {
    std::vector<Copy> all;
    for (int i = 0; i < n.count; ++i) {
        const dvec3 by = spiral(i, n.radius * std::sqrt((2 * i + 1) / (2.0 * n.count)), 0);
        all.push_back({by, n.turned == 1 ? glm::degrees(std::atan2(by.y, by.x)) : 0, 1});
    }
    return all;
}
/// The axes across the normal are the node's choice.
template <class Child>
std::vector<Copy> copies(const FibonacciSphere<Child>& n) {
    std::vector<Copy> all;
    for (int i = 0; i < n.count; ++i) {
        const double z = 1 - (2.0 * i + 1) / n.count;
        const dvec3 normal = spiral(i, std::sqrt(1 - z * z), z);
        glm::dmat3 frame(*n.placement(static_cast<std::size_t>(i)).frame);
        frame[2] = normal;
        all.push_back({normal * static_cast<double>(n.radius), 0, 1, frame});
    }
    return all;
}
/// The positions of the copies have tests of their own (tests/lib/scatter.cpp).
template <class Child>
std::vector<Copy> copies(const Scatter<Child>& n) {
    std::vector<Copy> all;
    for (const Placement& at : n.found) all.push_back({dvec3(at.map.by), 0, at.scale, glm::dmat3(*at.frame)});
    return all;
}
template <class N>
concept IsCopies = requires(const N& n) {
    copies(n);
};

template <IsCopies N>
bool member(const N& n, const dvec3& p) {
    const auto all = copies(n);
    return std::any_of(all.begin(), all.end(), [&](const Copy& c) { return inside(n.of, c.back(p)); });
}
template <IsCopies N>
double signed_value(const N& n, const dvec3& p) {
    double result = absent;
    for (const Copy& c : copies(n)) result = std::min(result, value(n.of, c.back(p)) * c.scale);
    return result;
}
template <IsCopies N>
Phase region(const N& n, const dvec3& p) {
    Phase result = vacuum;
    for (const Copy& c : copies(n))
        if (const Phase l = label(n.of, c.back(p)); l != vacuum) result = l;
    return result;
}
template <IsCopies N>
Components components(const N& n, const dvec3& p) {
    std::optional<Components> result;
    for (const Copy& c : copies(n)) {
        Components a = values(n.of, c.back(p));
        for (double& v : a.phi) v *= c.scale;
        result = result ? replaced(*result, a) : a;
    }
    return *result;
}

}  // namespace phasetree::tests::oracle
