// Clear substances with measured dispersion, by name.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "spectrum/dispersion.hpp"

namespace phasetree::tracer {

struct Glass {
    std::string_view name;
    Dispersion dispersion;
};

/// All of them, in alphabetical order.
std::span<const Glass> glasses();

std::optional<Glass> find_glass(std::string_view name);

}  // namespace phasetree::tracer
