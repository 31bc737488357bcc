// Comments of headers as paragraphs and lists.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace phasetree::manual {

// A line "name, name   text" of a comment, with at least two spaces between, and the lines below it that are indented
// more.
struct Definition {
    std::vector<std::string> terms;
    std::string text;
};

// A paragraph, or else a list.
struct Block {
    std::string text;
    std::vector<Definition> definitions;
};

// A comment in the form "/* … */", each further line of which may begin with a star. Lines end paragraphs only where
// they are empty.
std::vector<Block> blocks_of(std::string_view comment);

// The first sentence without its full stop, or what is before a colon or semicolon in it.
std::string summary_of(const std::vector<Block>& blocks);

// The sentences of a paragraph.
std::vector<std::string> sentences_of(const std::string& text);

}  // namespace phasetree::manual
