#include "parameters/named_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

std::string read_whole_file(const std::filesystem::path& path, std::uintmax_t max_bytes, std::string_view limit) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored))
        throw ParameterError("file", fmt::format("no such file {}", path.string()));
    if (!std::filesystem::is_regular_file(path, ignored))
        throw ParameterError("file", fmt::format("{} is not a regular file", path.string()));
    if (std::filesystem::file_size(path, ignored) > max_bytes)
        throw ParameterError("file", fmt::format("{} is larger than {}", path.string(), limit));
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream) throw ParameterError("file", fmt::format("cannot read {}", path.string()));
    return text.str();
}

}  // namespace phasetree::tracer
