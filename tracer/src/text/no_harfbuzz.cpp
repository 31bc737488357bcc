// Replaces harfbuzz.cpp in builds without the library.
#include <stdexcept>

#include "text/read_text.hpp"

namespace phasetree::tracer {

TextOutlines read_text(const std::filesystem::path& font, const std::string&) {
    throw std::runtime_error("cannot use the font \"" + font.string() +
                             "\": this phasetree was built without HarfBuzz; install libharfbuzz-dev, or the library "
                             "from harfbuzz.github.io, and rebuild");
}

bool can_read_fonts() {
    return false;
}

std::string harfbuzz_version() {
    return "";
}

}  // namespace phasetree::tracer
