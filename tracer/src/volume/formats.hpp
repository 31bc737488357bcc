// Readers of the individual formats. They throw std::runtime_error, which states the problem but not the file.
#pragma once

#include "volume/read_volume.hpp"

namespace phasetree::tracer {

// openvdb.cpp, or no_openvdb.cpp in builds without the library.
VoxelGrid level_set_of_openvdb(const std::filesystem::path& path, const std::string& grid);
LabelGrid labels_of_openvdb(const std::filesystem::path& path, const std::string& grid);
PlacedVoxels numbers_of_openvdb(const std::filesystem::path& path, const std::string& grid);

LabelGrid labels_of_images(const std::filesystem::path& pattern);
// Centred at the origin.
VoxelGrid numbers_of_images(const std::filesystem::path& pattern, const glm::dvec3& spacing);

}  // namespace phasetree::tracer
