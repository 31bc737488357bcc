// Numbers at voxels give the density of a medium: smoke, clouds, ink, scans. ρ is their trilinear interpolation,
// divided by the greatest of them, and 0 outside of the grid's box, whose faces are half a voxel outside of the
// outermost centres.
//
// The bound on ρ along a way is that of the blocks of 8³ voxels through which it goes, with the voxels next to each,
// and blocks without anything are passed over. Szirmay-Kalos, Tóth & Magdics, Free Path Sampling in High Resolution
// Inhomogeneous Participating Media, CGF 30(1), 2011, use such bounds; the walk from block to block is that of
// Amanatides & Woo, A Fast Voxel Traversal Algorithm for Ray Tracing, Eurographics 1987.
#pragma once

#include <glm/mat3x3.hpp>
#include <memory>

#include "media/density_contract.hpp"
#include "phasetree/nodes/fields/voxel_grid.hpp"

namespace phasetree::tracer {

/// Where voxels are in the space of the object, or of the scene if that is one tree: p = linear q + translation, of
/// points q in the grid's own space.
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
        float from_ = 0.0f, to_ = 0.0f;    ///< where the way enters and leaves the grid's box
        float at_ = 0.0f;                  ///< the distance from from_ to where the next block begins
        glm::vec3 start_{0}, step_{0};     ///< the place at from_, and how far a unit of distance goes; in blocks
        glm::ivec3 block_{0}, blocks_{0};  ///< the next block, and how many there are
    };

    /// The grid's values are not negative. Throws std::invalid_argument for a grid whose voxels floats do not tell
    /// apart where it is placed.
    VoxelDensity(VoxelGrid grid, const VoxelPlacement& placement);

    /// The greatest number of a voxel, of which ρ is a share.
    float greatest_number() const { return greatest_number_; }
    /// Each point takes a lookup of its own.
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
