// The numbers in the text of the scene's file, which the page shows as sliders. A number is known by its JSON pointer
// (RFC 6901), as "/tree/set/of/sphere/radius", which stays the same while other lines of the file are edited.
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
    double value = 0;      ///< as the file has it
};

/// What is to stand instead of some numbers. Pointers to nothing, or to what is no number, count for nothing: the file
/// may be saved with others.
using NumberEdits = std::map<std::string, double>;

struct TextNumbers {
    static constexpr std::size_t most = 5000;

    std::vector<NumberInText> numbers;  ///< in the order of the text, but for the file's version; `most` at most
    bool has_more = false;              ///< than these
    /// By where its key begins: the pointer of each member of an object that has numbers among these in it.
    std::unordered_map<std::size_t, std::string> members;
};

TextNumbers numbers_of(const Document&);

/// The text with the numbers replaced, and all else as it was.
std::string with_numbers(const Document&, const NumberEdits&);

/// Where in the document's own text that stands which is at an offset of with_numbers(), and is no number.
std::size_t offset_without_numbers(const Document&, const NumberEdits&, std::size_t offset);

}  // namespace phasetree::tracer::view
