// Parts of a scene that the view leaves out, while the file keeps them.
#pragma once

#include <string>
#include <vector>

#include "phasetree/io/document.hpp"
#include "studio/vocabulary.hpp"

namespace phasetree::tracer::studio {

/// The text without some nodes of the tree, reusable shapes, meshes and lights, given by their JSON pointers.
/// Everything else stays at the same offset. Pointers that refer to nothing are ignored.
///
/// Hidden items are removed from their lists. If a list becomes empty, or a node loses an operand that is not in a
/// list, the node is replaced by its main operand, such as the field from which another one is subtracted. If that is
/// hidden, the node is removed, too. Throws SceneError if nothing of the tree remains.
std::string text_without(const Document& document, const Vocabulary& vocabulary,
                         const std::vector<std::string>& hidden);

/// Returns the pointers of the same values after the text has changed. Values that cannot be found are dropped.
std::vector<std::string> pointers_after(const Document& before, const Document& after,
                                        const std::vector<std::string>& pointers);

}  // namespace phasetree::tracer::studio
