// STL files, of numbers and of words.
#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "io/mesh_file.hpp"
#include "io/words.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree_support/reading.hpp"

namespace phasetree::io {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers of STL files are little-endian");

constexpr std::size_t header_bytes = 80, head_bytes = header_bytes + 4, triangle_bytes = 50, normal_bytes = 12;

// A binary file is as long as the number of triangles says that it has; also one whose header begins with "solid".
bool is_binary(std::string_view content) {
    if (content.size() < head_bytes) return false;
    std::uint32_t count;
    std::memcpy(&count, content.data() + header_bytes, sizeof count);
    return content.size() == head_bytes + std::uint64_t{count} * triangle_bytes;
}

void add_triangle(TriangleMesh& mesh, const glm::vec3 (&corners)[3]) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), std::begin(corners), std::end(corners));
    mesh.triangles.push_back({first, first + 1, first + 2});
}

TriangleMesh read_binary(std::string_view content) {
    TriangleMesh mesh;
    support::ReadingPlace place;
    for (std::size_t at = head_bytes; at < content.size(); at += triangle_bytes) {
        place.reached(at);
        glm::vec3 corners[3];
        std::memcpy(corners, content.data() + at + normal_bytes, sizeof corners);
        add_triangle(mesh, corners);
    }
    place.finished(content.size());
    return mesh;
}

TriangleMesh read_text(const std::filesystem::path& path, std::string_view content) {
    TriangleMesh mesh;
    Words words(content);
    const auto fail = [&](std::string_view what) {
        return SceneError(path.string(), fmt::format("{} (line {})", what, words.number()));
    };
    glm::vec3 corners[3];
    std::size_t count = 0;
    support::ReadingPlace place;
    while (words.next_line()) {
        place.reached(words.offset());
        const std::string_view kind = words.word();
        if (kind == "vertex") {
            if (count == 3) throw fail("a facet has more than three vertices");
            for (int i = 0; i < 3; ++i) {
                const auto number = number_of<float>(words.word());
                if (!number) throw fail("a vertex needs three numbers");
                corners[count][i] = *number;
            }
            ++count;
        } else if (kind == "endfacet") {
            if (count != 3) throw fail("a facet has less than three vertices");
            add_triangle(mesh, corners);
            count = 0;
        }
    }
    if (count != 0) throw fail("the file ends within a facet");
    place.finished(content.size());
    return mesh;
}

}  // namespace

MeshFile read_stl(const std::filesystem::path& path, std::string_view content) {
    if (is_binary(content)) return {read_binary(content), {}, {}, {}};
    if (!content.starts_with("solid"))
        throw SceneError(path.string(),
                         "is no STL file: it is neither as long as its number of triangles says nor a text "
                         "that begins with \"solid\"");
    return {read_text(path, content), {}, {}, {}};
}

}  // namespace phasetree::io
