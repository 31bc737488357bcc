// Finds files beside a scene that its parameters may name.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace phasetree::tracer::studio {

struct SceneFiles {
    static constexpr std::size_t most = 500;            ///< files in the answer
    static constexpr std::size_t most_visited = 20000;  ///< entries of folders
    static constexpr int most_levels = 6;               ///< of nested folders

    std::vector<std::string> names;  ///< relative to the scene's folder, sorted
    bool has_more = false;           ///< whether there are more, or the folder is too large to be searched
};

/// The files in a scene's folder and its subfolders that a kind, such as "ies" of the type "light", can read, judging
/// by their extensions. Hidden files, and links that lead out of the folder, are left out.
SceneFiles files_for(const std::filesystem::path& scene, std::string_view type, std::string_view kind);

}  // namespace phasetree::tracer::studio
