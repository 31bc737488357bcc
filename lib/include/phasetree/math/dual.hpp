#pragma once

#include "phasetree/math/vec3.hpp"

namespace phasetree {

/// A number with its gradient in space: forward-mode differentiation. Comparisons look at the value alone, so the
/// gradient is that of the branch which the value takes.
struct Dual {
    float value = 0;
    float dx = 0, dy = 0, dz = 0;

    Dual() = default;
    explicit Dual(float v) : value(v) {}
    Dual(float v, float x, float y, float z) : value(v), dx(x), dy(y), dz(z) {}
};

inline Dual operator-(const Dual& a) {
    return {-a.value, -a.dx, -a.dy, -a.dz};
}
inline Dual operator+(const Dual& a, const Dual& b) {
    return {a.value + b.value, a.dx + b.dx, a.dy + b.dy, a.dz + b.dz};
}
inline Dual operator-(const Dual& a, const Dual& b) {
    return {a.value - b.value, a.dx - b.dx, a.dy - b.dy, a.dz - b.dz};
}
inline Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.dx * b.value + a.value * b.dx, a.dy * b.value + a.value * b.dy,
            a.dz * b.value + a.value * b.dz};
}
inline Dual operator/(const Dual& a, const Dual& b) {
    const float v = a.value / b.value;
    return {v, (a.dx - v * b.dx) / b.value, (a.dy - v * b.dy) / b.value, (a.dz - v * b.dz) / b.value};
}
inline Dual operator+(const Dual& a, float b) {
    return {a.value + b, a.dx, a.dy, a.dz};
}
inline Dual operator-(const Dual& a, float b) {
    return {a.value - b, a.dx, a.dy, a.dz};
}
inline Dual operator*(const Dual& a, float b) {
    return {a.value * b, a.dx * b, a.dy * b, a.dz * b};
}
inline Dual operator+(float a, const Dual& b) {
    return {a + b.value, b.dx, b.dy, b.dz};
}
inline Dual operator-(float a, const Dual& b) {
    return {a - b.value, -b.dx, -b.dy, -b.dz};
}
inline Dual operator*(float a, const Dual& b) {
    return {a * b.value, a * b.dx, a * b.dy, a * b.dz};
}

inline bool less(const Dual& a, const Dual& b) {
    return a.value < b.value;
}
inline Dual select(bool condition, const Dual& yes, const Dual& no) {
    return condition ? yes : no;
}
inline Dual min(const Dual& a, const Dual& b) {
    return a.value < b.value ? a : b;
}
inline Dual max(const Dual& a, const Dual& b) {
    return a.value > b.value ? a : b;
}
inline Dual abs(const Dual& a) {
    return std::signbit(a.value) ? -a : a;
}
inline Dual lookup(const float* table, const Dual& index) {
    return Dual(table[static_cast<int>(index.value)]);
}
inline Dual floor(const Dual& a) {
    return Dual(std::floor(a.value));
}
inline Dual sqrt(const Dual& a) {
    const float v = std::sqrt(a.value);
    const float k = v > 0 ? 0.5f / v : 0.f;  // at a cone's apex every direction is as good: none
    return {v, k * a.dx, k * a.dy, k * a.dz};
}

}  // namespace phasetree
