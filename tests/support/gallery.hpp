// The scenes of the gallery, for tests of the library alone.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include "phasetree/io/document.hpp"
#include "source_directory.hpp"

namespace phasetree::tests {

// The scenes whose trees the library can read by itself, because only the path tracer reads images and fonts.
inline std::vector<std::filesystem::path> gallery_of_the_library() {
    constexpr std::array<std::string_view, 3> read_by_the_tracer{"\"height_map\"", "\"labels\"", "\"text\""};
    std::vector<std::filesystem::path> all;
    for (const auto& entry : std::filesystem::directory_iterator(source_directory() + "/scenes")) {
        if (entry.path().extension() != ".json" || entry.path().stem() == "scene.schema") continue;
        const Document document = Document::from_file(entry.path());
        const auto names = [&](std::string_view node) { return document.text().find(node) != std::string::npos; };
        if (std::ranges::none_of(read_by_the_tracer, names)) all.push_back(entry.path());
    }
    return all;
}

}  // namespace phasetree::tests
