// Every node has a picture in the reference, of an example that uses it. Both are made as scenes/nodes/render.sh says.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "phasetree/io/tree.hpp"
#include "source_directory.hpp"
#include "tree/node.hpp"

namespace test_pictures {

using namespace phasetree;

namespace {

const std::filesystem::path& folder() {
    static const std::filesystem::path path = source_directory() + "/scenes/nodes";
    return path;
}

std::string content(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

/// The tree of an example as render.sh reads it: in the studio, instead of the mark.
Phased read_example(const std::filesystem::path& example) {
    const std::string mark = "@TREE@";
    std::string scene = content(folder() / "studio.json");
    scene.replace(scene.find(mark), mark.size(), content(example));
    const FileReaders readers{[](const std::filesystem::path& image) {
                                  if (!std::filesystem::exists(image)) throw std::runtime_error("no such file");
                                  return HeightGrid{2, 2, {0.f, 0.2f, 0.4f, 1.f}};  // this library knows no images
                              },
                              [](const std::filesystem::path& volume, const std::string&) {
                                  if (!std::filesystem::exists(volume)) throw std::runtime_error("no such file");
                                  return VoxelGrid::of_voxels("volume", {{1, 1, 1}, glm::dvec3(0), glm::dvec3(1)},
                                                              [](int, int, int) { return -1; });
                              },
                              [](const std::filesystem::path&, const std::string&) {
                                  LabelGrid grid;
                                  grid.lattice.size = {1, 1, 1};
                                  grid.numbers = {1};
                                  grid.voxels = {0};
                                  return grid;
                              },
                              nullptr,
                              [](const std::filesystem::path& font, const std::string&) {
                                  if (!std::filesystem::exists(font)) throw std::runtime_error("no such file");
                                  return TextOutlines{{{1, 1, {{0, 0, {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}}}}};
                              }};
    return read_tree(Document::from_text(scene, (folder() / "studio.json").string()), readers).object;
}

/// The names of all nodes in a tree, those that give a field and those that give an object apart.
struct NamesInTree {
    std::set<std::string_view> fields, objects;

    void add(const Field& f) {
        std::visit([&](const auto& node) { add(node, fields); }, f.node()->node);
    }
    void add(const Phased& a) {
        std::visit([&](const auto& node) { add(node, objects); }, a.node()->node);
    }

  private:
    template <class Node>
    void add(const Node& node, std::set<std::string_view>& names) {
        names.insert(Node::info.name);
        for_each_child(node, [&](const auto& child) { add(child); });
    }
};

/// Checks a node's example and picture, and enters both into the files that there should be.
void check_example(const std::string& chapter, std::string_view node, std::set<std::string>& files) {
    const std::string stem = chapter + "/" + std::string(node);
    CAPTURE(stem);
    const std::filesystem::path example = folder() / (stem + ".json"), picture = folder() / (stem + ".jpg");
    REQUIRE(std::filesystem::exists(example));
    CHECK_MESSAGE(std::filesystem::exists(picture), "scenes/nodes/render.sh renders it");
    CHECK(content(picture).substr(0, 2) == "\xFF\xD8");
    Phased tree;
    REQUIRE_NOTHROW(tree = read_example(example));
    NamesInTree names;
    names.add(tree);
    const bool is_in_fields = names.fields.contains(node), is_in_objects = names.objects.contains(node);
    CHECK((chapter == "fields" ? is_in_fields : chapter == "objects" ? is_in_objects : is_in_fields || is_in_objects));
    files.insert({stem + ".json", stem + ".jpg"});
}

}  // namespace

TEST_CASE("every node has a picture, of an example that uses it, and no picture is left of a node that went") {
    std::set<std::string> files{"fields/height_map.png", "fields/mesh.obj", "fields/volume.vdb",
                                "objects/particles.csv"};
    for (int layer = 0; layer < 16; ++layer) files.insert(fmt::format("objects/labels_{:02}.png", layer));
    for_each_type(PlainFields(), [&]<class N>() { check_example("fields", N::info.name, files); });
    for_each_type(Objects(), [&]<class N>() { check_example("objects", N::info.name, files); });
    for_each_type(detail::Map<WarpedPhased, Warps>::type(),
                  [&]<class N>() { check_example("warps", N::info.name, files); });
    for (const char* chapter : {"fields", "objects", "warps"})
        for (const auto& entry : std::filesystem::directory_iterator(folder() / chapter)) {
            const std::string name = chapter + ("/" + entry.path().filename().string());
            CAPTURE(name);
            CHECK(files.contains(name));
        }
}

TEST_CASE("the pictures of all nodes are below two megabytes") {
    std::uintmax_t bytes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder()))
        if (entry.path().extension() == ".jpg") bytes += entry.file_size();
    CHECK(bytes > 0);
    CHECK(bytes < 2'000'000);
}

}  // namespace test_pictures
