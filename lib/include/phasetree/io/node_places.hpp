#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <variant>

#include "phasetree/io/document.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree {

/// Where a node stands in a scene file: at the quote before its name.
struct NodePlace {
    std::string file;        ///< as Document::name() gives it
    std::size_t offset = 0;  ///< in bytes
    std::size_t line = 0;    ///< from 1
    std::size_t column = 0;  ///< from 1, in code points
};

/// Remembers for each node of the trees that are read where it stands. Nodes are known by their addresses, and live as
/// long as this does, so that no other node comes to be where one of them was.
class NodePlaces {
  public:
    using Node = std::variant<Field, Phased>;

    void add(const Node& node, const Document& document, std::size_t offset);
    /// The copy was made of a node and stands where that stands, if it is known where. Addresses are those of
    /// Field::node() and Phased::node().
    void add_copy(const void* of, const Node& copy);
    /// Nothing for a node that was made otherwise, as by the program itself.
    std::optional<NodePlace> find(const void* node) const;

  private:
    struct Place {
        Node node;
        Document document;
        std::size_t offset;
    };
    std::unordered_map<const void*, Place> places_;
};

}  // namespace phasetree
