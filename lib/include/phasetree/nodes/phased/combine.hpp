// Minimum and maximum of components that may be absent. An absent phase behaves like +∞, without being a number.
#pragma once

#include <vector>

#include "phasetree/model/concepts.hpp"

namespace phasetree::detail {

/// The minimum over the phases of `among`; nullopt if none of them is present.
template <class S>
std::optional<S> minimum(const Phases<S>& a, std::uint64_t among) {
    std::optional<S> result;
    for_each_phase(a.present & among, [&](int i) { result = result ? min(*result, a[i]) : a[i]; });
    return result;
}

/// For each i of `wanted`, call use(i, min over j ≠ i, j in among, of aⱼ) with an optional. Linear in the number of
/// phases, by running minima from both ends.
template <class S, class Use>
void minimum_of_others(const Phases<S>& a, std::uint64_t among, std::uint64_t wanted, Use&& use) {
    std::array<int, Phase::capacity> order{};
    std::size_t count = 0;
    for_each_phase(a.present & among, [&](int i) { order[count++] = i; });
    std::vector<std::optional<S>> after(count + 1);
    for (std::size_t n = count; n-- > 0;) after[n] = after[n + 1] ? min(a[order[n]], *after[n + 1]) : a[order[n]];
    std::optional<S> before;
    std::size_t n = 0;
    for_each_phase(wanted, [&](int i) {
        while (n < count && order[n] < i) {
            before = before ? min(*before, a[order[n]]) : a[order[n]];
            ++n;
        }
        const std::optional<S>& rest = after[n < count && order[n] == i ? n + 1 : n];
        use(i, before && rest ? std::optional<S>(min(*before, *rest)) : before ? before : rest);
    });
}

/// min(aᵢ, bᵢ), where either may be absent; nullopt if both are.
template <class S>
std::optional<S> minimum_of(const Phases<S>& a, const Phases<S>& b, int i) {
    if (a.has(i) && b.has(i)) return min(a[i], b[i]);
    if (a.has(i)) return a[i];
    if (b.has(i)) return b[i];
    return std::nullopt;
}

/// Unite a part with a phase, which may be absent.
template <class S>
void add_part(Phases<S>& a, int i, const S& part) {
    a.set(i, a.has(i) ? min(a[i], part) : part);
}

/// The object with the phases `gone` replaced by vacuum.
template <class S>
Phases<S> emptied(Phases<S> a, std::uint64_t gone) {
    for_each_phase(a.materials() & gone, [&](int i) {
        const S value = a[i];
        a.set(0, a.has(0) ? min(a[0], value) : value);
        a.remove(i);
    });
    return a;
}

}  // namespace phasetree::detail
