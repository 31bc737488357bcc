#include "command/looks.hpp"

#include <glm/trigonometric.hpp>

namespace phasetree::tracer {

std::vector<Look> looks_of(const PhaseNames& phases, std::span<const std::optional<Material>> materials,
                           const Bounds& bounds) {
    std::vector<Look> looks = looks_without_materials(phases);
    for (std::size_t i = 0; i < looks.size(); ++i)
        if (materials[i]) looks[i] = look_of(phases.names[i], *materials[i], bounds);
    return looks;
}

std::vector<Look> looks_without_materials(const PhaseNames& phases) {
    std::vector<Look> looks;
    for (std::size_t i = 0; i < phases.names.size(); ++i) {
        // Distinct colours: hues spaced by the golden ratio.
        const float turn = 6.2831853f * 0.618034f * static_cast<float>(i);
        Look look{phases.names[i], i == 0 ? Look::clear : Look::coated};
        if (i > 0) look.color = 0.45f + 0.35f * glm::cos(turn + glm::vec3(0, 2.1f, 4.2f));
        looks.push_back(look);
    }
    return looks;
}

}  // namespace phasetree::tracer
