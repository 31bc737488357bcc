#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "phasetree/io/error.hpp"

namespace phasetree::io {

/// Where the parser stood when it could not go on.
enum class Expecting {
    document,     ///< nothing was read yet
    first_key,    ///< behind {
    first_item,   ///< behind [
    colon,        ///< behind a key
    next_member,  ///< behind a member's value
    next_item,    ///< behind an array's item
    end_of_file,  ///< behind the one value of the document
};

struct Failure {
    Expecting expecting = Expecting::document;
    std::size_t last_token = 0;         ///< begin and
    std::size_t last_token_end = 0;     ///< end of the last token that was good
    bool last_is_word = false;          ///< it was a number, true, false or null
    std::optional<std::size_t> opened;  ///< the bracket of the array or object that is open
};

/// The parser only says that the text is wrong; this finds out what is wrong, and where.
SceneError diagnose(std::string_view name, std::string_view text, const Failure& failure);

}  // namespace phasetree::io
