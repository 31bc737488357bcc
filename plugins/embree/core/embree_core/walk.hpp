#pragma once

#include "embree_core/cell_scene.hpp"

namespace phasetree::embree {

/// Steps from crossing to crossing along a ray. Each search starts exactly where the last crossing ended, in its phase.
class Walk {
  public:
    Walk(const CellScene& scene, const UnitRay& ray, std::optional<Phase> carried)
        : scene_(scene), rest_(ray), carried_(carried), far_(static_cast<double>(ray.far)) {}

    /// The next crossing, with distances from the original ray's origin; nullopt at the end.
    std::optional<CellScene::Hit> next();

  private:
    const CellScene& scene_;
    UnitRay rest_;
    std::optional<Phase> carried_;
    double far_;
    double base_ = 0;    ///< distance of rest_'s origin from the original ray's
    double anchor_ = 0;  ///< distance at which the current stuck_ steps began
    int stuck_ = 0;      ///< steps without progress
};

}  // namespace phasetree::embree
