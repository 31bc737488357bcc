#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "phasetree/io/error.hpp"

namespace phasetree::io {

/// What the parser expected when it failed.
enum class Expecting {
    document,     ///< nothing has been read yet
    first_key,    ///< after {
    first_item,   ///< after [
    colon,        ///< after a key
    next_member,  ///< after a member's value
    next_item,    ///< after an array's item
    end_of_file,  ///< after the document's single value
};

struct Failure {
    Expecting expecting = Expecting::document;
    std::size_t last_token = 0;         ///< begin …
    std::size_t last_token_end = 0;     ///< … and end of the last valid token
    bool last_is_word = false;          ///< whether that was a number, true, false or null
    std::optional<std::size_t> opened;  ///< the opening bracket of the innermost open array or object
};

/// Finds out what is wrong with a text, and where. The parser itself only reports that it is wrong.
SceneError diagnose(std::string_view name, std::string_view text, const Failure& failure);

}  // namespace phasetree::io
