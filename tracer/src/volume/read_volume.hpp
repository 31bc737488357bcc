// Voxel grids named in scenes: OpenVDB level sets for the node `volume`; integers from OpenVDB files or image stacks
// for the node `labels`; and quantities such as smoke density, from either, for media. A name that ends in .vdb denotes
// an OpenVDB file.
//
// Errors are std::runtime_error "cannot use the <what> "<path>": …". They quote nothing from the file except the names
// of an OpenVDB file's grids, because a scene may name files that its author may not read.
#pragma once

#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "phasetree/nodes/fields/voxel_grid.hpp"
#include "phasetree/nodes/phased/label_grid.hpp"

namespace phasetree::tracer {

// `grid` is the name of the grid to read. It may be empty if only one grid is suitable. If several have the same name,
// append their index in the file, as in OpenVDB's own tools: "density[0]", "density[1]".
//
// The axes of level sets and labels may be swapped or mirrored, but must be parallel to those of the world.

// Divides values by the steepest slope of their trilinear interpolation, if that exceeds 1.
VoxelGrid read_level_set(const std::filesystem::path& path, const std::string& grid);

LabelGrid read_label_grid(const std::filesystem::path& path, const std::string& grid);

// A grid and its placement: a point q of the grid's own space is at linear q + translation in the world.
struct PlacedVoxels {
    VoxelGrid grid;
    glm::dmat3 linear{1};
    glm::dvec3 translation{0};
};

// Numbers at voxels; negative values become 0. The grid may also be rotated or sheared.
PlacedVoxels read_number_grid(const std::filesystem::path& path, const std::string& grid);
// A stack of images centred at the origin, with the given spacing between voxels.
VoxelGrid read_number_stack(const std::filesystem::path& path, const glm::dvec3& spacing);

// Whether a file name denotes an OpenVDB file rather than images.
bool has_ending_of_openvdb(const std::filesystem::path& path);

// The images denoted by a name with # instead of a number, from the lowest layer to the highest. A name without # is a
// single image. Throws std::runtime_error if there are none, or if a number in between is missing.
std::vector<std::filesystem::path> layers_of_stack(const std::filesystem::path& path);

// Whether this build includes OpenVDB.
bool can_read_openvdb();
/// OpenVDB's version; empty if this build does not include it.
std::string openvdb_version();

}  // namespace phasetree::tracer
