#include "studio/references.hpp"

#include <algorithm>

#include "studio/outline.hpp"
#include "studio/pointer.hpp"

namespace phasetree::tracer::studio {

namespace {

void add_phases(const OutlineParameter& p, std::string_view name, std::vector<std::size_t>& found) {
    if (!p.of || !p.value) return;
    if (p.of->control == "phase" || p.of->control == "phases") {
        if (p.value->is_string() && p.value->string() == name) found.push_back(p.value->offset());
        for (const Value item : *p.value)
            if (item.is_string() && item.string() == name) found.push_back(item.offset());
    }
}

void add_references(const OutlineEntry& entry, ReferenceKind what, std::string_view name,
                    std::vector<std::size_t>& found) {
    if (what == ReferenceKind::shape && entry.kind == "reference" && entry.label == name)
        found.push_back(entry.value->offset());
    if (what == ReferenceKind::phase) {
        for (const OutlineParameter& p : entry.parameters) add_phases(p, name, found);
        // An entry of "objects" may override the materials of phases; the keys of its "phases" are phase names.
        if (entry.type == "placed_object")
            if (const auto phases = entry.value->find("phases"))
                if (const auto phase = phases->find(name)) found.push_back(phase->key_offset());
    }
    for (const OutlineEntry& child : entry.children) add_references(child, what, name, found);
}

}  // namespace

std::optional<ReferenceKind> declared_at(std::string_view pointer) {
    const PointerTokens tokens = pointer_tokens(pointer);
    if (tokens.size() != 2) return std::nullopt;
    if (tokens[0] == "phases") return ReferenceKind::phase;
    return tokens[0] == "shapes" ? std::optional(ReferenceKind::shape) : std::nullopt;
}

std::vector<std::size_t> references_to(const Document& document, ReferenceKind what, std::string_view name,
                                       const Vocabulary& vocabulary) {
    std::vector<std::size_t> found;
    const Outline outline = outline_of(document, vocabulary);
    for (const OutlineEntry& entry : outline.entries) add_references(entry, what, name, found);
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace phasetree::tracer::studio
