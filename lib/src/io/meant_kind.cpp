#include "phasetree/io/meant_kind.hpp"

#include <algorithm>

#include "phasetree/io/suggest.hpp"

namespace phasetree {

namespace {

constexpr std::pair<std::string_view, std::string_view> pairs[] = {
    // shapes
    {"cube", "box"},
    {"cuboid", "box"},
    {"ball", "sphere"},
    {"uv_sphere", "sphere"},
    {"donut", "torus"},
    {"ring", "torus"},
    {"pipe", "tube"},
    {"cone", "capped_cone"},
    {"pill", "capsule"},
    {"half_space", "plane"},
    {"disk", "circle"},
    {"voxels", "volume"},
    {"terrain", "heightfield"},
    {"metaballs", "blob"},
    // operators
    {"add", "union"},
    {"or", "union"},
    {"and", "intersection"},
    {"intersect", "intersection"},
    {"subtract", "difference"},
    {"subtraction", "difference"},
    {"cut", "difference"},
    {"round", "offset"},
    {"onion", "shell"},
    {"hollow", "shell"},
    {"lathe", "revolve"},
    {"spin", "revolve"},
    {"repeat", "grid"},
    {"array", "grid"},
    {"move", "translate"},
    {"position", "translate"},
    {"resize", "scale"},
    {"material", "set"},
    // materials
    {"glass", "clear"},
    {"dielectric", "clear"},
    {"water", "clear"},
    {"lambertian", "diffuse"},
    {"matte", "diffuse"},
    {"metal", "conductor"},
    {"mirror", "conductor"},
    {"plastic", "coated"},
    {"disney", "principled"},
    {"openpbr", "principled"},
    {"open_pbr_surface", "principled"},
    {"pbr", "principled"},
    {"standard_surface", "principled"},
    {"emission", "glowing"},
    {"emissive", "glowing"},
    {"emitter", "glowing"},
    {"blend", "mix"},
    {"thindielectric", "thin_glass"},
    {"thin_dielectric", "thin_glass"},
    {"pane", "thin_glass"},
    {"diffuse_transmission", "thin_diffuse"},
    {"difftrans", "thin_diffuse"},
    {"translucent", "thin_diffuse"},
    {"twosided", "two_sided"},
    // lights, meshes, cameras
    {"area", "rectangle"},
    {"quad", "rectangle"},
    {"directional", "sun"},
    {"distant", "sun"},
    {"envmap", "image"},
    {"environment", "image"},
    {"hdri", "image"},
    {"infinite", "image"},
    {"spotlight", "spot"},
    {"glb", "gltf"},
    {"ground", "floor"},
    {"perspective", "thin_lens"},
    {"ortho", "orthographic"},
    {"fisheye", "dome"},
    {"spherical", "panorama"},
};

}  // namespace

std::span<const std::pair<std::string_view, std::string_view>> names_elsewhere() {
    return pairs;
}

std::optional<std::string> meant_kind(std::string_view name, std::span<const std::string_view> kinds) {
    for (const auto& [elsewhere, here] : pairs)
        if (name == elsewhere && std::ranges::find(kinds, here) != kinds.end()) return std::string(here);
    return closest(name, kinds);
}

}  // namespace phasetree
