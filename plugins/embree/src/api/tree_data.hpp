#pragma once

#include <optional>

#include "api/errors.hpp"
#include "api/handles.hpp"
#include "phasetree/reading/tree.hpp"

namespace phasetree::embree::api {

/// What is behind a PhasetreeTree: the model, and the text that it was read from, for edits.
struct TreeData {
    Document document;
    std::optional<PhasetreeFileReader> reader;
    SceneTree tree;
};

using TreeTable = HandleTable<TreeData, 0x5054>;

/// Throws for a handle that is none.
const TreeData& data_of(PhasetreeTree handle);

/// A scene's text with the value at a JSON Pointer (RFC 6901) replaced. Throws ApiError if there is no such value.
std::string with_value(const Document&, std::string_view pointer, std::string_view value);

}  // namespace phasetree::embree::api
