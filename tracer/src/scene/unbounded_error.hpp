#pragma once

#include <string_view>

#include "phasetree/io/document.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree/io/node_places.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree::tracer {

/// The error for an unbounded tree of the document: at the first node that makes it unbounded, with the positions of
/// the others. `before` precedes the message.
SceneError unbounded_error(const Document& document, const Phased& tree, const NodePlaces& places,
                           std::string_view before = {});

/// The same for the document's single "tree", which is read again to find the positions of its nodes.
SceneError unbounded_error(const Document& document);

/// The error for a ModelError about the scene's object: at the node that makes it unbounded, if that is the reason, and
/// otherwise at `value`.
SceneError object_error(const Document& document, Value value, const ModelError& error);

}  // namespace phasetree::tracer
