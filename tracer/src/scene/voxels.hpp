// Voxel data in a scene file: which file, and its placement.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "media/voxel_density.hpp"
#include "phasetree/io/kind.hpp"
#include "scene/placement.hpp"

namespace phasetree::tracer {

struct Voxels {
    static constexpr KindInfo info{
        "voxels",
        "A voxel grid, from OpenVDB or a stack of images: smoke, clouds, ink, scans. Values are interpolated between "
        "the voxels' centres; negative ones count as 0. Outside the grid's box, which ends half a voxel beyond the "
        "outermost centres, they are 0. The grid is scaled first, then rotated, then translated."};

    std::filesystem::path file{};
    std::string grid{};
    std::optional<glm::vec3> spacing{};
    float factor = 1.0f;
    float scale = 1.0f;
    float rotate_z_degrees = 0.0f;
    glm::vec3 translate{0.0f};
    bool y_up = false;
    std::optional<VoxelDensity> shares{};  // as fractions of the largest number, once the file is read

    /// The largest of the numbers, multiplied by the factor.
    float greatest_number() const { return factor * shares->greatest_number(); }

    template <class V>
    static void parameters(V&& v) {
        using P = Voxels;
        v(&P::file,
          Parameter{
              "file", "",
              "An OpenVDB file (.vdb) with a grid of floats or doubles whose background is 0. Or grey images, one per "
              "layer from the lowest z to the highest: a name in which each # stands for a digit of the layer's "
              "number, such as \"layer_###.png\". Integer grey values are scaled to 0 … 1. The top row of an image has "
              "the greatest y and the left column the least x; the stack is centred on the origin."});
        v(&P::grid,
          Parameter{"grid", "",
                    "Name of the grid in an OpenVDB file; required if the file has several grids of numbers. If "
                    "several have the same name, append the index: \"density[0]\", \"density[1]\".",
                    limits::any, true});
        v(&P::spacing,
          Parameter{"spacing", "m",
                    "Distance between voxels along x, y and z. Required for images; OpenVDB files have their own.",
                    limits::positive, true});
        v(&P::factor, Parameter{"factor", "", "Factor applied to the numbers.", limits::non_negative, true});
        placement_parameters<P>(v);
        v(&P::y_up, y_up_parameter);
    }
    /// Checks the parameters without reading the file. Throws ParameterError.
    void check() const;
    /// Checks the parameters and reads the file. Throws ParameterError if the file is unusable.
    void prepare();
};

}  // namespace phasetree::tracer
