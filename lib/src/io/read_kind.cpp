#include "phasetree/io/read_kind.hpp"

#include <fmt/format.h>

#include "phasetree/io/meant_kind.hpp"
#include "phasetree/io/suggest.hpp"

namespace phasetree {

bool is_kind(Value member, std::string_view name) {
    return member.key() == name || is_other_spelling(member.key(), name);
}

namespace {

std::string list_of(std::span<const std::string_view> kinds) {
    std::string list;
    for (const std::string_view kind : kinds) list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", kind);
    return list;
}

}  // namespace

void check_kind(const Document& document, Value member, std::string_view what,
                std::span<const std::string_view> kinds) {
    for (const std::string_view kind : kinds)
        if (is_kind(member, kind)) return;
    throw document.error(
        member.key_offset(),
        fmt::format("{} cannot be of the kind \"{}\"; choose from {}", what, member.key(), list_of(kinds)),
        meant_kind(member.key(), kinds));
}

Value member_of_kind(const Document& document, Value value, std::string_view what,
                     std::span<const std::string_view> kinds) {
    const std::string list = list_of(kinds);
    if (!value.is_object())
        throw document.error(
            value, fmt::format("{} must be an object {{\"kind\": {{…}}}}, where the kind is one of {}, but is {}", what,
                               list, name_of(value.kind())));
    if (value.size() != 1)
        throw document.error(
            value, fmt::format("{} must have one member, named after its kind, but has {}; the kinds are {}", what,
                               value.size(), list));
    check_kind(document, value[0], what, kinds);
    return value[0];
}

SceneError located(ObjectReader& reader, const ParameterError& e) {
    reader.finish();  // a misspelt key explains why another one seems to be missing
    const Value value = reader.required_value(e.parameter());
    return reader.document().error(e.place() == ParameterError::Place::key ? value.key_offset() : value.offset(),
                                   e.what());
}

}  // namespace phasetree
