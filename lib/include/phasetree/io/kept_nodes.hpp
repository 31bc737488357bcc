#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>

#include "phasetree/model/handle.hpp"

namespace phasetree {

/// The nodes that an earlier reading of a scene made from files, such as networks, meshes and scans, for one that reads
/// the scene again and again while people change it: a node whose parameters and whose file are what they were is
/// taken as it was made, and neither is its file read nor what it derives from it derived again. A document that is to
/// be read so is made by Document::with_kept_nodes(). One reading at a time uses it.
///
/// A file is known to be the same by its path, inode, size and time of change. One that was saved less than a second
/// before it was read is read again the next time, because it may be saved twice within the clock's resolution.
class KeptNodes {
  public:
    struct Node {
        std::variant<Field, Phased> handle;
        std::uint64_t steps = 0;  ///< that making it took of the reading's budget of work, and takes again
    };
    /// What a node was made from.
    struct Source {
        std::string parameters;  ///< the node's name, its parameters and the path of its file
        std::string state;       ///< of the file
    };

    /// A reading begins: it may take what the ones before left.
    void start();
    /// It ended well: forgets what it had no use for.
    void finish();

    /// The node that an earlier reading made of this. It is given once, because nodes at two places of a scene are two.
    std::optional<Node> take(const Source& source);
    /// Keeps a node for the readings after this.
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
