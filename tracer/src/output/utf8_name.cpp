#include "output/utf8_name.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "output/error.hpp"

namespace phasetree::tracer {

void require_utf8(const std::string& name) {
    const nlohmann::json json(name);
    try {
        (void)json.dump();
    } catch (const nlohmann::json::type_error&) {
        const std::string shown = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
        throw OutputNameError(
            fmt::format("the name {} is not UTF-8, so it cannot be written into a JSON file; rename the file", shown));
    }
}

}  // namespace phasetree::tracer
