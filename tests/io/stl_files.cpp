// STL files, text and binary.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "phasetree/io/mesh.hpp"
#include "support/written_files.hpp"
#include "tetrahedron_files.hpp"

namespace test_stl_files {

using namespace phasetree;
using namespace phasetree::tests;

TEST_CASE("STL files of words may have any white space and any case") {
    const auto read = [](const std::string& content) { return read_mesh_file("a.stl", content, 100).mesh; };
    const auto changed = [](auto&& change) {
        std::string text = word_stl();
        std::ranges::transform(text, text.begin(), change);
        return text;
    };
    const auto upper = [](char c) { return c >= 'a' && c <= 'z' ? char(c - 32) : c; };
    check_tetrahedron(read(changed([](char c) { return c == '\n' ? ' ' : c; })));  // all on one line
    check_tetrahedron(read(changed([](char c) { return c == ' ' ? '\n' : c; })));  // each word on its own
    check_tetrahedron(read(changed([](char c) { return c == '\n' ? '\r' : c; })));
    check_tetrahedron(read(changed(upper)));
    check_tetrahedron(read("\n  " + word_stl()));
    // Names of all words, and one solid behind the other on each line.
    std::string text = word_stl();
    check_tetrahedron(read(text.replace(6, 4, "facet vertex 1 outer loop endfacet")));
    check_tetrahedron(read("solid nothing\nendsolid vertex endfacet\n" + word_stl()));
    const std::string line = changed([](char c) { return c == '\n' ? ' ' : c; });
    CHECK(read(line + "\n" + line + line).triangles.size() == 12);
    // Two words that stand on one line in some files.
    const std::string facet =
        "solid a facet normal 0 0 1\nouter loop vertex 0 0 0\nvertex 1 0 0 vertex\n0 1 0 endloop "
        "endfacet\nendsolid";
    CHECK(read(facet).triangles.size() == 1);
    CHECK(read(facet).vertices[1] == glm::vec3(1, 0, 0));
}

TEST_CASE("binary STL files may have bytes behind their triangles, and any header") {
    const auto read = [](const std::string& content) { return read_mesh_file("a.stl", content, 100).mesh; };
    const auto with_header = [](std::string header) {
        header.resize(80);
        return header + binary_stl().substr(80);
    };
    for (const std::string header : {"solid", "made by hand", "solid facet normal 0 0 0\n", "SOLID\r\nvertex"})
        for (const std::string& more : {std::string(), std::string(37, '\0'), std::string("facet")})
            check_tetrahedron(read(with_header(header) + more));
    // Numbers without any byte that text has not, and a text whose number of triangles would be small.
    std::string letters = std::string("solid") + std::string(75, ' ') + bytes(std::uint32_t{1}) + std::string(50, 'A');
    CHECK(read(letters + "behind").triangles.size() == 1);
    const std::string name(80 - 6, 'n');
    CHECK(read("solid " + name + bytes(std::uint32_t{1}) +
               "\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 "
               "vertex 0 1 0\nendfacet\n")
              .vertices[1] == glm::vec3(1, 0, 0));
    const std::string no_stl =
        "a.stl: is not an STL file: its length does not match its number of triangles, and it does not begin with "
        "\"solid\"";
    const WrittenFiles files(read_mesh);
    CHECK(files.said("a.stl", with_header("solid").substr(0, 283)) == no_stl);
    CHECK(files.said("a.stl", with_header("made by hand").substr(0, 283)) == no_stl);
}

}  // namespace test_stl_files
