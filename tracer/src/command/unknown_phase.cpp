#include "command/unknown_phase.hpp"

#include <fmt/format.h>

#include "phasetree/io/suggest.hpp"

namespace phasetree::tracer {

UsageError unknown_phase(std::string_view option, std::string_view name, std::span<const std::string> phases) {
    const auto meant = closest(name, phases);
    return UsageError(
        fmt::format("{}: unknown phase \"{}\"{}", option, name,
                    meant ? fmt::format(" (did you mean \"{}\"?)", *meant) : valid_names("phase", phases)));
}

}  // namespace phasetree::tracer
