#include "film/chosen_planes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace phasetree::tracer {

Planes::Choice chosen_planes(const std::vector<std::string>& names) {
    if (names == std::vector<std::string>{"all"}) return Planes::all();
    Planes::Choice choice = Planes::by_default();
    for (const std::string& name : names) {
        const auto found = std::ranges::find(Planes::names, name);
        if (found == Planes::names.end())
            throw std::invalid_argument(
                fmt::format("unknown plane \"{}\"; choose from {}, or \"all\"", name, fmt::join(Planes::names, ", ")));
        choice[static_cast<std::size_t>(found - Planes::names.begin())] = true;
    }
    return choice;
}

}  // namespace phasetree::tracer
