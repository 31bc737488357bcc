// OBJ files, by the path tracer's own reading of them.
#include "fuzz/input_file.hpp"
#include "scene/read_parts.hpp"

namespace phasetree::fuzz {

void run_obj(Bytes input) {
    static InputFile file("mesh.obj");
    const Document document = Document::from_text(
        R"([{"obj": {"file": ")" + file.write(input).string() +
        R"(", "y_up": true, "scale": 2, "rotate_z": 30, "material": {"diffuse": {"color": [1, 1, 1]}}}}])");
    try {
        for (const tracer::Mesh& mesh : tracer::read_meshes(document, document.root()).meshes)
            for (const glm::uvec3& triangle : mesh.triangles)
                for (int i = 0; i < 3; ++i) promised(triangle[i] < mesh.vertices.size(), "a triangle's corners exist");
    } catch (const SceneError&) {
    }
}

}  // namespace phasetree::fuzz
