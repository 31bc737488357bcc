#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <variant>

#include "phasetree/io/document.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree {

/// The position of a node in a scene file: the opening quote of its name.
struct NodePlace {
    std::string file;        ///< as returned by Document::name()
    std::size_t offset = 0;  ///< in bytes
    std::size_t line = 0;    ///< from 1
    std::size_t column = 0;  ///< from 1, in code points
};

/// Records the file position of every node that is read. Nodes are identified by address, and kept alive by this object
/// so that addresses stay unique.
class NodePlaces {
  public:
    using Node = std::variant<Field, Phased>;

    void add(const Node& node, const Document& document, std::size_t offset);
    /// Give a copy of a node the position of the original, if that is known. `of` is the address returned by
    /// Field::node() or Phased::node().
    void add_copy(const void* of, const Node& copy);
    /// The position of a node; nullopt if it was not read from a file.
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
