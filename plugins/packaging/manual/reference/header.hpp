// What a header of the C99 interface declares, and what it says of it.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "reference/comment.hpp"

namespace phasetree::manual {

enum class Kind { function, structure, enumeration, type, macro };

struct Declaration {
    Kind kind;
    std::string name;
    std::string text;                     // as in the header; of functions without what is not their type, in one line
    std::string result;                   // of functions: the type returned
    std::vector<std::string> parameters;  // of functions: their names
};

// Declarations one directly below another, and the comment above the first of them, which is for all.
struct Entry {
    std::vector<Declaration> declarations;
    std::vector<Block> comment;
    int line = 0;
};

struct Header {
    std::string file;
    std::vector<std::string> includes;  // of the interface's own headers, their files
    std::vector<Block> comment;         // at its head
    std::vector<Entry> entries;
};

class HeaderError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// The headers are written in one manner (clang-format's), so this reads that one and says where it meets another.
Header read_header(const std::filesystem::path& path);

}  // namespace phasetree::manual
