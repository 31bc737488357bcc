#pragma once

#include "nodes/voxels/depth_of_share.hpp"
#include "nodes/voxels/lines.hpp"
#include "phasetree/nodes/phased/labels.hpp"

namespace phasetree {

/// Converts integers at voxels to a smooth field for each phase, as defined in phased/labels.hpp. It uses all threads;
/// the result does not depend on their number.
class LabelDepths {
  public:
    /// `phases` maps each of the grid's numbers to its phase; `sigma` is in voxels.
    LabelDepths(const LabelGrid& grid, const VoxelLattice& lattice, std::vector<int> phases, float sigma)
        : grid_(grid), lattice_(lattice), phases_(std::move(phases)), blur_(sigma), depth_of_(sigma) {}

    /// The fields Dₖ of the phases that occur; `present` must contain all phases of voxels.
    std::vector<Labels::Part> of(const std::vector<int>& present);

  private:
    /// Depths at a voxel. settle() raises the depth of the voxel's own phase and lowers those of others where they are
    /// too close.
    struct Depths {
        float own = 0;
        float others = 0;  ///< the greatest depth of any other phase; after settle(), the upper limit for other phases
    };

    int phase_at(std::size_t voxel) const { return phases_[grid_.voxels[voxel]]; }
    std::vector<float> blurred(int phase) const;
    void enter(int phase, const std::vector<float>& depths);
    void settle();
    VoxelGrid grid_of(int phase, std::vector<float> depths) const;

    const LabelGrid& grid_;
    VoxelLattice lattice_;
    std::vector<int> phases_;
    voxels::Blur blur_;
    DepthOfShare depth_of_;
    std::vector<Depths> depths_{};  ///< of each voxel
};

}  // namespace phasetree
