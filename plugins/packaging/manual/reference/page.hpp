// Pages of the reference, independent of their output format.
#pragma once

#include <string>
#include <vector>

#include "reference/header.hpp"

namespace phasetree::manual {

struct Page {
    std::vector<std::string> names;
    std::string summary;
    std::string header;    // its file's name
    std::string synopsis;  // code
    std::vector<Block> description;
    std::vector<Definition> parameters;
    std::vector<Block> result;         // of functions: what they return
    std::vector<Definition> errors;    // which errors mean what, where that is said
    std::vector<std::string> related;  // names with pages of their own
};

// Types and constants that are too small for pages of their own, by header.
struct Section {
    std::string header;
    std::string title;
    std::vector<const Page*> pages;
    std::vector<Entry> others;
};

struct Reference {
    std::string version;
    std::vector<Block> conventions;
    std::vector<Page> pages;
    std::vector<Section> sections;
};

// Throws a HeaderError that names everything that has no description, or one that does not fit what it describes.
Reference reference_of(const Header& conventions, const std::vector<Header>& headers, const std::string& version);

}  // namespace phasetree::manual
