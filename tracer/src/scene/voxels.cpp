#include "scene/voxels.hpp"

#include <stdexcept>
#include <utility>

#include "parameters/world_limits.hpp"
#include "volume/read_volume.hpp"

namespace phasetree::tracer {

void Voxels::check() const {
    const bool is_openvdb = has_ending_of_openvdb(file);
    if (is_openvdb && spacing)
        throw ParameterError("spacing", "OpenVDB grids have their own spacing; remove \"spacing\"",
                             ParameterError::Place::key);
    if (!is_openvdb && !spacing)
        throw ParameterError("spacing", "images do not store the size of their voxels; give \"spacing\"");
    if (!is_openvdb && !grid.empty())
        throw ParameterError("grid", "images have no named grids; remove \"grid\"", ParameterError::Place::key);
}

void Voxels::prepare() {
    check();
    const bool is_openvdb = has_ending_of_openvdb(file);
    const Placement placement(scale, rotate_z_degrees, translate, y_up);
    const glm::dmat3 linear(placement.linear());
    try {
        PlacedVoxels voxels =
            is_openvdb ? read_number_grid(file, grid) : PlacedVoxels{read_number_stack(file, glm::dvec3(*spacing))};
        shares.emplace(std::move(voxels.grid),
                       VoxelPlacement{linear * voxels.linear, linear * voxels.translation + glm::dvec3(translate)});
    } catch (const std::runtime_error& e) {  // from reading the file
        throw ParameterError("file", e.what());
    } catch (const std::invalid_argument& e) {  // from its placement
        throw ParameterError("file", e.what());
    }
    for (int i = 0; i < 3; ++i)
        if (!coordinate.contains(shares->bounds().low[i]) || !coordinate.contains(shares->bounds().high[i]))
            throw ParameterError("file", "its voxels would be farther than 10¹⁵ from the origin");
}

}  // namespace phasetree::tracer
