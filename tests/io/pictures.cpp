// Every node has a picture in the reference, of an example that uses it. Both are made as scenes/nodes/render.sh says.

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "phasetree/io/tree.hpp"
#include "source_directory.hpp"
#include "support/example_readers.hpp"
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
    // A name with # stands for several images.
    const auto check = [](const std::filesystem::path& file) {
        if (file.string().find('#') == std::string::npos && !std::filesystem::exists(file))
            throw std::runtime_error("there is no such file");
    };
    const FileReaders readers = tests::example_readers(check);
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

/// Checks a node's example and picture, and adds both to the list of expected files.
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

/// Whether an example of the chapter names a file, with its number or with # instead of digits.
bool is_named_by_example(const std::string& chapter, std::string file) {
    std::string examples;
    for (const auto& entry : std::filesystem::directory_iterator(folder() / chapter))
        if (entry.path().extension() == ".json") examples += content(entry.path());
    const auto is_named = [&] { return examples.find('"' + file + '"') != std::string::npos; };
    if (is_named()) return true;
    for (char& c : file)
        if (c >= '0' && c <= '9') c = '#';
    return is_named();
}

}  // namespace

TEST_CASE("every node has a picture, of an example that uses it, and no picture is left of a node that went") {
    std::set<std::string> files;
    for_each_type(PlainFields(), [&]<class N>() { check_example("fields", N::info.name, files); });
    for_each_type(Objects(), [&]<class N>() { check_example("objects", N::info.name, files); });
    for_each_type(detail::Map<WarpedPhased, Warps>::type(),
                  [&]<class N>() { check_example("warps", N::info.name, files); });
    for (const char* chapter : {"fields", "objects", "warps"})
        for (const auto& entry : std::filesystem::directory_iterator(folder() / chapter)) {
            const std::string name = chapter + ("/" + entry.path().filename().string());
            CAPTURE(name);
            CHECK((files.contains(name) || is_named_by_example(chapter, name)));
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
