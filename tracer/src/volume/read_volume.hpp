// Grids of voxels that scenes name: level sets of OpenVDB for the node `volume`, whole numbers of OpenVDB or of stacks
// of images for the node `labels`, and how much there is of something, such as smoke, of either for media. A name that
// ends with .vdb is OpenVDB's.
//
// Errors are std::runtime_error "cannot use the <what> "<path>": …". They quote nothing of the file but the names of an
// OpenVDB file's grids, because a scene may name files that its author may not read.
#pragma once

#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "phasetree/nodes/fields/voxel_grid.hpp"
#include "phasetree/nodes/phased/label_grid.hpp"

namespace phasetree::tracer {

// `grid` names the grid to read and may be empty if only one will do. If several have the same name, their index in the
// file tells them apart, as in OpenVDB's own tools: "density[0]", "density[1]".
//
// The axes of level sets and labels may be swapped or mirrored, but must lie along those of the world.

// Values are divided by the steepest slope of their trilinear interpolation, if that is above 1.
VoxelGrid read_level_set(const std::filesystem::path& path, const std::string& grid);

LabelGrid read_label_grid(const std::filesystem::path& path, const std::string& grid);

// A grid and where it is: a point q of the grid's own space is at linear q + translation in the world.
struct PlacedVoxels {
    VoxelGrid grid;
    glm::dmat3 linear{1};
    glm::dvec3 translation{0};
};

// Numbers at voxels; those below 0 count as 0. The grid may also be rotated or sheared.
PlacedVoxels read_number_grid(const std::filesystem::path& path, const std::string& grid);
// A stack of images about the origin, with the spacing from voxel to voxel.
VoxelGrid read_number_stack(const std::filesystem::path& path, const glm::dvec3& spacing);

// Whether the name of a file is that of an OpenVDB file, and not of images.
bool has_ending_of_openvdb(const std::filesystem::path& path);

// The images that a name with # instead of a number stands for, from the lowest layer to the highest; a name without
// is one image. std::runtime_error where there is none, or where a number is left out between two.
std::vector<std::filesystem::path> layers_of_stack(const std::filesystem::path& path);

// Whether this program was built with OpenVDB.
bool can_read_openvdb();
/// OpenVDB's version; empty if this program was built without it.
std::string openvdb_version();

}  // namespace phasetree::tracer
