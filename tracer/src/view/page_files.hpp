// The page's files, which the build puts into the program (tracer/cmake/embed_files.cmake).
#pragma once

#include <span>
#include <string_view>

namespace phasetree::tracer::view {

struct PageFile {
    std::string_view name;
    std::string_view text;
};

std::span<const PageFile> page_files();

}  // namespace phasetree::tracer::view
