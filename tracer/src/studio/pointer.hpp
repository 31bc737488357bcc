// JSON pointers (RFC 6901), such as "/tree/over/1/set/phase".
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "phasetree/io/document.hpp"

namespace phasetree::tracer::studio {

/// Escapes a key for use in a pointer: '~' becomes "~0" and '/' becomes "~1".
std::string escaped(std::string_view key);

/// A pointer's keys and indices, unescaped. The empty pointer refers to the whole document.
using PointerTokens = std::vector<std::string>;

/// Throws std::invalid_argument, with a message for the user, if the text is not a valid pointer.
PointerTokens pointer_tokens(std::string_view pointer);

/// The pointer with these tokens.
std::string pointer_of(const PointerTokens& tokens);

/// The index that a token stands for: digits without leading zeros. nullopt for anything else.
std::optional<std::size_t> index_of(std::string_view token);

/// "1 item", "3 items"
std::string count_of_items(std::size_t count);

/// The child of a value; nullopt if there is none.
std::optional<Value> child_of(Value value, std::string_view token);

/// The value that a pointer refers to. If there is none, throws a SceneError whose position is that of the deepest
/// value that exists on the path. Throws std::invalid_argument if the text is not a pointer.
Value value_at(const Document&, std::string_view pointer);

}  // namespace phasetree::tracer::studio
