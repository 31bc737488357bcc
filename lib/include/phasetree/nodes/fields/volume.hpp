#pragma once

#include <memory>
#include <string>

#include "phasetree/model/from_file.hpp"
#include "phasetree/nodes/fields/profile.hpp"
#include "phasetree/nodes/fields/voxel_grid.hpp"
#include "phasetree/nodes/warps/warped.hpp"

namespace phasetree {

/// A level set as stored by OpenVDB: signed distances at voxels, exact near the surface and constant beyond a narrow
/// band. f is their trilinear interpolation, as in OpenVDB's BoxSampler, and λ is the maximum slope of f, or 1 if that
/// is larger. The maximum is known exactly, because it is the slope at some voxel (VoxelGrid::steepest_linear). For
/// samples of exact distances, λ is at most √3, and nearly 1 if the whole surface is smooth.
///
/// Points outside the grid's box are projected onto it, which never increases distances, and the distance b to the box
/// takes over where it is larger. So max(b, f/λ) is 1-Lipschitz, positive outside the box, and has the sign of f in it.
/// A solid that reaches the grid's border ends there.
struct Volume {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{
        "volume", "",
        "max(b, f/λ),  f the trilinear interpolation of the voxels, λ = max(1, sup |∇f|), b the grid's box",
        "The solid of a level set in an OpenVDB file, in the position stored there. Beyond the file's narrow band, the "
        "field's values are constant."};

    /// The primitive f/λ.
    struct Samples {
        static constexpr unsigned half_instructions = 120;
        /// Encloses the values in a box by the voxels near it.
        static std::optional<enclosure::Enclosure> enclosed(const float* data, const Vec3<enclosure::Enclosure>& q,
                                                            const std::array<double, 3>& half);
        static float period(const float* data) { return voxels::feature_size(data); }
        std::shared_ptr<const VoxelGrid> grid{};

        std::span<const float> data() const { return grid->table; }
        template <class T>
        static T distance(const float* data, const Vec3<T>& p) {
            return voxels::linear_at(data, p);
        }
    };
    using Parts = TypeList<Samples>;

    FromFile<VoxelGrid> file{};
    std::string grid{};
    BoundingBox box{};  ///< derived

    template <class V>
    static void parameters(V&& v) {
        v(&Volume::file,
          Parameter{"file", "",
                    "OpenVDB file. Its grid must be a level set of floats or doubles whose axes are aligned with those "
                    "of space, in any order and direction. Its lengths are taken as lengths in the scene's unit."});
        v(&Volume::grid, Parameter{"grid", "",
                                   "Name of the grid; required if the file has several level sets. If several have the "
                                   "same name, append the index: \"name[0]\", \"name[1]\".",
                                   limits::any, true});
    }
    /// The part of the file that is read.
    std::string part_of_file() const { return grid; }
    void prepare() {
        const Bounds extent = file.content->extent();
        box = {extent.centre(), extent.extent() * 0.5f};
    }
    template <class D>
    typename D::Scalar evaluate(D& d, const typename D::Point& p) const {
        return max(d.primitive(box, p), d.primitive(Samples{file.content}, p));
    }
    Bounds bounds(BoundsQuery& q, float level) const {
        // No value is below the minimum of its voxels, and outside the box the field is not below that of the box.
        const Bounds low = file.content->blocks_below(level);
        const Bounds outer = file.content->extent().inflated(level);
        const bool may_be_beyond = level >= 0;
        return q.placed(low.empty() ? Bounds{} : may_be_beyond ? beyond_border(low, outer, level) : low);
    }

  private:
    // Where blocks at the border of the grid contain values ≤ level, the field beyond the border may be ≤ level as
    // well.
    Bounds beyond_border(Bounds low, const Bounds& outer, float level) const {
        const Bounds inner = file.content->extent();
        for (int i = 0; i < 3; ++i) {
            if (low.low[i] <= inner.low[i]) low.low[i] = outer.low[i] - 1e-5f * level;
            if (low.high[i] >= inner.high[i]) low.high[i] = outer.high[i] + 1e-5f * level;
        }
        return low;
    }
};

}  // namespace phasetree
