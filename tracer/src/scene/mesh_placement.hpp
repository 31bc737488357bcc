// What reading meshes from files of all kinds has in common: what the files must be, and where vertices go in the
// scene.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <initializer_list>
#include <string_view>

#include "parameters/world_limits.hpp"
#include "phasetree/io/kind.hpp"
#include "scene/mesh.hpp"

namespace phasetree::tracer {

inline constexpr std::uintmax_t most_bytes_of_mesh = std::uintmax_t{1} << 30;

/// Whether the name of the file has one of these endings, in any case.
bool has_ending_of_mesh(const std::filesystem::path& file, std::initializer_list<std::string_view> endings);

/// Throws ParameterError of "file" unless the name of the file has one of these endings, such as ".obj", in any case.
void check_ending_of_mesh(const std::filesystem::path& file, std::initializer_list<std::string_view> endings);

class MeshPlacement {
  public:
    MeshPlacement(float scale, float rotate_z_degrees, const glm::vec3& translate, bool y_up)
        : scale_(scale),
          translate_(translate),
          y_up_(y_up),
          cosine_(std::cos(glm::radians(rotate_z_degrees))),
          sine_(std::sin(glm::radians(rotate_z_degrees))) {}

    glm::vec3 turned(glm::vec3 p) const {
        if (y_up_) p = {p.x, -p.z, p.y};
        return {cosine_ * p.x - sine_ * p.y, sine_ * p.x + cosine_ * p.y, p.z};
    }
    /// Throws ParameterError of "file" for coordinates that a scene cannot have.
    void apply(Mesh& mesh, const std::filesystem::path& file) const {
        for (glm::vec3& p : mesh.vertices) {
            p = turned(scale_ * p) + translate_;
            for (int k = 0; k < 3; ++k)
                if (!coordinate.contains(p[k]))
                    throw ParameterError(
                        "file", fmt::format("{} has a coordinate that is no number or beyond 10¹⁵", file.string()));
        }
        for (glm::vec3& n : mesh.normals.values) n = turned(n);
        for (glm::vec4& t : mesh.tangents.values) t = glm::vec4(turned(glm::vec3(t)), t.w);
    }

  private:
    float scale_;
    glm::vec3 translate_;
    bool y_up_;
    float cosine_, sine_;
};

}  // namespace phasetree::tracer
