#include "studio/starts.hpp"

namespace phasetree::tracer::studio {

std::string StartFile::summary() const {
    constexpr std::string_view comment = "// ";
    if (!text.starts_with(comment)) return "";
    const std::string_view rest = text.substr(comment.size());
    return std::string(rest.substr(0, rest.find_first_of(".\n")));
}

}  // namespace phasetree::tracer::studio
