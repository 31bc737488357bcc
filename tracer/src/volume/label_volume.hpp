// Labels of an object at the voxels of a grid, as files for other programs.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace phasetree::tracer {

struct LabelVolume {
    struct Phase {
        std::string name;
        std::array<int, 3> color{};  ///< sRGB codes from 0 to 255
    };

    std::array<std::size_t, 3> size{};  ///< the numbers of voxels along x, y and z
    glm::dvec3 origin{0};               ///< the centre of the first voxel
    double spacing = 1;                 ///< between the centres of neighbours
    double scale = 1;             ///< by which the scene's coordinates are multiplied; origin and spacing are, too
    std::string unit{};           ///< of lengths: "mm", "cm", "m" or "in"; empty if it is unknown
    std::vector<Phase> phases{};  ///< by label; [0] is the vacuum
    std::vector<std::uint8_t> labels{};  ///< x fastest

    std::size_t count() const { return size[0] * size[1] * size[2]; }
};

/// Thrown if a poll returned true.
class LabelsCancelled : public std::runtime_error {
  public:
    LabelsCancelled() : std::runtime_error("writing labels was cancelled") {}
};

/// An NRRD file of 8-bit labels, compressed with gzip. Names and colours are those of a segmentation in 3D Slicer.
std::string labels_as_nrrd(const LabelVolume&, const std::function<bool()>& cancelled);

/// An OpenVDB file with one grid of 32-bit labels. The vacuum is its background; all other voxels are active. Throws
/// std::runtime_error in builds without OpenVDB.
std::string labels_as_openvdb(const LabelVolume&, const std::function<bool()>& cancelled);

}  // namespace phasetree::tracer
