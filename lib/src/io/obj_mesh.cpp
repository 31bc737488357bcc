// The lines of an OBJ file that say where its surface is, and what it is like at the corners of its faces: v, vt, vn,
// f.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "io/face_triangles.hpp"
#include "io/mesh_file.hpp"
#include "io/words.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree_support/reading.hpp"

namespace phasetree::io {

namespace {

// The index that a corner of a face names: a number from 1, or one that counts back from the last so far.
std::optional<std::uint32_t> index_of(std::string_view word, std::size_t size) {
    const auto number = number_of<std::int64_t>(word);
    const auto count = static_cast<std::int64_t>(size);
    if (!number || *number == 0 || *number > count || *number < -count) return std::nullopt;
    return static_cast<std::uint32_t>(*number > 0 ? *number - 1 : count + *number);
}

// The parts of a corner "vertex/texture/normal", of which the last two may be empty or missing.
std::array<std::string_view, 3> parts_of(std::string_view corner) {
    std::array<std::string_view, 3> parts;
    for (std::string_view& part : parts) {
        const std::size_t slash = std::min(corner.find('/'), corner.size());
        part = corner.substr(0, slash);
        corner.remove_prefix(std::min(slash + 1, corner.size()));
    }
    return parts;
}

// In place of the indices of normals, of a face that has none.
constexpr std::uint32_t no_normal = 0xFFFFFFFF;

class ObjReader {
  public:
    ObjReader(const std::filesystem::path& path, std::string_view content, std::size_t most_triangles)
        : path_(path), words_(content), most_triangles_(most_triangles) {}

    MeshFile read() {
        support::ReadingPlace place;
        while (words_.next_line()) {
            place.reached(words_.offset());
            const std::string_view kind = words_.word();
            if (kind == "v")
                add_vertex();
            else if (kind == "vt")
                file_.texture.values.push_back(numbers_or_zero<2>());
            else if (kind == "vn")
                file_.normals.values.push_back(numbers_or_zero<3>());
            else if (kind == "f")
                add_face();
        }
        place.finished(words_.offset());
        drop_unless_complete(file_.texture, file_.mesh);
        fill_normals();
        if (file_.colors.values.size() != file_.mesh.vertices.size()) file_.colors = {};
        return std::move(file_);
    }

  private:
    [[noreturn]] void fail(std::string_view what) const {
        throw SceneError(path_.string(), fmt::format("{} (line {})", what, words_.number()));
    }

    // Programs write normals that are no numbers where faces have no area, and coordinates of one number.
    template <int count>
    glm::vec<count, float> numbers_or_zero() {
        glm::vec<count, float> p;
        for (int i = 0; i < count; ++i) p[i] = number_of<float>(words_.word()).value_or(0.0f);
        return p;
    }

    void add_vertex() {
        glm::vec3 p;
        for (int i = 0; i < 3; ++i) {
            const auto number = number_of<float>(words_.word());
            if (!number) fail("a vertex needs three numbers");
            p[i] = *number;
        }
        file_.mesh.vertices.push_back(p);
        // Behind the coordinates there may be a weight, or a colour.
        glm::vec3 color;
        for (int i = 0; i < 3; ++i) {
            const auto number = number_of<float>(words_.word());
            if (!number) return;
            color[i] = *number;
        }
        file_.colors.values.push_back(color);
    }

    // The next corner of a face; empty at its end. A backslash at a line's end continues it, # begins a comment.
    std::string_view next_corner() {
        std::string_view word = words_.word();
        while (word == "\\" && words_.next_line()) word = words_.word();
        return word.starts_with('#') ? std::string_view() : word;
    }

    // Faces without normals get normals of length 0 if others have some. If none has any, there are none.
    void fill_normals() {
        std::vector<glm::uvec3>& faces = file_.normals.triangles;
        const auto has_none = [](const glm::uvec3& t) { return t.x == no_normal; };
        if (std::ranges::all_of(faces, has_none)) {
            file_.normals = {};
        } else {
            const auto zero = static_cast<std::uint32_t>(file_.normals.values.size());
            file_.normals.values.emplace_back(0.0f);
            std::ranges::replace_if(faces, has_none, glm::uvec3(zero));
        }
    }

    void add_face() {
        vertices_.clear(), textures_.clear(), normals_.clear(), places_.clear();
        for (std::string_view word; !(word = next_corner()).empty();) {
            if (vertices_.size() == most_corners_of_face) fail("a face has more than a million corners");
            const auto [vertex, texture, normal] = parts_of(word);
            const auto index = index_of(vertex, file_.mesh.vertices.size());
            if (!index) fail("a face names a vertex that does not exist");
            vertices_.push_back(*index);
            places_.push_back(file_.mesh.vertices[*index]);
            if (const auto t = index_of(texture, file_.texture.values.size())) textures_.push_back(*t);
            if (const auto n = index_of(normal, file_.normals.values.size())) normals_.push_back(*n);
        }
        if (vertices_.size() < 3) fail("a face needs three vertices");
        const auto add = [](std::vector<glm::uvec3>& to, const glm::uvec3& corners,
                            const std::vector<std::uint32_t>& from) {
            to.emplace_back(from[corners.x], from[corners.y], from[corners.z]);
        };
        for (const glm::uvec3& corners : face_triangles(places_)) {
            add(file_.mesh.triangles, corners, vertices_);
            if (textures_.size() == vertices_.size()) add(file_.texture.triangles, corners, textures_);
            if (normals_.size() == vertices_.size())
                add(file_.normals.triangles, corners, normals_);
            else
                file_.normals.triangles.emplace_back(no_normal);
        }
        check_triangles(path_, file_.mesh, most_triangles_);
    }

    const std::filesystem::path& path_;
    Words words_;
    std::size_t most_triangles_;
    MeshFile file_;
    // Of the corners of a face.
    std::vector<std::uint32_t> vertices_, textures_, normals_;
    std::vector<glm::vec3> places_;
};

}  // namespace

MeshFile read_obj(const std::filesystem::path& path, std::string_view content, std::size_t most_triangles) {
    return ObjReader(path, content, most_triangles).read();
}

}  // namespace phasetree::io
