// A number type that remembers which primitive a value comes from. Its values equal those of `float`, bit for bit.
#pragma once

#include <cmath>
#include <cstdint>

#include "phasetree/math/arc_tangent.hpp"
#include "phasetree/math/number.hpp"

namespace phasetree::tree {

/// A primitive, as counted by its owner. An equation's own numbers have none.
struct Source {
    static constexpr std::int32_t none = -1;
    std::int32_t index = none;
};

class Sourced {
  public:
    Sourced() = default;
    explicit Sourced(float value) : value_(value) {}
    Sourced(float value, Source source) : value_(value), source_(source) {}

    float value() const { return value_; }
    Source source() const { return source_; }
    bool has_source() const { return source_.index != Source::none; }

  private:
    float value_ = 0;
    Source source_{};
};

/// The source of a result computed from both: if both have one, the source of the larger number.
inline Source source_of_both(const Sourced& a, const Sourced& b) {
    if (!a.has_source()) return b.source();
    if (!b.has_source()) return a.source();
    return std::fabs(b.value()) > std::fabs(a.value()) ? b.source() : a.source();
}
/// The source of a selected number. If that is a constant, use the other's source, because the other led to the
/// selection.
inline Source source_of_chosen(const Sourced& chosen, const Sourced& other) {
    return chosen.has_source() ? chosen.source() : other.source();
}

inline Sourced operator-(const Sourced& a) {
    return {-a.value(), a.source()};
}
inline Sourced operator+(const Sourced& a, const Sourced& b) {
    return {a.value() + b.value(), source_of_both(a, b)};
}
inline Sourced operator-(const Sourced& a, const Sourced& b) {
    return {a.value() - b.value(), source_of_both(a, b)};
}
inline Sourced operator*(const Sourced& a, const Sourced& b) {
    return {a.value() * b.value(), source_of_both(a, b)};
}
inline Sourced operator/(const Sourced& a, const Sourced& b) {
    return {a.value() / b.value(), source_of_both(a, b)};
}
inline Sourced operator+(const Sourced& a, float b) {
    return {a.value() + b, a.source()};
}
inline Sourced operator-(const Sourced& a, float b) {
    return {a.value() - b, a.source()};
}
inline Sourced operator*(const Sourced& a, float b) {
    return {a.value() * b, a.source()};
}
inline Sourced operator/(const Sourced& a, float b) {
    return {a.value() / b, a.source()};
}
inline Sourced operator+(float a, const Sourced& b) {
    return {a + b.value(), b.source()};
}
inline Sourced operator-(float a, const Sourced& b) {
    return {a - b.value(), b.source()};
}
inline Sourced operator*(float a, const Sourced& b) {
    return {a * b.value(), b.source()};
}

inline bool less(const Sourced& a, const Sourced& b) {
    return a.value() < b.value();
}
inline Sourced select(bool condition, const Sourced& yes, const Sourced& no) {
    const Sourced& chosen = condition ? yes : no;
    return {chosen.value(), source_of_chosen(chosen, condition ? no : yes)};
}
inline Sourced min(const Sourced& a, const Sourced& b) {
    return select(a.value() < b.value(), a, b);
}
inline Sourced max(const Sourced& a, const Sourced& b) {
    return select(a.value() > b.value(), a, b);
}
inline Sourced abs(const Sourced& a) {
    return {std::fabs(a.value()), a.source()};
}
inline Sourced sqrt(const Sourced& a) {
    return {std::sqrt(a.value()), a.source()};
}
inline Sourced floor(const Sourced& a) {
    return {std::floor(a.value()), a.source()};
}
inline Sourced lookup(const float* table, const Sourced& index) {
    return {table[static_cast<int>(index.value())], index.source()};
}
inline Sourced angle_of(const Sourced& x, const Sourced& y) {
    return {phasetree::angle_of(x.value(), y.value()), source_of_both(x, y)};
}

}  // namespace phasetree::tree
