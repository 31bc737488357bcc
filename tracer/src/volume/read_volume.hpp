// Grids of voxels that scenes name: level sets of OpenVDB for the node `volume`, whole numbers of OpenVDB or of stacks
// of images for the node `labels`, and how much there is of something, such as smoke, of either for media. A name that
// ends with .vdb is OpenVDB's.
//
// Whatever is wrong is std::runtime_error "cannot use the <what> "<path>": …", which quotes nothing of the file, not
// even the names of its grids, because a scene may name what its reader may not read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "phasetree/nodes/fields/voxel_grid.hpp"
#include "phasetree/nodes/phased/label_grid.hpp"

namespace phasetree::tracer {

// `grid` is the name of the one that is read, or empty if the file has but one that will do. Values are divided by the
// steepest slope of their trilinear interpolation, if that is above 1.
VoxelGrid read_level_set(const std::filesystem::path& path, const std::string& grid);

LabelGrid read_label_grid(const std::filesystem::path& path, const std::string& grid);

// Numbers at voxels, of which those below 0 count as 0: of OpenVDB's where the file has them, of a stack of images
// about the origin, with the spacing from voxel to voxel.
VoxelGrid read_number_grid(const std::filesystem::path& path, const std::string& grid);
VoxelGrid read_number_stack(const std::filesystem::path& path, const glm::dvec3& spacing);

// Whether the name of a file is that of an OpenVDB file, and not of images.
bool has_ending_of_openvdb(const std::filesystem::path& path);

// The images that a name with # in place of a number stands for, from the lowest layer to the highest; a name without
// is one image. std::runtime_error where there is none, or where a number is left out between two.
std::vector<std::filesystem::path> layers_of_stack(const std::filesystem::path& path);

// Whether this program was built with OpenVDB.
bool can_read_openvdb();
/// OpenVDB's version; empty if this program was built without it.
std::string openvdb_version();

}  // namespace phasetree::tracer
