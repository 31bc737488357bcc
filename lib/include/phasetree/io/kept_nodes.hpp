#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>

#include "phasetree/model/handle.hpp"

namespace phasetree {

/// A cache of nodes that were made from files, such as networks, meshes and scans. It makes re-reading a scene fast
/// while someone edits it: a node with unchanged parameters and an unchanged file is reused without reading the file
/// again. Pass it to Document::with_kept_nodes().
///
/// A file counts as unchanged if its path, inode, size and modification time are unchanged. A file saved less than a
/// second before it was read is read again next time, because it may be saved twice within the clock's resolution.
///
/// Not thread-safe: only one reading at a time may use a cache.
class KeptNodes {
  public:
    struct Node {
        std::variant<Field, Phased> handle;
        /// The work of making the node. On reuse, it counts again towards the limit of the work per reading, so that
        /// the limit does not depend on what was kept.
        std::uint64_t steps = 0;
    };
    /// What a node was made from.
    struct Source {
        std::string parameters;  ///< the node's name, its parameters and the path of its file
        std::string state;       ///< of the file
    };

    /// Start a reading, in which take() returns the nodes that earlier readings kept.
    void start();
    /// Finish a successful reading, and drop all nodes that it did not use.
    void finish();

    /// Take the node that an earlier reading made from this source. Each node is returned only once, because nodes at
    /// two places in a scene are distinct.
    std::optional<Node> take(const Source& source);
    /// Keep a node for later readings.
    void keep(const Source& source, Node node);

  private:
    struct Entry {
        std::string state;
        Node node;
    };
    using Entries = std::multimap<std::string, Entry>;

    Entries before_, now_;
};

}  // namespace phasetree
