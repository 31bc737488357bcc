#pragma once

/// The examples of all nodes as objects, and the scenes of the gallery.

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "phasetree/io/tree.hpp"
#include "phasetree/nodes/fields/height_grid.hpp"
#include "source_directory.hpp"
#include "support/example_readers.hpp"

namespace phasetree::tests {

inline std::string content(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

/// Hills, for an image of heights.
inline HeightGrid hills() {
    HeightGrid grid{24, 20, {}};
    for (int y = 0; y < grid.height; ++y)
        for (int x = 0; x < grid.width; ++x)
            grid.values.push_back(0.5f + 0.3f * std::sin(0.9f * static_cast<float>(x)) *
                                             std::cos(0.7f * static_cast<float>(y)));
    return grid;
}

/// An example of scenes/nodes, in its studio.
inline Phased read_example(const std::filesystem::path& example) {
    const std::filesystem::path folder = source_directory() + "/scenes/nodes";
    const std::string mark = "@TREE@";
    std::string scene = content(folder / "studio.json");
    scene.replace(scene.find(mark), mark.size(), content(example));
    const auto read_hills = [](const std::filesystem::path&, const std::string&) { return hills(); };
    const FileReaders readers = example_readers().add<HeightGrid>({.read = read_hills});
    return read_tree(Document::from_text(scene, (folder / "studio.json").string()), readers).object;
}

inline std::vector<std::filesystem::path> examples() {
    std::set<std::filesystem::path> found;
    for (const char* kind : {"fields", "objects", "warps"})
        for (const auto& entry : std::filesystem::directory_iterator(source_directory() + "/scenes/nodes/" + kind))
            if (entry.path().extension() == ".json") found.insert(entry.path());
    return {found.begin(), found.end()};
}

/// A scene of the gallery.
inline Phased read_scene(const std::string& name) {
    const std::string file = source_directory() + "/scenes/" + name + ".json";
    return read_tree(Document::from_text(content(file), file)).object;
}

}  // namespace phasetree::tests
