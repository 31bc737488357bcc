// Whether a closed mesh is a manifold, counted from its triangles alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace phasetree::tests {

/// The defects that keep triangles from being a closed, oriented manifold.
struct ManifoldFaults {
    std::size_t edges = 0;      ///< that do not have one triangle on each side
    std::size_t vertices = 0;   ///< around which the triangles are not one fan, or there are none
    std::size_t triangles = 0;  ///< that have a vertex twice

    std::size_t all() const { return edges + vertices + triangles; }
};

inline ManifoldFaults manifold_faults(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertices) {
    ManifoldFaults faults;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;  // of each edge from one vertex to another
    // For each vertex, the pairs of neighbours that its triangles connect.
    std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> around(vertices);
    for (const auto& t : triangles) {
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) ++faults.triangles;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
            ++uses[{a, b}];
            around[a].emplace_back(b, c);
        }
    }
    for (const auto& [edge, count] : uses) {
        const auto back = uses.find({edge.second, edge.first});
        if (count != 1 || back == uses.end() || back->second != 1) ++faults.edges;
    }
    for (const auto& fan : around) {
        std::size_t steps = 0;
        if (!fan.empty()) {
            std::uint32_t at = fan[0].first;
            do {
                const auto next = std::find_if(fan.begin(), fan.end(), [&](const auto& f) { return f.first == at; });
                if (next == fan.end()) break;
                at = next->second;
                ++steps;
            } while (at != fan[0].first && steps <= fan.size());
        }
        if (steps == 0 || steps != fan.size()) ++faults.vertices;
    }
    return faults;
}

}  // namespace phasetree::tests
