#pragma once

#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <unordered_map>
#include <vector>

#include "nodes/mesh_repair/chain.hpp"

namespace phasetree::mesh {

/// The vertices near lattice points. Vertices that it adds are farther from all others than `touching`.
class VertexAt {
  public:
    explicit VertexAt(Chain& chain) : chain_(chain), scale_(1 / (16 * touching)) {}

    /// Join each vertex to an earlier one that it touches, and remove triangles with two equal corners. Call this
    /// first.
    void join_touching() {
        std::vector<std::uint32_t> joined(chain_.points.size());
        vertices_.reserve(joined.size());
        for (std::uint32_t v = 0; v < joined.size(); ++v) {
            const auto near = nearest(chain_.points[v]);
            joined[v] = near.value_or(v);
            if (!near) add(v);
        }
        for (ChainTriangle& t : chain_.triangles)
            for (std::uint32_t& v : t.corners) v = joined[v];
        std::erase_if(chain_.triangles, [](const ChainTriangle& t) {
            return t.corners[0] == t.corners[1] || t.corners[1] == t.corners[2] || t.corners[2] == t.corners[0];
        });
    }
    std::uint32_t operator()(const glm::dvec3& p) {
        if (const auto near = nearest(p)) return *near;
        chain_.points.push_back(p);
        add(static_cast<std::uint32_t>(chain_.points.size() - 1));
        return static_cast<std::uint32_t>(chain_.points.size() - 1);
    }

    /// The vertex near a point, if there is one.
    std::optional<std::uint32_t> at(const glm::dvec3& p) const { return nearest(p); }
    /// Forget a vertex, which no triangle has any longer.
    void remove(std::uint32_t v) {
        const auto [first, last] = vertices_.equal_range(Cell(glm::floor(chain_.points[v] * scale_)));
        for (auto i = first; i != last; ++i)
            if (i->second == v) {
                vertices_.erase(i);
                return;
            }
    }

  private:
    using Cell = glm::ivec3;
    struct Hash {
        std::size_t operator()(const Cell& c) const {
            const auto part = [](int i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)); };
            std::uint64_t h = part(c.x) * 0x9e3779b97f4a7c15u;
            h = (h ^ (h >> 29) ^ part(c.y)) * 0xbf58476d1ce4e5b9u;
            h = (h ^ (h >> 32) ^ part(c.z)) * 0x94d049bb133111ebu;
            return h ^ (h >> 31);
        }
    };
    void add(std::uint32_t v) { vertices_.emplace(Cell(glm::floor(chain_.points[v] * scale_)), v); }
    std::optional<std::uint32_t> nearest(const glm::dvec3& p) const {
        std::optional<std::uint32_t> found;
        double least = touching * touching;
        const Cell low(glm::floor((p - touching) * scale_)), high(glm::floor((p + touching) * scale_));
        for (int x = low.x; x <= high.x; ++x)
            for (int y = low.y; y <= high.y; ++y)
                for (int z = low.z; z <= high.z; ++z) {
                    const auto [first, last] = vertices_.equal_range(Cell(x, y, z));
                    for (auto i = first; i != last; ++i) {
                        const glm::dvec3 away = chain_.points[i->second] - p;
                        const double squared = glm::dot(away, away);
                        if (squared > least || (squared == least && !(found && i->second < *found))) continue;
                        least = squared;
                        found = i->second;
                    }
                }
        return found;
    }

    Chain& chain_;
    double scale_;  // so that most points have no other cell nearby
    std::unordered_multimap<Cell, std::uint32_t, Hash> vertices_;
};

}  // namespace phasetree::mesh
