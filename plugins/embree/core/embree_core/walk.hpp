#pragma once

#include "embree_core/cell_scene.hpp"

namespace phasetree::embree {

/// Goes from crossing to crossing along a ray. Each starts where the last one ended, at its very point and in its
/// phase.
class Walk {
  public:
    Walk(const CellScene& scene, const UnitRay& ray, std::optional<Phase> carried)
        : scene_(scene), rest_(ray), carried_(carried), far_(static_cast<double>(ray.far)) {}

    /// The next crossing, its distances from the first ray's origin; none, once there is none.
    std::optional<CellScene::Hit> next();

  private:
    const CellScene& scene_;
    UnitRay rest_;
    std::optional<Phase> carried_;
    double far_;
    double base_ = 0;    ///< distance of rest_'s origin from the ray's
    double anchor_ = 0;  ///< of the place since which the walk has not come on
    int stuck_ = 0;      ///< steps since then
};

}  // namespace phasetree::embree
