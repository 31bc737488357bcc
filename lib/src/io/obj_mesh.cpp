// The lines of an OBJ file that say where its surface is: v and f.
#include <fmt/format.h>

#include <array>
#include <optional>

#include "io/mesh_file.hpp"
#include "io/words.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree_support/reading.hpp"

namespace phasetree::io {

namespace {

// The vertex that a corner of a face names: a number from 1, or one that counts back from the last vertex so far.
// Behind slashes stand texture coordinates and normals.
std::optional<std::uint32_t> vertex_of(std::string_view corner, std::size_t vertices) {
    const auto number = number_of<std::int64_t>(corner.substr(0, corner.find('/')));
    const auto count = static_cast<std::int64_t>(vertices);
    if (!number || *number == 0 || *number > count || *number < -count) return std::nullopt;
    return static_cast<std::uint32_t>(*number > 0 ? *number - 1 : count + *number);
}

}  // namespace

TriangleMesh read_obj(const std::filesystem::path& path, std::string_view content) {
    TriangleMesh mesh;
    Words words(content);
    const auto fail = [&](std::string_view what) {
        return SceneError(path.string(), fmt::format("{} (line {})", what, words.number()));
    };
    support::ReadingPlace place;
    while (words.next_line()) {
        place.reached(words.offset());
        const std::string_view kind = words.word();
        if (kind == "v") {
            glm::vec3 p;
            for (int i = 0; i < 3; ++i) {
                const auto number = number_of<float>(words.word());
                if (!number) throw fail("a vertex needs three numbers");
                p[i] = *number;
            }
            mesh.vertices.push_back(p);
        } else if (kind == "f") {
            std::array<std::uint32_t, 3> corner{};
            std::size_t corners = 0;
            for (std::string_view word; !(word = words.word()).empty(); ++corners) {
                const auto vertex = vertex_of(word, mesh.vertices.size());
                if (!vertex) throw fail("a face names a vertex that does not exist");
                corner[corners == 0 ? 0 : 2] = *vertex;
                // A face of more corners is a fan about its first one.
                if (corners >= 2) mesh.triangles.push_back({corner[0], corner[1], corner[2]});
                if (corners >= 1) corner[1] = corner[2];
            }
            if (corners < 3) throw fail("a face needs three vertices");
            if (mesh.triangles.size() > TriangleMesh::most_triangles)
                throw fail("there are more triangles than 2 million");
        }
    }
    place.finished(content.size());
    return mesh;
}

}  // namespace phasetree::io
