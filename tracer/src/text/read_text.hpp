// A text as a font draws it, for the node `text`. HarfBuzz lays it out: it knows which letters belong closer together,
// which are joined, and in which direction a script runs.
#pragma once

#include <filesystem>
#include <string>

#include "phasetree/nodes/profiles/text_outlines.hpp"

namespace phasetree::tracer {

// `text` is UTF-8; \n begins another line. Whatever is wrong is std::runtime_error "cannot use the font "<path>": …",
// which quotes nothing of the file; a letter that the font does not have is.
TextOutlines read_text(const std::filesystem::path& font, const std::string& text);

// Whether this program was built with HarfBuzz.
bool can_read_fonts();

// HarfBuzz's version; empty if this program was built without it.
std::string harfbuzz_version();

}  // namespace phasetree::tracer
