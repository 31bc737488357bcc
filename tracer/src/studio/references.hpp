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

/// What a name in a scene file refers to.
enum class ReferenceKind { phase, shape };

/// What is declared at a pointer such as "/phases/glass" or "/shapes/ball". nullopt for anything else.
std::optional<ReferenceKind> declared_at(std::string_view pointer);

/// The offsets of all strings and keys that refer to a name, except for its declaration.
std::vector<std::size_t> references_to(const Document& document, ReferenceKind what, std::string_view name,
                                       const Vocabulary& vocabulary);

}  // namespace phasetree::tracer::studio
