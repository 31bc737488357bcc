#include <fmt/format.h>

#include "phasetree/io/suggest.hpp"
#include "scene/parts.hpp"

namespace phasetree::tracer {

Value chosen(const Document& document, Value value, std::string_view what, std::span<const std::string_view> kinds) {
    std::string list;
    for (const std::string_view kind : kinds) list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", kind);
    if (!value.is_object())
        throw document.error(
            value, fmt::format("{} is an object {{\"kind\": {{…}}}}, where the kind is one of {}; this is {}", what,
                               list, name_of(value.kind())));
    if (value.size() != 1)
        throw document.error(
            value, fmt::format("{} has one member, named after its kind, but this has {}; the kinds are {}", what,
                               value.size(), list));
    const Value member = value[0];
    for (const std::string_view kind : kinds)
        if (member.key() == kind) return member;
    throw document.error(member.key_offset(),
                         fmt::format("{} of the kind \"{}\" does not exist; there are {}", what, member.key(), list),
                         closest(member.key(), kinds));
}

}  // namespace phasetree::tracer
