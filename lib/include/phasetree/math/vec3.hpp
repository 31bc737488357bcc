#pragma once

#include <glm/vec3.hpp>

#include "phasetree/math/number.hpp"

namespace phasetree {

/// A point or direction over any number type. The order of operations is fixed; number.hpp explains why.
template <class T>
struct Vec3 {
    T x, y, z;
};

template <class T>
Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
Vec3<T> operator+(const Vec3<T>& a, const glm::vec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
Vec3<T> operator-(const Vec3<T>& a, const glm::vec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
Vec3<T> operator*(const Vec3<T>& a, float k) {
    return {a.x * k, a.y * k, a.z * k};
}
template <class T>
T dot(const Vec3<T>& a, const Vec3<T>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
T dot(const Vec3<T>& a, const glm::vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
[[gnu::always_inline]] inline T length(const Vec3<T>& a) {
    return sqrt(dot(a, a));
}
/// The squared distance from q to the segment from the origin to `along`. `inverse` is 1/|along|², or 0 if the segment
/// is a point.
template <class T>
T squared_distance_to_segment(const Vec3<T>& q, const glm::vec3& along, float inverse) {
    const T s = clamp(dot(q, along) * inverse, T(0.f), T(1.f));
    const Vec3<T> away{q.x - s * along.x, q.y - s * along.y, q.z - s * along.z};
    return dot(away, away);
}
/// The length of the vector (x, y).
template <class T>
T length(const T& x, const T& y) {
    return sqrt(x * x + y * y);
}

}  // namespace phasetree
