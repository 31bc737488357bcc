// An instance of each kind, from which a person starts.
#pragma once

#include <string>

#include "studio/vocabulary.hpp"

namespace phasetree::tracer::studio {

/// Names in templates that stand for others.
inline constexpr std::string_view phase_placeholder = "<phase>";
inline constexpr std::string_view other_phase_placeholder = "<other phase>";
inline constexpr std::string_view file_placeholder = "<file>";
inline constexpr std::string_view object_placeholder = "<object>";

/// A JSON text of the kind that is about one unit large, with the kind's name if it is written with it. Names are
/// placeholders.
std::string template_of(const CatalogueKind& kind);

}  // namespace phasetree::tracer::studio
