// How dense a medium is by numbers at voxels: smoke, clouds, ink, scans. ρ is their trilinear interpolation, over the
// greatest of them, and 0 outside of the grid's box, whose faces are half a voxel outside of the outermost centres.
//
// The bound on ρ along a way is that of the blocks of 8³ voxels through which it goes, and blocks without anything are
// passed over. As density_contract.hpp's stretches it is what Szirmay-Kalos, Tóth & Magdics, Free Path Sampling in
// High Resolution Inhomogeneous Participating Media, CGF 30(1), 2011, use; blocks are walked through after Amanatides &
// Woo, A Fast Voxel Traversal Algorithm for Ray Tracing, Eurographics 1987.
#pragma once

#include <glm/mat3x3.hpp>
#include <memory>

#include "media/density_contract.hpp"
#include "phasetree/nodes/fields/voxel_grid.hpp"

namespace phasetree::tracer {

/// Where voxels are in the scene: p = linear q + by, of points q in the grid's own space.
struct VoxelPlacement {
    glm::dmat3 linear{1};
    glm::dvec3 by{0};
};

class VoxelDensity {
  public:
    class Stretches {
      public:
        Stretches(const VoxelDensity& density, const Way& way);
        std::optional<DensityStretch> next();
        float length() const { return to_ - from_; }

      private:
        const float* directory_;
        float from_ = 0.0f, to_ = 0.0f;    ///< where the way is within the grid's box
        float at_ = 0.0f;                  ///< the distance from there to where the block begins
        glm::vec3 start_{0}, step_{0};     ///< the place there and per distance, in blocks
        glm::ivec3 block_{0}, blocks_{0};  ///< the next block, and how many there are
    };

    /// The grid's values are not negative. Throws std::invalid_argument for a grid that is so small, so far away or so
    /// large where it is placed that floats do not tell its voxels apart.
    VoxelDensity(VoxelGrid grid, const VoxelPlacement& placement);

    /// The greatest value of a voxel, of which ρ is a share.
    float greatest() const { return greatest_; }
    BatchOfFloats at(const BatchOfFloats& x, const BatchOfFloats& y, const BatchOfFloats& z) const;
    const Bounds& bounds() const { return bounds_; }
    std::size_t bytes() const { return grid_->bytes(); }
    Stretches stretches(const Way& way) const { return {*this, way}; }

  private:
    void check_resolution(const VoxelPlacement& placement, const glm::dvec3& by, const glm::dvec3& spacing) const;
    // From the scene to the grid's own space, whose origin is the first voxel's centre.
    glm::vec3 to_grid(const glm::vec3& p) const { return linear_ * p + by_; }

    std::shared_ptr<const VoxelGrid> grid_;
    float greatest_ = 0.0f;
    Bounds box_;  ///< the grid's, in its own space
    glm::mat3 linear_;
    glm::vec3 by_;
    Bounds bounds_{};
};

}  // namespace phasetree::tracer
