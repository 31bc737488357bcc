// Complete scenes to start from, embedded into the program by the build (tracer/cmake/embed_files.cmake).
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace phasetree::tracer::studio {

struct StartFile {
    std::string_view name;  ///< such as "glass.json"
    std::string_view text;

    /// "glass"
    std::string_view stem() const { return name.substr(0, name.rfind('.')); }
    /// The first sentence of the comment at the beginning, without a full stop.
    std::string summary() const;
};

/// In alphabetical order.
std::span<const StartFile> start_files();

}  // namespace phasetree::tracer::studio
