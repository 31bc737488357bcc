// The density of a medium from values at voxels: smoke, clouds, ink, scans. ρ is their trilinear interpolation, divided
// by the greatest value. It is 0 outside of the grid's box, whose faces are half a voxel outside of the outermost
// centres.
//
// The bound on ρ along a ray segment is that of the blocks of 8³ voxels that it crosses, including the voxels adjacent
// to each. Empty blocks are skipped. Szirmay-Kalos, Tóth & Magdics, Free Path Sampling in High Resolution Inhomogeneous
// Participating Media, CGF 30(1), 2011, use such bounds; the traversal of blocks is that of Amanatides & Woo, A Fast
// Voxel Traversal Algorithm for Ray Tracing, Eurographics 1987.
#pragma once

#include <glm/mat3x3.hpp>
#include <memory>

#include "media/density_contract.hpp"
#include "phasetree/nodes/fields/voxel_grid.hpp"

namespace phasetree::tracer {

/// The placement of voxels in the space of the object, or of the scene if that is one tree: p = linear q + translation,
/// for points q in the grid's own space.
struct VoxelPlacement {
    glm::dmat3 linear{1};
    glm::dvec3 translation{0};
};

class VoxelDensity {
  public:
    class Stretches {
      public:
        Stretches(const VoxelDensity& density, const Way& way);
        std::optional<DensityStretch> next();
        float length() const { return to_ - from_; }

      private:
        const float* directory_ = nullptr;
        float from_ = 0.0f, to_ = 0.0f;    ///< where the segment enters and leaves the grid's box
        float at_ = 0.0f;                  ///< distance from from_ to where the next block begins
        glm::vec3 start_{0}, step_{0};     ///< the point at from_, and the step per unit distance; in blocks
        glm::ivec3 block_{0}, blocks_{0};  ///< the next block, and the number of blocks
    };

    /// The values of the grid must not be negative. Throws std::invalid_argument if floats cannot resolve the voxels
    /// where the grid is placed.
    VoxelDensity(VoxelGrid grid, const VoxelPlacement& placement);

    /// The greatest value of a voxel, by which ρ is normalised.
    float greatest_number() const { return greatest_number_; }
    /// Each point needs its own lookup.
    static constexpr std::size_t together = 1;
    BatchOfFloats at(const PointBatch& points, std::size_t count) const;
    float at(const glm::vec3& p) const;
    const Bounds& bounds() const { return bounds_; }
    std::size_t bytes() const { return grid_->bytes(); }
    Stretches stretches(const Way& way) const { return {*this, way}; }

  private:
    void check_resolution(const glm::dvec3& spacing) const;
    glm::vec3 in_grid(const glm::vec3& p) const { return to_grid_ * p + to_grid_offset_; }

    std::shared_ptr<const VoxelGrid> grid_;
    float greatest_number_ = 0.0f;
    Bounds box_;  ///< the grid's, in its own space
    /// From the object's space to the grid's own, whose origin is the first voxel's centre.
    glm::mat3 to_grid_;
    glm::vec3 to_grid_offset_;
    Bounds bounds_{};
};

}  // namespace phasetree::tracer
