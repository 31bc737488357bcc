#pragma once

/// Where a warp's inverse leads.

#include "support/set_algebra/textures.hpp"

namespace phasetree::tests::oracle {

inline dvec3 back(const Translate& w, const dvec3& p) {
    return p - dvec3(w.by);
}
/// Rodrigues' formula for the opposite angle.
inline dvec3 back(const Rotate& w, const dvec3& p) {
    const dvec3 k = glm::normalize(dvec3(w.axis));
    const double a = -glm::radians(static_cast<double>(w.angle));
    return p * std::cos(a) + glm::cross(k, p) * std::sin(a) + k * (glm::dot(k, p) * (1 - std::cos(a)));
}
inline dvec3 back(const Scale& w, const dvec3& p) {
    return p / static_cast<double>(w.factor);
}
/// Cramer's rule.
inline dvec3 back(const Affine& w, const dvec3& p) {
    const dvec3 x(w.x), y(w.y), z(w.z), q = p - dvec3(w.by);
    const double volume = glm::dot(x, glm::cross(y, z));
    return dvec3(glm::dot(q, glm::cross(y, z)), glm::dot(q, glm::cross(z, x)), glm::dot(q, glm::cross(x, y))) / volume;
}
inline dvec3 back(const Distort& w, const dvec3& p) {
    dvec3 q = p;
    for (int i = 0; i < 3; ++i) {
        const dvec3 shift = dvec3(1, 0.37, -0.73) * (57.3 * i * w.scale);
        q[i] += w.amplitude * fractal_noise((p + shift) / static_cast<double>(w.scale), static_cast<int>(w.octaves));
    }
    return q;
}
inline dvec3 back(const Twist& w, const dvec3& p) {
    const double a = -glm::radians(static_cast<double>(w.rate)) * p.z;
    return {p.x * std::cos(a) - p.y * std::sin(a), p.x * std::sin(a) + p.y * std::cos(a), p.z};
}
inline dvec3 back(const Stretch& w, const dvec3& p) {
    return p / dvec3(w.factors);
}
inline dvec3 back(const Mirror& w, const dvec3& p) {
    const dvec3 n = glm::normalize(dvec3(w.normal));
    return glm::dot(p, n) < 0 ? glm::reflect(p, n) : p;
}
/// Beyond the apex is nowhere.
inline dvec3 back(const Taper& w, const dvec3& p) {
    const double s = 1 + static_cast<double>(w.rate) * p.z;
    return s > 0 ? dvec3(p.x / s, p.y / s, p.z) : dvec3(1e9);
}
/// About the centre of the arc, which is at height 1/k.
inline dvec3 back(const Bend& w, const dvec3& p) {
    const double k = glm::radians(static_cast<double>(w.rate));
    if (std::abs(k) < 1e-12) return p;
    const double centre = 1 / k, sign = k > 0 ? 1 : -1;
    const double r = std::hypot(p.x, centre - p.z), angle = std::atan2(p.x, sign * (centre - p.z));
    return {angle / std::abs(k), p.y, sign * (std::abs(centre) - r)};
}

// Where a local warp's bounds reach beyond what it warps, the map is the node's choice.

inline dvec3 extended(const Taper& w, const dvec3& p) {
    const dvec3 q = back(w, p);
    return {std::clamp<double>(q.x, w.inverse.low_x, w.inverse.high_x),
            std::clamp<double>(q.y, w.inverse.low_y, w.inverse.high_y), q.z};
}
inline dvec3 extended(const Bend& w, const dvec3& p) {
    dvec3 q = back(w, p);
    if (w.inverse.k == 0) return q;
    const double sign = w.inverse.side, near = w.inverse.near, r = 1 - w.inverse.k * sign * q.z;
    if (r < near) return {q.x * r / near, q.y, sign * w.inverse.highest};
    return q;
}

}  // namespace phasetree::tests::oracle
