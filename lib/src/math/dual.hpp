#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "phasetree/math/arc_tangent.hpp"
#include "phasetree/math/vec3.hpp"

namespace phasetree {

/// A number with its spatial gradient: forward-mode differentiation. Comparisons consider only the value, so the
/// gradient is that of the branch that the value takes. The four floats are one register. Selections have no branches,
/// because a processor would mispredict them at every other hit.
///
/// Where two values are equal, their minimum has the gradient of the first, and their maximum that of the second. So
/// min(a, b) and max(a, b) are a sorted pair in their gradients, too, instead of the same number twice. Also, max(a, 0)
/// + min(a, 0) has the gradient of a, and smooth_min of equal values has the mean of both gradients.
class Dual {
  public:
    using Lanes [[gnu::vector_size(16)]] = float;
    using Bits [[gnu::vector_size(16)]] = int;

    Dual() = default;
    explicit Dual(float v) : lanes_{v, 0, 0, 0} {}
    Dual(float v, float x, float y, float z) : lanes_{v, x, y, z} {}
    explicit Dual(const Lanes& lanes) : lanes_(lanes) {}
    /// A number with this value and the derivatives of `slopes`.
    Dual(float v, const Lanes& slopes) : lanes_(slopes) { lanes_[0] = v; }

    float value() const { return lanes_[0]; }
    glm::vec3 gradient() const { return {lanes_[1], lanes_[2], lanes_[3]}; }
    const Lanes& lanes() const { return lanes_; }
    Lanes values() const { return each(lanes_[0]); }
    static Lanes each(float v) { return Lanes{v, v, v, v}; }

  private:
    Lanes lanes_{};  // the value, and its derivatives with respect to x, y and z
};

[[gnu::always_inline]] inline Dual operator-(const Dual& a) {
    return Dual(-a.lanes());
}
[[gnu::always_inline]] inline Dual operator+(const Dual& a, const Dual& b) {
    return Dual(a.lanes() + b.lanes());
}
[[gnu::always_inline]] inline Dual operator-(const Dual& a, const Dual& b) {
    return Dual(a.lanes() - b.lanes());
}
[[gnu::always_inline]] inline Dual operator*(const Dual& a, const Dual& b) {
    return Dual(a.value() * b.value(), a.lanes() * b.values() + a.values() * b.lanes());
}
[[gnu::always_inline]] inline Dual operator/(const Dual& a, const Dual& b) {
    const float v = a.value() / b.value();
    return Dual(v, (a.lanes() - Dual::each(v) * b.lanes()) / b.values());
}
[[gnu::always_inline]] inline Dual operator+(const Dual& a, float b) {
    return Dual(a.value() + b, a.lanes());
}
[[gnu::always_inline]] inline Dual operator-(const Dual& a, float b) {
    return Dual(a.value() - b, a.lanes());
}
[[gnu::always_inline]] inline Dual operator*(const Dual& a, float b) {
    return Dual(a.lanes() * Dual::each(b));
}
[[gnu::always_inline]] inline Dual operator+(float a, const Dual& b) {
    return b + a;
}
[[gnu::always_inline]] inline Dual operator-(float a, const Dual& b) {
    return Dual(a - b.value(), -b.lanes());
}
[[gnu::always_inline]] inline Dual operator*(float a, const Dual& b) {
    return b * a;
}

[[gnu::always_inline]] inline bool less(const Dual& a, const Dual& b) {
    return a.value() < b.value();
}
[[gnu::always_inline]] inline Dual select(bool condition, const Dual& yes, const Dual& no) {
    const Dual::Bits all = Dual::Bits{} - static_cast<int>(condition);
    return Dual(all ? yes.lanes() : no.lanes());
}
[[gnu::always_inline]] inline Dual min(const Dual& a, const Dual& b) {
    // The value must equal that of min() for floats, even for two zeros of different signs.
    return Dual(min(a.value(), b.value()), a.values() <= b.values() ? a.lanes() : b.lanes());
}
[[gnu::always_inline]] inline Dual max(const Dual& a, const Dual& b) {
    return Dual(a.values() > b.values() ? a.lanes() : b.lanes());
}
[[gnu::always_inline]] inline Dual abs(const Dual& a) {
    return select(std::signbit(a.value()), -a, a);
}
[[gnu::always_inline]] inline Dual lookup(const float* table, const Dual& index) {
    return Dual(table[static_cast<int>(index.value())]);
}
[[gnu::always_inline]] inline Dual floor(const Dual& a) {
    return Dual(std::floor(a.value()));
}
[[gnu::always_inline]] inline float whole_part(const Dual& a) {
    return std::floor(a.value());
}
[[gnu::always_inline]] inline Dual sqrt(const Dual& a) {
    const float v = std::sqrt(a.value());
    const float k = v > 0 ? 0.5f / v : 0.f;  // at a cone's apex there is no preferred direction; use none
    return Dual(v, Dual::each(k) * a.lanes());
}
/// The derivatives are those of the equation that was found.
template <class Search, class Equation, class Otherwise>
Dual found_equation(const Vec3<Dual>& p, const Search& search, const Equation& equation, const Otherwise&) {
    return equation(search(Vec3<float>{p.x.value(), p.y.value(), p.z.value()}), p);
}
template <class Search, class Equation, class Otherwise>
Dual equation_for_derivatives(const Vec3<Dual>& p, const Search& search, const Equation& equation, const Otherwise&) {
    return equation(search(Vec3<float>{p.x.value(), p.y.value(), p.z.value()}), p);
}
template <std::size_t count, class Search, class Equation, class Otherwise>
Dual gathered_equation(const Vec3<Dual>& p, const Search& search, const Equation& equation, const Otherwise&) {
    std::array<float, count> numbers;
    search(Vec3<float>{p.x.value(), p.y.value(), p.z.value()}, numbers.data(), std::size_t{1});
    return equation(numbers, p);
}
/// The derivative is (x dy − y dx)/(x² + y²), and zero at the origin. Differentiating the equation itself, which uses
/// the ratio of the smaller to the larger coordinate, would be wrong where both are equal.
[[gnu::always_inline]] inline Dual angle_of(const Dual& x, const Dual& y) {
    const float a = x.value(), b = y.value(), squared = a * a + b * b;
    const float k = squared > 0 ? 1.f / squared : 0.f;
    return Dual(angle_of(a, b), (Dual::each(a) * y.lanes() - Dual::each(b) * x.lanes()) * Dual::each(k));
}

}  // namespace phasetree
