// The optics where one material meets another.
//
//   clear | clear     refraction and reflection with η_to/η_from, without any gap between the two
//   clear | opaque    the opaque one's surface, seen through the clear one's index: metal and varnish reflect less in
//                     water than in air
//   opaque | any      black: light does not travel in opaque materials, so no path comes from one
//
// An interface of two clear materials has one roughness, the greater of the two: a ground surface stays ground where
// it touches a polished one. Vacuum is smooth, so that a material against vacuum has its own.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "shading/bsdf.hpp"
#include "shading/material.hpp"

namespace phasetree::tracer {

/// Optics that depend on the place by the colour of the diffuse part.
struct TexturedOptics {
    std::shared_ptr<const Texture> color;
    std::shared_ptr<const CoatingAlbedo> coating;  ///< none for a plain diffuse surface
};

/// The optics of an ordered pair of materials: of any surface, also a mesh's, where a ray in the one meets the other.
class Interface {
  public:
    /// `from` is the material the ray is in, `to` the one it meets.
    static Interface between(const Material& from, const Material& to);

    /// The BSDF at a point; `position` is in the space textures are defined in. It refers to data of this interface and
    /// must not outlive it.
    Bsdf at(const glm::vec3& position) const&;
    Bsdf at(const glm::vec3& position) && = delete;

  private:
    explicit Interface(std::variant<Bsdf, TexturedOptics> optics) : optics_(std::move(optics)) {}

    std::variant<Bsdf, TexturedOptics> optics_;
};

/// The interfaces of every ordered pair of materials, built once.
class InterfaceTable {
  public:
    explicit InterfaceTable(std::span<const Material> materials);

    /// Throws std::out_of_range for the number of no material.
    const Interface& between(std::size_t from, std::size_t to) const;

  private:
    std::size_t count_;
    std::vector<Interface> interfaces_;
};

}  // namespace phasetree::tracer
