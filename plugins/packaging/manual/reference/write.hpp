// The reference as files.
#pragma once

#include <filesystem>

#include "reference/page.hpp"

namespace phasetree::manual {

// One manual page of section 3 for each page, another for what is not said again, and links for further names.
void write_man(const Reference& reference, const std::filesystem::path& folder);

// All of it as one page of HTML.
void write_html(const Reference& reference, const std::filesystem::path& file);

}  // namespace phasetree::manual
