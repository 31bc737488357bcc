// Grids of voxels that nodes name: level sets of OpenVDB for `volume`, and whole numbers of OpenVDB or of stacks of
// images for `labels`. A name that ends with .vdb is OpenVDB's.
//
// Whatever is wrong is std::runtime_error "cannot use the <what> "<path>": …", which quotes nothing of the file, not
// even the names of its grids, because a scene may name what its reader may not read.
#pragma once

#include <filesystem>
#include <string>

#include "phasetree/nodes/fields/voxel_grid.hpp"
#include "phasetree/nodes/phased/label_grid.hpp"

namespace phasetree::tracer {

// `grid` is the name of the one that is read, or empty if the file has but one that will do. Values are divided by the
// steepest slope of their trilinear interpolation, if that is above 1.
VoxelGrid read_level_set(const std::filesystem::path& path, const std::string& grid);

LabelGrid read_label_grid(const std::filesystem::path& path, const std::string& grid);

// Whether this program was built with OpenVDB.
bool can_read_openvdb();

}  // namespace phasetree::tracer
