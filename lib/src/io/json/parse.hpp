#pragma once

#include "io/json/document_data.hpp"

namespace phasetree::io {

/// Parses data.text into the other members of data. Throws SceneError unless it is JSON text as described by Document.
void parse(DocumentData& data);

}  // namespace phasetree::io
