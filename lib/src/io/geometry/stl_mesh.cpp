// Reads binary and text STL files.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "io/geometry/mesh_file.hpp"
#include "io/geometry/words.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree_support/reading.hpp"

namespace phasetree::io {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers of STL files are little-endian");

constexpr std::size_t header_bytes = 80, head_bytes = header_bytes + 4, triangle_bytes = 50, normal_bytes = 12;
constexpr const char* no_point = "a vertex has a coordinate that is not a number, or too large";

bool is_word(std::string_view word, std::string_view lower_case) {
    return std::ranges::equal(word, lower_case, {}, [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
}

bool begins_with_solid(std::string_view content) {
    const std::string_view first = Words(content).word_of_any_line();
    return is_word(first.substr(0, 5), "solid");
}

// Whether the first kilobyte after the header contains a character that does not occur in text.
bool has_control_characters(std::string_view content) {
    const auto is_control = [](unsigned char c) { return c < ' ' && (c < '\t' || c > '\r'); };
    return content.size() > head_bytes && std::ranges::any_of(content.substr(head_bytes, 1024), is_control);
}
bool has_facet(std::string_view content) {
    Words words(content);
    for (std::string_view word; !(word = words.word_of_any_line()).empty();)
        if (is_word(word, "facet") || is_word(word, "endfacet")) return true;
    return false;
}

std::uint32_t claimed_triangles(std::string_view content) {
    std::uint32_t count;
    std::memcpy(&count, content.data() + header_bytes, sizeof count);
    return count;
}

// A binary file is at least as long as implied by its number of triangles. Programs write headers that begin with
// "solid", and bytes after the triangles. Text is never mistaken for a binary file: four of its characters, read as a
// number, give more than a hundred million triangles, because text contains no smaller control characters.
bool is_binary(std::string_view content) {
    if (content.size() < head_bytes) return false;
    const std::uint64_t count = claimed_triangles(content);
    if (content.size() < head_bytes + count * triangle_bytes) return false;
    if (!begins_with_solid(content)) return count > 0 || content.size() == head_bytes;
    return count > 0 && (has_control_characters(content) || !has_facet(content.substr(head_bytes)));
}

void add_triangle(TriangleMesh& mesh, const glm::vec3 (&corners)[3]) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), std::begin(corners), std::end(corners));
    mesh.triangles.push_back({first, first + 1, first + 2});
}

TriangleMesh read_binary(const std::filesystem::path& path, std::string_view content) {
    TriangleMesh mesh;
    support::ReadingPlace place;
    const std::uint32_t count = claimed_triangles(content);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = head_bytes + i * triangle_bytes;
        place.reached(at);
        glm::vec3 corners[3];
        std::memcpy(corners, content.data() + at + normal_bytes, sizeof corners);
        for (const glm::vec3& p : corners)
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                throw SceneError(path.string(), fmt::format("{} (triangle {})", no_point, i + 1));
        add_triangle(mesh, corners);
    }
    place.finished(content.size());
    return mesh;
}

/// Reads text STL files. Words may be split across lines in any way, in either case.
class TextReader {
  public:
    TextReader(const std::filesystem::path& path, std::string_view content) : path_(path), words_(content) {}

    TriangleMesh read() {
        (void)words_.word_of_any_line();  // solid
        pass_name();
        for (std::string_view word; !(word = words_.word_of_any_line()).empty(); place_.reached(words_.offset())) {
            if (is_word(word, "vertex"))
                read_vertex();
            else if (is_word(word, "endfacet"))
                end_facet();
            else if (is_word(word, "solid") || is_word(word, "endsolid"))
                pass_name();
        }
        if (count_ != 0) fail("the file ends within a facet", words_.number());
        place_.finished(words_.offset());
        return std::move(mesh_);
    }

  private:
    [[noreturn]] void fail(std::string_view what, std::size_t line) const {
        throw SceneError(path_.string(), fmt::format("{} (line {})", what, line));
    }

    // Skips the name after "solid" or "endsolid". The name is the rest of the line, and may contain any words. But if a
    // whole facet begins on the line, as in files without line ends, the name ends before the facet.
    void pass_name() {
        Words ahead = words_;
        for (std::string_view word; !(word = ahead.word()).empty();) {
            if (!is_word(word, "facet")) continue;
            if (!begins_facet(ahead)) continue;
            words_ = ahead;
            return;
        }
        words_.pass_line();
    }
    // Whether a normal and the first "vertex" follow "facet" on the line.
    static bool begins_facet(Words words) {
        if (!is_word(words.word(), "normal")) return false;
        for (int i = 0; i < 3; ++i)
            if (!number_or_nan<float>(words.word())) return false;
        return is_word(words.word(), "outer") && is_word(words.word(), "loop") && is_word(words.word(), "vertex");
    }

    void read_vertex() {
        const std::size_t line = words_.number();
        if (count_ == 3) fail("a facet has more than three vertices", line);
        for (int i = 0; i < 3; ++i) {
            const auto number = number_or_nan<float>(words_.word_of_any_line());
            if (!number) fail("a vertex needs three numbers", line);
            if (std::isnan(*number)) fail(no_point, line);
            corners_[count_][i] = *number;
        }
        ++count_;
    }
    void end_facet() {
        if (count_ != 3) fail("a facet has fewer than three vertices", words_.number());
        add_triangle(mesh_, corners_);
        count_ = 0;
    }

    const std::filesystem::path& path_;
    Words words_;
    support::ReadingPlace place_;
    TriangleMesh mesh_;
    glm::vec3 corners_[3];
    std::size_t count_ = 0;  // number of corners so far
};

}  // namespace

MeshFile read_stl(const std::filesystem::path& path, std::string_view content) {
    if (is_binary(content)) return {read_binary(path, content), {}, {}, {}};
    TriangleMesh mesh;
    const bool is_text = begins_with_solid(content);
    if (is_text) mesh = TextReader(path, content).read();
    // A binary file may begin with "solid", and may be truncated.
    if (!is_text || (mesh.triangles.empty() && has_control_characters(content)))
        throw SceneError(path.string(),
                         "is not an STL file: its length does not match its number of triangles, and it does not begin "
                         "with \"solid\"");
    return {std::move(mesh), {}, {}, {}};
}

}  // namespace phasetree::io
