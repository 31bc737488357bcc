#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>

#include "phasetree/io/document.hpp"

namespace phasetree {

/// Where a node stands in a scene file: at the quote before its name.
struct NodePlace {
    std::string file;        ///< as Document::name() gives it
    std::size_t offset = 0;  ///< in bytes
    std::size_t line = 0;    ///< from 1
    std::size_t column = 0;  ///< from 1, in code points
};

/// Remembers for each node of the trees that are read where it stands, while the nodes live: they are known by their
/// addresses.
class NodePlaces {
  public:
    /// `node` is Field::node() or Phased::node().
    void add(const void* node, const Document& document, std::size_t offset) {
        places_.insert_or_assign(node, Place{document, offset});
    }
    /// Nothing for a node that was made otherwise, as by the program itself.
    std::optional<NodePlace> find(const void* node) const;

  private:
    struct Place {
        Document document;
        std::size_t offset;
    };
    std::unordered_map<const void*, Place> places_;
};

}  // namespace phasetree
