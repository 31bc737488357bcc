// The numbers in the text of a scene file, which the page shows as sliders. A number is identified by its JSON pointer
// (RFC 6901), such as "/tree/set/of/sphere/radius", which does not change when other lines of the file are edited.
#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "phasetree/io/document.hpp"

namespace phasetree::tracer::view {

struct NumberInText {
    std::string pointer;
    std::size_t line = 0;  ///< from 1
    double value = 0;      ///< in the file
};

/// Replacements of numbers. Pointers that do not refer to a number are ignored, because the file may have been saved
/// with other content.
using NumberEdits = std::map<std::string, double>;

struct TextNumbers {
    static constexpr std::size_t most = 5000;

    std::vector<NumberInText> numbers;  ///< in the order of the text, at most `most`, without the file's version
    bool has_more = false;              ///< whether there are more
    /// Maps the offset of a key in the text to the JSON pointer of its member, for each member whose value contains any
    /// of these numbers.
    std::unordered_map<std::size_t, std::string> members;
};

TextNumbers numbers_of(const Document&);

/// The text with these numbers replaced and everything else unchanged.
std::string with_numbers(const Document&, const NumberEdits&);

/// Maps an offset in with_numbers(), outside of numbers, to the offset in the document's own text.
std::size_t offset_in_original(const Document&, const NumberEdits&, std::size_t offset);

}  // namespace phasetree::tracer::view
