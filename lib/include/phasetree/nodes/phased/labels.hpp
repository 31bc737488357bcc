#pragma once

#include <memory>
#include <string>
#include <vector>

#include "phasetree/model/from_file.hpp"
#include "phasetree/nodes/phased/label_grid.hpp"
#include "phasetree/nodes/phased/shape_cut.hpp"
#include "phasetree/nodes/warps/warped.hpp"

namespace phasetree {

/// A segmented scan. Each voxel belongs to one phase, and surfaces between voxel centres are smooth.
///
/// *Method.* mₖ is 1 at the voxels of phase k and 0 at others, blurred by a Gaussian of σ voxels; the mₖ sum to 1. At
/// distance t from a flat interface mₖ is N(t/σ), where N is the cumulative normal distribution, so gₖ = σ N⁻¹(mₖ) is
/// the depth of a point in phase k. N⁻¹ is increasing, so gₖ is largest where mₖ is. gₖ is clamped to ±2.5 σ.
///
/// Blurring can remove a voxel from its phase: its own g is then less than the largest of the others, by some e > 0.
/// There, its own g is raised and the others are lowered until its own exceeds them by e clamped to [0.02, 0.3] voxels.
/// A wall or a thread one voxel thick is thus preserved, about half a voxel thick.
///
/// Dₖ is the triquadratic B-spline through the −gₖ at the voxels' centres, divided by the steepest slope of all of them
/// (VoxelGrid::steepest_spline): a smooth, 1-Lipschitz field. As in voronoi,
///     φₖ = (Dₖ − min over m ≠ k of Dₘ)/2,
/// of which exactly one is negative wherever no two D are equal. At the centre of a voxel, the negative one is that of
/// the voxel's phase, because the spline interpolates g there.
///
/// The object ends with the box of its voxels, outside of which all is vacuum. It is cut by the box as in
/// intersect_shape.
struct Labels {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{
        "labels", "",
        "φₖ = (Dₖ − min over m ≠ k of Dₘ)/2,  Dₖ = −σ N⁻¹(blurred share of phase k)/λ,  N the cumulative "
        "normal distribution, within the box of the voxels",
        "A segmented scan as an object of many phases: whole numbers at voxels, from images or OpenVDB. The centre of "
        "each voxel has the phase of its number, and interfaces in between are smooth. Distances are clamped to about "
        "two voxels."};

    /// The primitive Dₖ.
    struct Depth {
        static constexpr unsigned half_instructions = 250;
        /// Encloses the values in a box by the voxels near it.
        static std::optional<enclosure::Enclosure> enclosed(const float* data, const Vec3<enclosure::Enclosure>& q,
                                                            const std::array<double, 3>& half);
        static float period(const float* data) { return voxels::feature_size(data); }
        std::shared_ptr<const VoxelGrid> grid{};

        std::span<const float> data() const { return grid->table; }
        template <class T>
        static T distance(const float* data, const Vec3<T>& p) {
            return voxels::spline_at(data, p);
        }
    };
    using Parts = TypeList<Depth>;

    FromFile<LabelGrid> file{};
    std::vector<Phase> of_phases{};
    std::vector<float> values{};
    std::vector<float> empty{};
    glm::vec3 spacing{0};
    float smoothing = 1;
    std::string grid{};

    /// A phase in the scan, and its Dₖ.
    struct Part {
        int phase = 0;
        std::shared_ptr<const VoxelGrid> depth{};
    };
    std::vector<Part> parts{};  ///< derived, by phase
    BoundingBox box{};          ///< derived
    Bounds solid{};             ///< derived: around all blocks that have voxels other than vacuum

    template <class V>
    static void parameters(V&& v) {
        v(&Labels::file,
          Parameter{"file", "",
                    "OpenVDB file with a grid of whole numbers. Or images, one per layer from the lowest z to the "
                    "highest: a name in which each # stands for a digit of the layer's number, such as "
                    "\"layer_###.png\". Images are grey, with integers of up to 32 bits, and seen from above, like "
                    "those of height_map. The object is centred at the origin."});
        v(&Labels::of_phases, Parameter{"phases", "", "The phases of the object."});
        v(&Labels::values, Parameter{"values", "", "The voxel value of each phase; by default 1, 2, 3 …",
                                     Limits{.low = -16777216, .high = 16777216}, true});
        v(&Labels::empty,
          Parameter{"empty", "", "Voxel values that are vacuum, unless they are listed for a phase; by default 0.",
                    Limits{.low = -16777216, .high = 16777216}, true});
        v(&Labels::spacing,
          Parameter{"spacing", "m",
                    "Distance between voxels along x, y and z, for images. OpenVDB grids have their own.",
                    limits::non_negative, true});
        v(&Labels::smoothing,
          Parameter{"smoothing", "voxels",
                    "Standard deviation σ of the blur; at 0, interfaces show the steps of the voxels.",
                    Limits{.low = 0, .high = 4}, true});
        v(&Labels::grid, Parameter{"grid", "",
                                   "Name of the grid in an OpenVDB file; required if the file has several grids of "
                                   "whole numbers. If several "
                                   "have the same name, append the index: \"name[0]\", \"name[1]\".",
                                   limits::any, true});
    }
    /// The part of the file that is read.
    std::string part_of_file() const { return grid; }
    /// Throws ModelError, with the position, if the label of a voxel has no phase.
    void prepare();

    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        const auto b = d.primitive(box, p);
        Phases<typename D::Scalar> depths, result;
        for (const Part& part : parts) {
            if (parts.size() == 1)
                result.set(part.phase, b);
            else
                depths.set(part.phase, d.primitive(Depth{part.depth}, p));
        }
        detail::minimum_of_others(depths, depths.present, depths.present,
                                  [&](int i, const auto& others) { result.set(i, (depths[i] - *others) * 0.5f); });
        return detail::cut(result, b, {});
    }
    PhaseSet phases() const {
        PhaseSet all = PhaseSet::of(vacuum);
        for (const Part& part : parts) all = all | PhaseSet{std::uint64_t{1} << part.phase};
        return all;
    }
    /// Memory of derived data, in bytes.
    std::size_t derived_bytes() const {
        std::size_t sum = 0;
        for (const Part& part : parts) sum += sizeof part + part.depth->bytes();
        return sum;
    }
    Bounds bounds(BoundsQuery& q, float level) const {
        return q.placed(level <= 0 ? solid : Bounds{box.centre - box.half, box.centre + box.half}.inflated(level));
    }
};

}  // namespace phasetree
