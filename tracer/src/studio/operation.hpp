// Operations on the JSON text of a scene file. They change what they must and keep everything else: comments, line
// breaks and the notation of numbers.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "phasetree/io/document.hpp"

namespace phasetree::tracer::studio {

class Vocabulary;

/// Replaces a value, or adds a member to an object.
struct SetValue {
    std::string pointer, to;  ///< `to` is a JSON text
};
/// Inserts before an item of an array ("/-" for the end), or adds a member to an object that must not have it.
struct InsertValue {
    std::string pointer, value;
};
struct RemoveValue {
    std::string pointer;
};
/// Removes a value and inserts it elsewhere. As in RFC 6902, `to` is resolved after the value has been removed.
struct MoveValue {
    std::string pointer, to;
};
/// Replaces a value by `in`, a JSON text in which a null stands for the value.
struct WrapValue {
    std::string pointer, in;
};
/// Replaces a value by one of its descendants.
struct UnwrapValue {
    std::string pointer, keep;
};
/// Renames a key, and with `references` all uses of it as the name of a phase or a shape.
struct RenameKey {
    std::string pointer, to;
    bool references = false;
};
/// Replaces the whole text, which need not be valid.
struct ReplaceText {
    std::string text;
};

using Operation =
    std::variant<SetValue, InsertValue, RemoveValue, MoveValue, WrapValue, UnwrapValue, RenameKey, ReplaceText>;

/// The name of an operation in requests, such as "set".
std::string_view name_of(const Operation& operation);

/// The text of a document after an operation. Throws SceneError if the operation is impossible. The error's position is
/// in the document, or in the operation's own JSON text.
std::string applied(const Document& document, const Operation& operation, const Vocabulary& vocabulary);

}  // namespace phasetree::tracer::studio
