// Reads the vertices and faces of a PLY file, and their attributes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <utility>

#include "io/geometry/absent_vertices.hpp"
#include "io/geometry/face_triangles.hpp"
#include "io/geometry/mesh_file.hpp"
#include "io/geometry/ply.hpp"
#include "phasetree/io/error.hpp"

namespace phasetree::io {

namespace {

/// The indices of some properties, such as x, y and z.
template <std::size_t count>
using Columns = std::array<std::size_t, count>;

/// The first of several sets of properties that an element has completely.
template <std::size_t count>
std::optional<Columns<count>> find(const Ply::Element& element,
                                   std::initializer_list<std::array<std::string_view, count>> sets) {
    for (const auto& names : sets) {
        Columns<count> columns{};
        std::size_t found = 0;
        for (const std::string_view name : names)
            if (const auto column = element.find(name)) columns[found++] = *column;
        if (found == count) return columns;
    }
    return std::nullopt;
}

/// The largest number of an integer type; 1 for other types.
double largest_of(Ply::Type type) {
    constexpr std::array<double, 8> largest{127, 255, 32767, 65535, 2147483647, 4294967295, 1, 1};
    return largest[static_cast<std::size_t>(type)];
}

class PlyReader {
  public:
    PlyReader(const std::filesystem::path& path, std::string_view content, std::size_t max_triangles)
        : path_(path), ply_(path, content), most_triangles_(max_triangles) {}

    MeshFile read() {
        bool has_vertices = std::ranges::none_of(ply_.elements(), is_of_vertices);
        std::vector<Later> later;
        for (const Ply::Element& element : ply_.elements()) {
            const bool is_of_triangles = element.name == "face" || element.name == "tristrips";
            if (is_of_triangles || is_of_vertices(element)) refuse_second(element);
            if (is_of_triangles && has_vertices) {
                read_triangles(ply_, element);
                continue;
            }
            if (is_of_triangles) later.push_back({ply_.second_reader(), element});
            if (!is_of_vertices(element)) {
                ply_.for_each_row(element, [](const Ply::Row&) {});
                continue;
            }
            read_vertices(element);
            has_vertices = true;
            for (Later& before : later) read_triangles(before.ply, before.element);
        }
        ply_.finish();
        absent_.place(file_.mesh);
        if (!file_.texture.triangles.empty()) drop_unless_complete(file_.texture, file_.mesh);
        return std::move(file_);
    }

  private:
    // Triangles that precede the vertices, and a reader positioned before them.
    struct Later {
        Ply ply;
        const Ply::Element& element;
    };

    static bool is_of_vertices(const Ply::Element& element) { return element.name == "vertex"; }

    template <std::size_t count>
    glm::vec<static_cast<int>(count), float> numbers(const Ply::Element& element, const Ply::Row& row,
                                                     const Columns<count>& columns) const {
        glm::vec<static_cast<int>(count), float> p;
        for (std::size_t i = 0; i < count; ++i)
            p[static_cast<int>(i)] = as_float(ply_, element, ply_.number(element, row, columns[i]));
        return p;
    }

    // A coordinate that is not a number, or too large, becomes NaN.
    glm::vec3 place_or_none(const Ply::Element& element, const Ply::Row& row, const Columns<3>& columns) const {
        glm::vec3 p;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::vector<double>& value = row[columns[i]];
            if (value.size() != 1) ply_.fail(element, "a coordinate must be a single number");
            const bool is_float = std::abs(value[0]) <= std::numeric_limits<float>::max();
            p[static_cast<int>(i)] = is_float ? static_cast<float>(value[0]) : std::numeric_limits<float>::quiet_NaN();
        }
        return p;
    }

    // Programs write normals that are not numbers for faces without area.
    static glm::vec3 normal_or_zero(const Ply::Row& row, const Columns<3>& columns) {
        glm::vec3 n(0);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::vector<double>& value = row[columns[i]];
            if (value.size() != 1 || !(std::abs(value[0]) <= std::numeric_limits<float>::max())) return glm::vec3(0);
            n[static_cast<int>(i)] = static_cast<float>(value[0]);
        }
        return n;
    }

    static float as_float(const Ply& ply, const Ply::Element& element, double value) {
        if (!(std::abs(value) <= std::numeric_limits<float>::max()))
            ply.fail(element, "a number is missing, or is too large");
        return static_cast<float>(value);
    }

    // A second list of the same name may lack what the first has, so that only some vertices would have it.
    void refuse_second(const Ply::Element& element) const {
        const auto is_same = [&](const Ply::Element& other) { return other.name == element.name; };
        if (std::ranges::count_if(ply_.elements(), is_same) > 1)
            throw SceneError(path_.string(), fmt::format("its header has two elements \"{}\"", element.name));
    }

    void read_vertices(const Ply::Element& element) {
        const auto place = find<3>(element, {{"x", "y", "z"}});
        const auto normal = find<3>(element, {{"nx", "ny", "nz"}});
        const auto color = find<3>(element, {{"red", "green", "blue"}});
        const auto texture = find<2>(element, {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}});
        if (!place) throw SceneError(path_.string(), "its vertices lack x, y or z");
        glm::vec3 white(1);
        for (int i = 0; color && i < 3; ++i)
            white[i] = static_cast<float>(largest_of(element.properties[(*color)[static_cast<std::size_t>(i)]].type));
        ply_.for_each_row(element, [&](const Ply::Row& row) {
            absent_.add(file_.mesh, place_or_none(element, row, *place));
            if (normal) file_.normals.values.push_back(normal_or_zero(row, *normal));
            if (texture) file_.texture.values.push_back(numbers(element, row, *texture));
            if (color) file_.colors.values.push_back(numbers(element, row, *color) / white);
        });
    }

    void read_triangles(Ply& ply, const Ply::Element& element) {
        const auto list =
            element.find("vertex_indices") ? element.find("vertex_indices") : element.find("vertex_index");
        const bool are_strips = element.name == "tristrips";
        if (!list)
            throw SceneError(path_.string(),
                             fmt::format("its {} lack vertex_indices", are_strips ? "triangle strips" : "faces"));
        if (are_strips)
            ply.for_each_row(element, [&](const Ply::Row& row) { read_strip(ply, element, row[*list]); });
        else
            read_faces(ply, element, *list);
    }

    void read_faces(Ply& ply, const Ply::Element& element, std::size_t list) {
        const auto texture = element.find("texcoord");
        // The values at face corners are more precise than those of the vertices, which are used if no face has a list.
        AtCorners<glm::vec2> of_vertices;
        if (texture) of_vertices = std::exchange(file_.texture, {});
        std::vector<glm::vec3> places;
        ply.for_each_row(element, [&](const Ply::Row& row) {
            const std::vector<double>& corners = row[list];
            if (corners.size() < 3) return;  // a loose vertex or edge
            read_places(ply, element, corners, places);
            const auto first = static_cast<std::uint32_t>(file_.texture.values.size());
            const bool has_texture = texture && row[*texture].size() == 2 * corners.size();
            if (has_texture)
                for (std::size_t i = 0; i < corners.size(); ++i)
                    file_.texture.values.emplace_back(as_float(ply, element, row[*texture][2 * i]),
                                                      as_float(ply, element, row[*texture][2 * i + 1]));
            const auto triangles = divider_.triangles(places);
            if (!triangles) ply.fail(element, FaceDivider::takes_too_long);
            const auto at = [&](std::uint32_t i) { return static_cast<std::uint32_t>(corners[i]); };
            for (const glm::uvec3& t : *triangles) {
                file_.mesh.triangles.emplace_back(at(t.x), at(t.y), at(t.z));
                if (has_texture) file_.texture.triangles.push_back(first + t);
            }
            check_triangles(path_, file_.mesh, most_triangles_);
        });
        if (!texture) return;
        if (file_.texture.empty())
            file_.texture = std::move(of_vertices);
        else
            drop_unless_complete(file_.texture, file_.mesh);
    }

    // The positions of a face's corners.
    void read_places(const Ply& ply, const Ply::Element& element, const std::vector<double>& corners,
                     std::vector<glm::vec3>& places) const {
        if (corners.size() > most_corners_of_face) ply.fail(element, "a face has more than a million corners");
        places.clear();
        for (const double c : corners) {
            const std::uint32_t vertex = vertex_of(ply, element, c, "a face refers to a vertex that does not exist");
            if (absent_.contain(vertex)) ply.fail(element, AbsentVertices::used);
            places.push_back(file_.mesh.vertices[vertex]);
        }
    }

    std::uint32_t vertex_of(const Ply& ply, const Ply::Element& element, double index,
                            std::string_view otherwise) const {
        if (!(index >= 0 && index < static_cast<double>(file_.mesh.vertices.size()))) ply.fail(element, otherwise);
        return static_cast<std::uint32_t>(index);
    }

    // From the third corner on, each corner forms a triangle with the two before it, and every other triangle of a
    // strip is flipped. A corner of −1 begins a new strip. Programs repeat corners to continue elsewhere; those
    // triangles have no area.
    void read_strip(const Ply& ply, const Ply::Element& element, const std::vector<double>& corners) {
        glm::uvec3 last{};
        std::size_t count = 0;
        for (const double corner : corners) {
            if (corner == -1) {
                count = 0;
                continue;
            }
            const std::uint32_t vertex =
                vertex_of(ply, element, corner, "a triangle strip refers to a vertex that does not exist");
            last = {last.y, last.z, vertex};
            if (++count < 3 || last.x == last.y || last.y == last.z || last.z == last.x) continue;
            for (int i = 0; i < 3; ++i)
                if (absent_.contain(last[i])) ply.fail(element, AbsentVertices::used);
            file_.mesh.triangles.push_back(count % 2 == 1 ? last : glm::uvec3(last.y, last.x, last.z));
            check_triangles(path_, file_.mesh, most_triangles_);
        }
    }

    const std::filesystem::path& path_;
    Ply ply_;
    std::size_t most_triangles_;
    MeshFile file_;
    AbsentVertices absent_;
    FaceDivider divider_;
};

}  // namespace

MeshFile read_ply(const std::filesystem::path& path, std::string_view content, std::size_t max_triangles) {
    return PlyReader(path, content, max_triangles).read();
}

}  // namespace phasetree::io
