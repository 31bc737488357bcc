// Reads the lines of an OBJ file that describe its surface and the values at the corners of its faces: v, vt, vn, f.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "io/geometry/absent_vertices.hpp"
#include "io/geometry/face_triangles.hpp"
#include "io/geometry/mesh_file.hpp"
#include "io/geometry/words.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree_support/reading.hpp"

namespace phasetree::io {

namespace {

// The index that a corner of a face refers to: a number from 1, or one that counts back from the last entry before the
// face.
std::optional<std::uint32_t> index_of(std::string_view word, std::size_t size, std::size_t before) {
    const auto number = number_of<std::int64_t>(word);
    const auto all = static_cast<std::int64_t>(size), back = static_cast<std::int64_t>(before);
    if (!number || *number == 0 || *number > all || *number < -back) return std::nullopt;
    return static_cast<std::uint32_t>(*number > 0 ? *number - 1 : back + *number);
}

// Whether a corner refers to an entry beyond `size`.
bool is_beyond(std::string_view word, std::size_t size) {
    const auto number = number_of<std::int64_t>(word);
    return number && *number > 0 && static_cast<std::uint64_t>(*number) > size;
}

// The parts of a corner "vertex/texture/normal"; the last two may be empty or missing.
std::array<std::string_view, 3> parts_of(std::string_view corner) {
    std::array<std::string_view, 3> parts;
    for (std::string_view& part : parts) {
        const std::size_t slash = std::min(corner.find('/'), corner.size());
        part = corner.substr(0, slash);
        corner.remove_prefix(std::min(slash + 1, corner.size()));
    }
    return parts;
}

// Replaces the index of a normal for faces without normals.
constexpr std::uint32_t no_normal = 0xFFFFFFFF;

// Replaces the colour of a vertex without colour; no file can contain this number.
const glm::vec3 no_color(std::numeric_limits<float>::quiet_NaN());

class ObjReader {
  public:
    ObjReader(const std::filesystem::path& path, std::string_view content, std::size_t max_triangles)
        : path_(path), words_(content, Words::Rules::obj), most_triangles_(max_triangles) {}

    MeshFile read() {
        while (words_.next_line()) {
            place_.reached(words_.offset());
            const std::string_view kind = words_.word();
            if (kind != "f") {
                if (!is_ahead_) add_values(kind);
                count(kind);
                continue;
            }
            const Words at_face = words_;
            if (add_face() || is_ahead_) continue;
            read_ahead();
            words_ = at_face;
            (void)add_face();
        }
        place_.finished(words_.offset());
        absent_.place(file_.mesh);
        drop_unless_complete(file_.texture, file_.mesh);
        fill_normals();
        fill_colors();
        return std::move(file_);
    }

  private:
    [[noreturn]] void fail(std::string_view what) const {
        throw SceneError(path_.string(), fmt::format("{} (line {})", what, words_.number()));
    }

    void add_values(std::string_view kind) {
        if (kind == "v")
            add_vertex();
        else if (kind == "vt")
            file_.texture.values.push_back(numbers_or_zero<2>(1, "a vt line needs a number"));
        else if (kind == "vn")
            file_.normals.values.push_back(numbers_or_zero<3>(3, "a vn line needs three numbers"));
    }
    void count(std::string_view kind) {
        for (std::size_t i = 0; i < kinds.size(); ++i) before_[i] += kind == kinds[i] ? 1u : 0u;
    }

    // Reads all vertices and their values up to the end of the file, because a face refers to one that follows it.
    void read_ahead() {
        while (words_.next_line()) {
            place_.reached(words_.offset());
            add_values(words_.word());
        }
        is_ahead_ = true;
    }

    // Programs write normals that are not numbers for faces without area, and texture coordinates with a single number.
    // But `least_words` words are required, because a shorter line would cost more memory than it has bytes.
    template <int count>
    glm::vec<count, float> numbers_or_zero(int least_words, std::string_view otherwise) {
        glm::vec<count, float> p;
        for (int i = 0; i < count; ++i) {
            const std::string_view word = words_.word();
            if (i < least_words && word.empty()) fail(otherwise);
            p[i] = number_of<float>(word).value_or(0.0f);
        }
        return p;
    }

    void add_vertex() {
        glm::vec3 p;
        for (int i = 0; i < 3; ++i) {
            const auto number = number_or_nan<float>(words_.word());
            if (!number) fail("a vertex needs three numbers");
            p[i] = *number;
        }
        absent_.add(file_.mesh, p);
        // The coordinates may be followed by a weight or a colour.
        glm::vec3 color;
        for (int i = 0; i < 3; ++i) {
            const auto number = number_of<float>(words_.word());
            if (!number) return;
            color[i] = *number;
        }
        file_.colors.values.resize(file_.mesh.vertices.size() - 1, no_color);
        file_.colors.values.push_back(color);
    }

    // If only some faces have normals, the others get normals of length 0. If none has, there are no normals.
    void fill_normals() {
        std::vector<glm::uvec3>& faces = file_.normals.triangles;
        if (faces.empty()) {
            file_.normals = {};
            return;
        }
        faces.resize(file_.mesh.triangles.size(), glm::uvec3(no_normal));
        const auto has_none = [](const glm::uvec3& t) { return t.x == no_normal; };
        const auto zero = static_cast<std::uint32_t>(file_.normals.values.size());
        file_.normals.values.emplace_back(0.0f);
        std::ranges::replace_if(faces, has_none, glm::uvec3(zero));
    }

    // Colours are kept only if all triangles have them. Unused vertices may lack them.
    void fill_colors() {
        std::vector<glm::vec3>& colors = file_.colors.values;
        if (colors.empty()) return;
        colors.resize(file_.mesh.vertices.size(), no_color);
        const auto has_none = [&](std::uint32_t vertex) { return std::isnan(colors[vertex].x); };
        const auto lacks_one = [&](const glm::uvec3& t) { return has_none(t.x) || has_none(t.y) || has_none(t.z); };
        if (std::ranges::any_of(file_.mesh.triangles, lacks_one))
            file_.colors = {};
        else
            std::ranges::replace_if(
                colors, [](const glm::vec3& c) { return std::isnan(c.x); }, glm::vec3(0));
    }

    enum class Corners { complete, too_few, named_later };

    // Reads the corners of a face. Programs write faces with too few corners for a triangle, for loose edges.
    Corners read_corners() {
        vertices_.clear(), textures_.clear(), normals_.clear(), places_.clear();
        for (std::string_view word; !(word = words_.word()).empty();) {
            if (vertices_.size() == most_corners_of_face) fail("a face has more than a million corners");
            const auto [vertex, texture, normal] = parts_of(word);
            const std::size_t of_texture = file_.texture.values.size(), of_normals = file_.normals.values.size();
            if (!is_ahead_ && (is_beyond(vertex, file_.mesh.vertices.size()) || is_beyond(texture, of_texture) ||
                               is_beyond(normal, of_normals)))
                return Corners::named_later;
            const auto index = index_of(vertex, file_.mesh.vertices.size(), before_[0]);
            if (!index) fail("a face refers to a vertex that does not exist");
            vertices_.push_back(*index);
            places_.push_back(file_.mesh.vertices[*index]);
            if (const auto t = index_of(texture, of_texture, before_[1])) textures_.push_back(*t);
            if (const auto n = index_of(normal, of_normals, before_[2])) normals_.push_back(*n);
        }
        if (vertices_.size() < 3) return Corners::too_few;
        if (std::ranges::any_of(vertices_, [&](std::uint32_t v) { return absent_.contain(v); }))
            fail(AbsentVertices::used);
        return Corners::complete;
    }

    // Returns false if the face refers to an entry that may follow it in the file.
    bool add_face() {
        if (const Corners corners = read_corners(); corners != Corners::complete) return corners == Corners::too_few;
        const auto add = [](std::vector<glm::uvec3>& to, const glm::uvec3& corners,
                            const std::vector<std::uint32_t>& from) {
            to.emplace_back(from[corners.x], from[corners.y], from[corners.z]);
        };
        const auto triangles = divider_.triangles(places_);
        if (!triangles) fail(FaceDivider::takes_too_long);
        const bool has_normals = normals_.size() == vertices_.size();
        if (has_normals) file_.normals.triangles.resize(file_.mesh.triangles.size(), glm::uvec3(no_normal));
        for (const glm::uvec3& corners : *triangles) {
            add(file_.mesh.triangles, corners, vertices_);
            if (textures_.size() == vertices_.size()) add(file_.texture.triangles, corners, textures_);
            if (has_normals) add(file_.normals.triangles, corners, normals_);
        }
        check_triangles(path_, file_.mesh, most_triangles_);
        return true;
    }

    static constexpr std::array<std::string_view, 3> kinds{"v", "vt", "vn"};

    const std::filesystem::path& path_;
    Words words_;
    std::size_t most_triangles_;
    support::ReadingPlace place_;
    MeshFile file_;
    AbsentVertices absent_;
    FaceDivider divider_;
    std::array<std::size_t, 3> before_{};  // the number of lines of each kind before this one
    bool is_ahead_ = false;                // whether all lines have been read
    // For the corners of a face:
    std::vector<std::uint32_t> vertices_, textures_, normals_;
    std::vector<glm::vec3> places_;
};

}  // namespace

MeshFile read_obj(const std::filesystem::path& path, std::string_view content, std::size_t max_triangles) {
    return ObjReader(path, content, max_triangles).read();
}

}  // namespace phasetree::io
