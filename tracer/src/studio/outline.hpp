// The parts of a scene file as a tree, which the studio's page lists. It needs a valid JSON text, but not a valid
// scene.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "phasetree/io/document.hpp"
#include "studio/vocabulary.hpp"

namespace phasetree::tracer::studio {

struct OutlineParameter {
    std::string name;     ///< as in the reference, even if the file has the other spelling (colour, color)
    std::string pointer;  ///< of the value
    std::optional<Value> value;
    bool is_keyed = false;              ///< whether it changes with time
    bool is_known = true;               ///< whether the kind has such a parameter
    const KindParameter* of = nullptr;  ///< its description; null if unknown, or a parameter of the scene or a phase
};

struct OutlineEntry {
    std::string pointer;  ///< of the whole value, such as {"sphere": {…}}
    std::optional<Value> value;
    /// The kind's key; "reference" for the name of a shape, "list" for a list of transforms, "group" for a group, and
    /// the file's own key for an unknown kind.
    std::string kind;
    std::string type;  ///< "field", "light", …
    /// Its description; null for references, groups, lists of transforms and unknown kinds.
    const CatalogueKind* of = nullptr;
    std::optional<std::string> label{};  ///< the name that a person gave
    std::optional<std::string> slot{};   ///< the parameter of the parent that it is in
    std::vector<std::string> phases{};   ///< named in its parameters, without those of its children
    std::vector<OutlineParameter> parameters{};
    std::vector<OutlineEntry> children{};
};

struct Outline {
    static constexpr std::size_t most_on_a_page = 20000;

    std::vector<OutlineEntry> entries;
    bool has_more = false;  ///< whether there are more entries than asked for
};

/// At most `most` entries, counting those inside others.
Outline outline_of(const Document& document, const Vocabulary& vocabulary,
                   std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace phasetree::tracer::studio
