// An instance of each kind to start from.
#pragma once

#include <string>

#include "studio/vocabulary.hpp"

namespace phasetree::tracer::studio {

/// Placeholders in templates, to be replaced by names of the scene.
inline constexpr std::string_view phase_placeholder = "<phase>";
inline constexpr std::string_view other_phase_placeholder = "<other phase>";
inline constexpr std::string_view file_placeholder = "<file>";
inline constexpr std::string_view object_placeholder = "<object>";

/// JSON of an instance of the kind, about one unit in size: {"name": {…}} if the kind is written with its name,
/// otherwise {…}. Names in it are placeholders.
std::string template_of(const CatalogueKind& kind);

}  // namespace phasetree::tracer::studio
