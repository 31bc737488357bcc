#pragma once

#include <span>
#include <string>
#include <string_view>

#include "command/errors.hpp"

namespace phasetree::tracer {

/// The error for an option that names a phase which is none of these; it says which was probably meant, or lists them.
UsageError unknown_phase(std::string_view option, std::string_view name, std::span<const std::string> phases);

}  // namespace phasetree::tracer
