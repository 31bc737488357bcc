#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "phasetree/math/arc_tangent.hpp"
#include "phasetree/math/elementary.hpp"
#include "phasetree/math/portable.hpp"
#include "phasetree/math/vec3.hpp"

namespace phasetree {

/// A number in double precision with its spatial gradient (n = 3), or alone (n = 0). The equations of nodes run with it
/// as they run with floats; their constants remain floats. Comparisons consider only the value. Where two values are
/// equal, gradients are chosen as those of Dual are.
///
/// Functions that are polynomials for floats, such as the sine, are those of the standard library here. They have no
/// jumps where a polynomial's range is reduced, and their error is that of a double.
template <std::size_t n>
class Precise {
  public:
    using Slopes = std::array<double, n>;

    Precise() = default;
    explicit Precise(float v) : value_(static_cast<double>(v)) {}
    explicit Precise(double v) : value_(v) {}
    Precise(double v, const Slopes& slopes) : value_(v), slopes_(slopes) {}
    /// A coordinate of the point of evaluation.
    static Precise coordinate([[maybe_unused]] std::size_t axis, double v) {
        Precise p(v);
        if constexpr (n > 0) p.slopes_[axis] = 1;
        return p;
    }

    double value() const { return value_; }
    const Slopes& slopes() const { return slopes_; }
    /// Slopes computed one by one: f(i).
    template <class F>
    static Slopes each(F&& f) {
        if constexpr (n == 0)
            return {};
        else
            return {f(std::size_t{0}), f(std::size_t{1}), f(std::size_t{2})};
    }
    /// A function g of this number, from its value and its derivative here.
    Precise composed(double g, double derivative) const {
        return {g, each([&](std::size_t i) { return slopes_[i] * derivative; })};
    }

  private:
    double value_ = 0;
    Slopes slopes_{};
};

template <std::size_t n>
Precise<n> operator-(const Precise<n>& a) {
    return a.composed(-a.value(), -1);
}
template <std::size_t n>
Precise<n> operator+(const Precise<n>& a, const Precise<n>& b) {
    return {a.value() + b.value(), Precise<n>::each([&](std::size_t i) { return a.slopes()[i] + b.slopes()[i]; })};
}
template <std::size_t n>
Precise<n> operator-(const Precise<n>& a, const Precise<n>& b) {
    return {a.value() - b.value(), Precise<n>::each([&](std::size_t i) { return a.slopes()[i] - b.slopes()[i]; })};
}
template <std::size_t n>
Precise<n> operator*(const Precise<n>& a, const Precise<n>& b) {
    return {a.value() * b.value(),
            Precise<n>::each([&](std::size_t i) { return a.slopes()[i] * b.value() + a.value() * b.slopes()[i]; })};
}
template <std::size_t n>
Precise<n> operator/(const Precise<n>& a, const Precise<n>& b) {
    const double v = a.value() / b.value();
    return {v, Precise<n>::each([&](std::size_t i) { return (a.slopes()[i] - v * b.slopes()[i]) / b.value(); })};
}
template <std::size_t n>
Precise<n> operator+(const Precise<n>& a, float b) {
    return {a.value() + static_cast<double>(b), a.slopes()};
}
template <std::size_t n>
Precise<n> operator-(const Precise<n>& a, float b) {
    return {a.value() - static_cast<double>(b), a.slopes()};
}
template <std::size_t n>
Precise<n> operator*(const Precise<n>& a, float b) {
    return a.composed(a.value() * static_cast<double>(b), static_cast<double>(b));
}
template <std::size_t n>
Precise<n> operator+(float a, const Precise<n>& b) {
    return b + a;
}
template <std::size_t n>
Precise<n> operator-(float a, const Precise<n>& b) {
    return b.composed(static_cast<double>(a) - b.value(), -1);
}
template <std::size_t n>
Precise<n> operator*(float a, const Precise<n>& b) {
    return b * a;
}

template <std::size_t n>
bool less(const Precise<n>& a, const Precise<n>& b) {
    return a.value() < b.value();
}
template <std::size_t n>
Precise<n> select(bool condition, const Precise<n>& yes, const Precise<n>& no) {
    return condition ? yes : no;
}
template <std::size_t n>
Precise<n> min(const Precise<n>& a, const Precise<n>& b) {
    return {a.value() < b.value() ? a.value() : b.value(), a.value() <= b.value() ? a.slopes() : b.slopes()};
}
template <std::size_t n>
Precise<n> max(const Precise<n>& a, const Precise<n>& b) {
    return a.value() > b.value() ? a : b;
}
template <std::size_t n>
Precise<n> abs(const Precise<n>& a) {
    return std::signbit(a.value()) ? -a : a;
}
template <std::size_t n>
Precise<n> floor(const Precise<n>& a) {
    return Precise<n>(std::floor(a.value()));
}
template <std::size_t n>
Precise<n> sqrt(const Precise<n>& a) {
    const double v = std::sqrt(a.value());
    return a.composed(v, v > 0 ? 0.5 / v : 0);  // at a cone's apex there is no preferred direction; use none
}
template <std::size_t n>
Precise<n> lookup(const float* table, const Precise<n>& index) {
    return Precise<n>(table[static_cast<int>(index.value())]);
}
template <std::size_t n>
SineCosine<Precise<n>> sine_cosine(const Precise<n>& x) {
    const double s = std::sin(x.value()), c = std::cos(x.value());
    return {x.composed(s, c), x.composed(c, -s)};
}
template <std::size_t n>
Precise<n> sine(const Precise<n>& x) {
    return x.composed(std::sin(x.value()), n > 0 ? std::cos(x.value()) : 0.0);
}
template <std::size_t n>
Precise<n> exponential(const Precise<n>& x) {
    const Precise<n> a = clamp(x, Precise<n>(-80.f), Precise<n>(80.f));
    const double e = std::exp(a.value());
    return a.composed(e, e);
}
/// Zero for the zero vector; a y of −0 counts as 0.
template <std::size_t n>
Precise<n> angle_of(const Precise<n>& x, const Precise<n>& y) {
    const double a = x.value(), b = y.value(), squared = a * a + b * b;
    const double k = squared > 0 ? 1 / squared : 0;
    return {squared > 0 ? portable::atan2(b + 0.0, a) : 0.0,
            Precise<n>::each([&](std::size_t i) { return (a * y.slopes()[i] - b * x.slopes()[i]) * k; })};
}

/// The number of searches for data that this thread has made with a point rounded to floats (found_equation.hpp).
/// Results of such a search are as exact as floats are.
inline std::size_t& searches_in_floats() {
    thread_local std::size_t count = 0;
    return count;
}
template <std::size_t n>
Vec3<float> rounded_to_search(const Vec3<Precise<n>>& p) {
    ++searches_in_floats();
    const auto rounded = [](double v) { return static_cast<float>(std::clamp(v, -1e30, 1e30)); };
    return {rounded(p.x.value()), rounded(p.y.value()), rounded(p.z.value())};
}
template <std::size_t n, class Search, class Equation, class Otherwise>
Precise<n> found_equation(const Vec3<Precise<n>>& p, const Search& search, const Equation& equation, const Otherwise&) {
    return equation(search(rounded_to_search(p)), p);
}
template <std::size_t count, class Search, class Equation, class Otherwise, std::size_t n>
Precise<n> gathered_equation(const Vec3<Precise<n>>& p, const Search& search, const Equation& equation,
                             const Otherwise&) {
    std::array<float, count> numbers;
    search(rounded_to_search(p), numbers.data(), std::size_t{1});
    return equation(numbers, p);
}

}  // namespace phasetree
