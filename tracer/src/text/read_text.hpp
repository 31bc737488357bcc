// Outlines of a text in a font, for the node `text`. HarfBuzz shapes the text: it handles kerning, ligatures and the
// direction of scripts.
#pragma once

#include <filesystem>
#include <string>

#include "phasetree/nodes/profiles/text_outlines.hpp"

namespace phasetree::tracer {

// `text` is UTF-8; \n starts a new line. All errors are std::runtime_error "cannot use the font "<path>": …". The
// message never quotes the file, but it does quote a letter that the font lacks.
TextOutlines read_text(const std::filesystem::path& font, const std::string& text);

// Whether this build includes HarfBuzz.
bool can_read_fonts();

// HarfBuzz's version; empty if this build does not include it.
std::string harfbuzz_version();

}  // namespace phasetree::tracer
