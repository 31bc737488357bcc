#pragma once

#include "io/document_data.hpp"

namespace phasetree::io {

/// Parses data.text into the rest of data. SceneError if it is no JSON text as Document describes it.
void parse(DocumentData& data);

}  // namespace phasetree::io
