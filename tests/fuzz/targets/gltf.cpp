// glTF files, by the path tracer's reading of them; files that they name have a few bytes.
#include <glm/glm.hpp>

#include "fuzz/target.hpp"
#include "gltf/read_gltf.hpp"

namespace phasetree::fuzz {

namespace {

void check_solids(const tracer::gltf::GltfFile& file) {
    for (const tracer::gltf::ClearSolid& solid : file.solids) {
        promised(!solid.name.empty() && solid.material < file.clear_materials.size(), "a solid has name and material");
        promised(!solid.mesh.triangles.empty(), "a solid has triangles");
        for (const glm::uvec3& triangle : solid.mesh.triangles)
            for (int i = 0; i < 3; ++i) promised(triangle[i] < solid.mesh.vertices.size(), "a solid's corners exist");
    }
    for (const tracer::gltf::NamedClearMaterial& named : file.clear_materials)
        promised(named.material.ior >= 1 && named.material.ior <= 4 && named.material.roughness >= 0 &&
                     named.material.roughness <= 1 && named.material.dispersion >= 0,
                 "clear materials are those of clear substances");
    for (const tracer::gltf::PunctualLight& light : file.lights)
        promised(light.intensity > 0 && light.outer_cone >= light.inner_cone, "lights emit");
}

}  // namespace

void run_gltf(Bytes input) {
    constexpr std::size_t max_triangles = 100'000;
    const tracer::gltf::Limits limits{
        .triangles = max_triangles, .primitives = 10'000, .materials = 100, .pixels = 10'000'000, .moves = 1'000'000};
    const std::string_view content = text_of(input);
    // The last bits of a file are of its images, or of no meaning.
    const unsigned last = content.empty() ? 0 : static_cast<unsigned char>(content.back());
    const auto materials = last % 2 != 0 ? tracer::gltf::ReadMaterials::none : tracer::gltf::ReadMaterials::all;
    const auto clear = last % 4 >= 2 ? tracer::gltf::ReadClear::as_solids : tracer::gltf::ReadClear::warn;
    const auto files = [](const std::string& path) {
        promised(("/" + path + "/").find("/../") == std::string::npos && !path.starts_with('/'),
                 "files are in the document's folder");
        return std::string(64, '\0');
    };
    try {
        const tracer::gltf::GltfFile file =
            tracer::gltf::read_gltf(content, {.materials = materials, .clear = clear, .limits = limits}, files);
        check_solids(file);
        for (const tracer::gltf::Part& part : file.parts) {
            promised(!part.mesh.triangles.empty() && part.mesh.triangles.size() <= max_triangles,
                     "there are triangles, and no more than are wanted");
            const std::size_t vertices = part.mesh.vertices.size();
            promised(part.normals.empty() || part.normals.values.size() == vertices, "each vertex has a normal");
            promised(part.texture.empty() || part.texture.values.size() == vertices, "each vertex has coordinates");
            promised(part.colors.empty() || part.colors.values.size() == vertices, "each vertex has a colour");
            for (const glm::uvec3& triangle : part.mesh.triangles)
                for (int i = 0; i < 3; ++i) promised(triangle[i] < vertices, "a triangle's corners exist");
            for (const glm::vec3& v : part.mesh.vertices)
                promised(glm::all(glm::lessThanEqual(glm::abs(v), glm::vec3(1.1e15f))), "places are those of a scene");
            for (const glm::vec3& c : part.colors.values)
                promised(
                    glm::all(glm::greaterThanEqual(c, glm::vec3(0))) && glm::all(glm::lessThanEqual(c, glm::vec3(1))),
                    "colours are fractions");
            promised(materials == tracer::gltf::ReadMaterials::none || !is_clear(part.material), "meshes are opaque");
            promised(part.tangents.empty() || part.tangents.values.size() == vertices, "each vertex has a tangent");
            promised(part.second_texture.empty() || part.second_texture.values.size() == vertices,
                     "each vertex has second coordinates");
            promised(part.alphas.empty() || part.alphas.values.size() == vertices, "each vertex has an alpha");
            for (const float alpha : part.alphas.values) promised(alpha >= 0 && alpha <= 1, "an alpha is a fraction");
            const tracer::TexturePoint place({0, 0, 0}, {0, 0, 1},
                                             tracer::MeshCoordinates{.uv = {0.3f, 0.7f}, .alpha = 0.5f});
            const float opacity = part.opacity ? part.opacity->at(place) : 1.0f;
            promised(opacity >= 0 && opacity <= 1, "an opacity is a fraction");
        }
    } catch (const tracer::gltf::GltfError&) {
    }
}

}  // namespace phasetree::fuzz
