// The studio's requests and answers, as JSON.
#pragma once

#include <string>

#include "studio/edited_document.hpp"

namespace phasetree::tracer::studio {

/// {"base": 3, "label": "Move the sphere", "merge": "drag-17", "strict": false, "operations": [{"set": "/tree/…",
/// "to": "0.5"}, …]}. Throws SceneError.
EditRequest read_edit_request(const std::string& text);

/// The answer to GET /document, as one line. Leaves out the text and its outline if DocumentState::text_version equals
/// `known`, because the page then has the text already.
std::string written(const DocumentState& state, const EditedDocument& of, std::uint64_t known = 0);

/// {"error": {"message": …, "line": …, "column": …}}. Line and column are null unless the error is in this file.
std::string written(const SceneError& error, const std::string& file);

/// {"version": 7}
std::string written_version(std::uint64_t version);

}  // namespace phasetree::tracer::studio
