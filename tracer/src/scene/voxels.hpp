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
        "Numbers at voxels, from OpenVDB or a stack of images: smoke, clouds, ink, scans. Between the voxels' centres "
        "they are interpolated, and negative ones count as 0. Outside of the grid's box, which ends half a voxel "
        "beyond "
        "the outermost centres, they are 0. The grid is scaled first, then turned, then moved."};

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
              "An OpenVDB file (.vdb) with a grid of floats or doubles, whose background is 0; or grey images, one "
              "for each layer from the lowest z to the highest: a name in which # stands for a digit of their "
              "numbers, such as \"layer_###.png\". Integer grey values are scaled to 0 … 1. The top row of an image "
              "has the greatest y, and its left column the least x; the stack is centred on the origin."});
        v(&P::grid, Parameter{"grid", "",
                              "Which of an OpenVDB file's grids; needed if it has several of numbers. If several have "
                              "the same name, its index follows: \"density[0]\", \"density[1]\".",
                              limits::any, true});
        v(&P::spacing,
          Parameter{"spacing", "m", "From voxel to voxel along x, y and z. Images need it, and OpenVDB has its own.",
                    limits::positive, true});
        v(&P::factor, Parameter{"factor", "", "What the numbers are multiplied by.", limits::non_negative, true});
        placement_parameters<P>(v);
        v(&P::y_up, y_up_parameter);
    }
    /// Checks the parameters without reading the file. Throws ParameterError.
    void check() const;
    /// Checks the parameters and reads the file. Throws ParameterError if the file is unusable.
    void prepare();
};

}  // namespace phasetree::tracer
