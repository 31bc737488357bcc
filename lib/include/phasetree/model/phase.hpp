#pragma once

#include <array>
#include <bit>
#include <compare>
#include <cstdint>
#include <span>

namespace phasetree {

/// The index of a phase. 0 is the vacuum, which has a distance φ₀ of its own (a component of Φ); an object's materials
/// are 1 … 63.
struct Phase {
    std::uint8_t index = 0;

    static constexpr int capacity = 64;
    auto operator<=>(const Phase&) const = default;
};

inline constexpr Phase vacuum{0};

/// A set of phases: bit i stands for phase i.
struct PhaseSet {
    std::uint64_t bits = 0;

    static constexpr PhaseSet of(Phase p) { return {std::uint64_t{1} << p.index}; }
    static constexpr PhaseSet of(std::span<const Phase> list) {
        PhaseSet all;
        for (const Phase p : list) all = all | of(p);
        return all;
    }
    constexpr bool contains(Phase p) const { return (bits >> p.index) & 1; }
    constexpr bool contains(int i) const { return (bits >> i) & 1; }
    constexpr bool empty() const { return bits == 0; }
    constexpr int size() const { return std::popcount(bits); }
    constexpr PhaseSet operator|(PhaseSet o) const { return {bits | o.bits}; }
    constexpr PhaseSet operator&(PhaseSet o) const { return {bits & o.bits}; }
    constexpr bool operator==(const PhaseSet&) const = default;
};

/// Φ at a point: one value per phase that is present. A phase that a subtree never mentions is *absent*, not infinite,
/// because ∞ − ∞ and 0·∞ would produce NaN in smooth and contact operators. Which phases are present depends only on
/// the tree, never on the point.
template <class T>
struct Phases {
    std::array<T, Phase::capacity> value;
    std::uint64_t present = 0;

    Phases() {}  // values of absent phases stay uninitialised
    bool has(int i) const { return (present >> i) & 1; }
    const T& operator[](int i) const { return value[static_cast<std::size_t>(i)]; }
    void set(int i, const T& v) {
        value[static_cast<std::size_t>(i)] = v;
        present |= std::uint64_t{1} << i;
    }
    void remove(int i) { present &= ~(std::uint64_t{1} << i); }
    /// The bits of the phases that are present, without the vacuum.
    std::uint64_t materials() const { return present & ~std::uint64_t{1}; }
};

/// Call f(i) for each set bit, in ascending order.
template <class F>
void for_each_phase(std::uint64_t bits, F&& f) {
    while (bits != 0) {
        f(std::countr_zero(bits));
        bits &= bits - 1;
    }
}

}  // namespace phasetree
