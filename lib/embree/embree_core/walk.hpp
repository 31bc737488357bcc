#pragma once

#include "embree_core/cell_scene.hpp"

namespace phasetree::embree {

/// Iterates over the crossings along a ray. Each step starts exactly at p_to of the previous crossing, in the phase
/// entered there.
class Walk {
  public:
    Walk(const CellScene& scene, const UnitRay& ray, std::optional<Phase> carried)
        : scene_(scene), rest_(ray), carried_(carried), far_(static_cast<double>(ray.far)) {}

    /// The next crossing, with distances from the original ray's origin; nullopt after the last one.
    std::optional<CellScene::Hit> next();

  private:
    const CellScene& scene_;
    UnitRay rest_;
    std::optional<Phase> carried_;
    double far_;
    double base_ = 0;    ///< distance of rest_'s origin from that of the ray
    double anchor_ = 0;  ///< distance at which the walk last advanced
    int stuck_ = 0;      ///< steps since then
};

}  // namespace phasetree::embree
