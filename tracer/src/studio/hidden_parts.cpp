#include "studio/hidden_parts.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "studio/layout.hpp"
#include "studio/outline.hpp"
#include "studio/pointer.hpp"

namespace phasetree::tracer::studio {

namespace {

class Hiding {
  public:
    Hiding(const Document& document, const Vocabulary& vocabulary, const std::vector<std::string>& hidden)
        : document_(document),
          hidden_(hidden.begin(), hidden.end()),
          outline_(outline_of(document, vocabulary)),
          text_(document.text()) {
        for (const OutlineEntry& entry : outline_.entries)
            if (entry.pointer.starts_with("/shapes/") && entry.label) shapes_.emplace(*entry.label, &entry);
    }

    std::string text() {
        std::map<std::string, std::set<std::size_t>> lists;
        for (const OutlineEntry& entry : outline_.entries) {
            const bool is_gone = look(entry);
            if (is_gone && entry.pointer == "/tree")
                throw SceneError(document_.name(), "every part of the object is hidden, so there is nothing to show");
            if (is_gone && (entry.pointer.starts_with("/lights/") || entry.pointer.starts_with("/meshes/")))
                lists[parent_of(entry.pointer)].insert(value_at(document_, entry.pointer).offset());
        }
        for (const auto& [pointer, items] : lists) leave_out(value_at(document_, pointer), items);
        return text_;
    }

  private:
    static std::string parent_of(const std::string& pointer) { return pointer.substr(0, pointer.rfind('/')); }

    // Leaves out the hidden parts of an entry, and returns whether the entry itself must be left out.
    bool look(const OutlineEntry& entry) {
        if (hidden_.contains(entry.pointer)) return true;
        if (entry.kind == "reference") return entry.label && is_shape_gone(*entry.label);
        std::vector<const OutlineEntry*> kept, gone;
        for (const OutlineEntry& child : entry.children) (look(child) ? gone : kept).push_back(&child);
        if (gone.empty()) return false;
        std::map<std::string, std::set<std::size_t>> lists;  // offsets of the items to leave out, by list
        bool is_complete = true;
        for (const OutlineEntry* child : gone) {
            const Value list = value_at(document_, parent_of(child->pointer));
            const auto is_beside = [&](const OutlineEntry* other) {
                return parent_of(other->pointer) == parent_of(child->pointer);
            };
            if (list.is_array() && std::ranges::any_of(kept, is_beside))
                lists[parent_of(child->pointer)].insert(child->value.value().offset());
            else
                is_complete = false;
        }
        if (is_complete) {
            for (const auto& [pointer, items] : lists) leave_out(value_at(document_, pointer), items);
            return false;
        }
        return !replace_by_main(entry, kept);
    }

    // Replaces a node by its only operand in its first slot.
    bool replace_by_main(const OutlineEntry& entry, const std::vector<const OutlineEntry*>& kept) {
        if (!entry.of || !entry.value) return false;
        const auto main = std::ranges::find_if(
            entry.of->parameters, [&](const KindParameter& p) { return p.slot && p.slot->type == entry.type; });
        if (main == entry.of->parameters.end()) return false;
        const OutlineEntry* only = nullptr;
        for (const OutlineEntry* child : kept) {
            if (child->slot != main->name) continue;
            if (only) return false;
            only = child;
        }
        if (!only) return false;
        const Span all = span_of(document_, *entry.value), inner = span_of(document_, only->value.value());
        blank({all.begin, inner.begin});
        blank({inner.end, all.end});
        return true;
    }

    bool is_shape_gone(const std::string& name) {
        const auto known = are_shapes_gone_.find(name);
        if (known != are_shapes_gone_.end()) return known->second;
        const auto shape = shapes_.find(name);
        if (shape == shapes_.end()) return false;
        are_shapes_gone_[name] = false;  // for shapes that contain themselves, which the reader rejects
        return are_shapes_gone_[name] = look(*shape->second);
    }

    void leave_out(Value list, const std::set<std::size_t>& offsets) {
        const Container container = container_of(document_, list);
        bool has_item_before = false;
        std::size_t i = 0;
        for (const Value item : list) {
            const bool is_kept = !offsets.contains(item.offset());
            if (!is_kept) blank(container.items[i]);
            if (i > 0 && !(is_kept && has_item_before)) {
                const std::size_t comma = skip_blank(document_.text(), container.gap(i).begin);
                blank({comma, comma + 1});
            }
            has_item_before = has_item_before || is_kept;
            ++i;
        }
    }

    void blank(Span span) {
        for (std::size_t i = span.begin; i < span.end; ++i)
            if (text_[i] != '\n' && text_[i] != '\r') text_[i] = ' ';
    }

    const Document& document_;
    const std::set<std::string> hidden_;
    const Outline outline_;
    std::map<std::string, const OutlineEntry*> shapes_;
    std::map<std::string, bool> are_shapes_gone_;
    std::string text_;
};

// The pointer of the value that begins at an offset.
std::optional<std::string> pointer_at(const Document& document, std::size_t offset) {
    Value value = document.root();
    std::string pointer;
    while (value.offset() != offset) {
        std::optional<Value> next;
        std::string token;
        std::size_t i = 0;
        for (const Value child : value) {
            if (child.offset() > offset) break;
            next = child;
            token = value.is_object() ? escaped(child.key()) : std::to_string(i);
            ++i;
        }
        if (!next) return std::nullopt;
        value = *next;
        pointer += "/" + token;
    }
    return pointer;
}

// The offset at which a text occurs, if it occurs once.
std::optional<std::size_t> only_place_of(std::string_view part, std::string_view text) {
    const std::size_t first = text.find(part);
    if (first == std::string_view::npos || text.find(part, first + 1) != std::string_view::npos) return std::nullopt;
    return first;
}

bool has_same_structure(Value a, Value b) {
    if (a.kind() != b.kind() || !(a.is_array() || a.is_object())) return a.kind() == b.kind();
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (!has_same_structure(a[i], b[i])) return false;
    return true;
}

}  // namespace

std::string text_without(const Document& document, const Vocabulary& vocabulary,
                         const std::vector<std::string>& hidden) {
    return Hiding(document, vocabulary, hidden).text();
}

std::vector<std::string> pointers_after(const Document& before, const Document& after,
                                        const std::vector<std::string>& pointers) {
    const std::string_view old = before.text(), now = after.text();
    const std::size_t shorter = std::min(old.size(), now.size());
    std::size_t same = 0, end = 0;  // bytes that are the same at the beginning and at the end
    while (same < shorter && old[same] == now[same]) ++same;
    while (end < shorter - same && old[old.size() - 1 - end] == now[now.size() - 1 - end]) ++end;
    std::vector<std::string> result;
    for (const std::string& pointer : pointers) {
        std::optional<Span> span;
        try {
            span = span_of(before, value_at(before, pointer));
        } catch (const std::exception&) {
            continue;  // it refers to nothing
        }
        std::optional<std::size_t> offset;
        if (span->end <= same)
            offset = span->begin;
        else if (span->begin >= old.size() - end)
            offset = span->begin + now.size() - old.size();
        else
            offset = only_place_of(span->of(old), now);  // the value may have moved
        const bool contains_change = span->begin < same && span->end > old.size() - end;
        if (!offset && contains_change) offset = span->begin;
        if (!offset && has_same_structure(before.root(), after.root())) {
            result.push_back(pointer);  // for example, after a phase was renamed
            continue;
        }
        if (!offset) continue;
        if (auto found = pointer_at(after, *offset)) result.push_back(std::move(*found));
    }
    return result;
}

}  // namespace phasetree::tracer::studio
