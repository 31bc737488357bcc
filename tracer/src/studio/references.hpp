// Where a scene file refers to phases and shapes by name.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "phasetree/io/document.hpp"
#include "studio/vocabulary.hpp"

namespace phasetree::tracer::studio {

/// What scene files refer to by names.
enum class Named { phase, shape };

/// What a pointer declares: "/phases/glass" and "/shapes/ball". nullopt for anything else.
std::optional<Named> named_by(std::string_view pointer);

/// The offsets of all strings and keys that refer to a name, except for its declaration.
std::vector<std::size_t> references_to(const Document& document, Named what, std::string_view name,
                                       const Vocabulary& vocabulary);

}  // namespace phasetree::tracer::studio
