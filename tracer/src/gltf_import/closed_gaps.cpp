#include "gltf_import/closed_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace phasetree::tracer::gltf_import {

namespace {

constexpr double least_share = 0.1;  // of a solid's surface

// Rounds x up to two significant digits, or down if that changes it by at most 0.1 %.
float rounded_up(double x) {
    double unit = 1e-30;
    while (100 * unit < x) unit *= 10;
    return static_cast<float>(std::ceil(x / unit * (1 - 1e-3)) * unit);
}

}  // namespace

std::optional<ClosedGaps> closed_gaps(const std::vector<Solid>& solids, std::span<const Matter> matter,
                                      const std::vector<Contact>& contacts, std::span<const std::size_t> order) {
    float widest = 0;
    std::set<std::size_t> materials;
    for (const Contact& c : contacts) {
        const std::size_t first = solids[c.first].material, second = solids[c.second].material;
        if (!c.gap || c.gap->share < least_share || first == second) continue;
        if ((matter[c.first] == Matter::liquid) == (matter[c.second] == Matter::liquid)) continue;
        widest = std::max(widest, c.gap->greatest);
        materials.insert({first, second});
    }
    if (materials.empty()) return std::nullopt;
    ClosedGaps closed{.materials = {}, .gap = rounded_up(2 * static_cast<double>(widest))};
    for (auto solid = order.rbegin(); solid != order.rend(); ++solid)
        if (materials.erase(solids[*solid].material) > 0) closed.materials.push_back(solids[*solid].material);
    return closed;
}

}  // namespace phasetree::tracer::gltf_import
