// The page's files, embedded into the program by the build (tracer/cmake/embed_files.cmake).
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
