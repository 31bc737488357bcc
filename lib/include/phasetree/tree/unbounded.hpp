#pragma once

#include <string>
#include <variant>
#include <vector>

#include "phasetree/model/handle.hpp"

namespace phasetree {

/// A node that makes an object unbounded.
struct UnboundedPart {
    std::variant<Field, Phased> node;
    std::string kind;  ///< name of the node, such as "plane"
    std::string path;  ///< the names and parameters from the root to the node: `set.of.union.of[1].plane`
};

/// Find up to three nodes that make an object unbounded. The result is empty if the object is bounded.
///
/// The search descends to a child if its parent is unbounded because of it: that is, if the parent remains unbounded
/// when a ball replaces each of its other children. A node without such a child is itself responsible. For example, a
/// union of a box and a plane is unbounded because of the plane, but an intersection of two planes because of neither.
std::vector<UnboundedPart> unbounded_parts(const Phased&);
std::vector<UnboundedPart> unbounded_parts(const Field&);

/// Thrown for an object that must be bounded but is not. what() names the unbounded parts by their paths.
class UnboundedError : public ModelError {
  public:
    explicit UnboundedError(const std::vector<UnboundedPart>& parts);
};

/// How to bound a part, to complete an error message: `intersect it with a box: {"intersection": …}`.
std::string how_to_bound(const UnboundedPart&);

}  // namespace phasetree
