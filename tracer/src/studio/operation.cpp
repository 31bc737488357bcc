#include "studio/operation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "phasetree/io/suggest.hpp"
#include "studio/layout.hpp"
#include "studio/pointer.hpp"
#include "studio/references.hpp"
#include "studio/value_text.hpp"

namespace phasetree::tracer::studio {

namespace {

std::string json_string(std::string_view key) {
    return nlohmann::json(std::string(key)).dump();
}

// A replacement of a part of a text.
struct Replacement {
    Span span;
    std::string by;
};

std::string replaced(const std::string& text, std::vector<Replacement> replacements) {
    std::stable_sort(replacements.begin(), replacements.end(),
                     [](const Replacement& a, const Replacement& b) { return a.span.begin < b.span.begin; });
    std::string result;
    std::size_t kept = 0;
    for (const Replacement& r : replacements) {
        result.append(text, kept, r.span.begin - kept);
        result += r.by;
        kept = r.span.end;
    }
    return result.append(text, kept);
}

Document new_value(const std::string& text, std::string_view what) {
    return Document::from_text(text, fmt::format("<{}>", what));
}

// The parent of what a pointer refers to, and the last token.
struct Target {
    Value parent;
    std::string token;
};

Target target_of(const Document& document, const std::string& pointer, std::string_view what) {
    PointerTokens tokens = pointer_tokens(pointer);
    if (tokens.empty()) throw document.error(document.root(), fmt::format("the whole document cannot be {}", what));
    std::string token = std::move(tokens.back());
    tokens.pop_back();
    return {value_at(document, pointer_of(tokens)), std::move(token)};
}

// The end of the comments that follow an offset on the same line; the offset itself if there are none. npos if an item
// follows on the line.
std::size_t end_of_line_comments(std::string_view text, std::size_t at) {
    std::size_t end = at;
    while (at < text.size()) {
        if (text[at] == ' ' || text[at] == '\t') {
            ++at;
        } else if (text.substr(at, 2) == "//") {
            return std::min(text.find_first_of("\r\n", at), text.size());
        } else if (text.substr(at, 2) == "/*") {
            const std::size_t close = text.find("*/", at + 2) + 2;
            if (has_line_break(text.substr(at, close - at))) return end;
            end = at = close;
        } else {
            return std::string_view("\r\n]}").find(text[at]) != std::string_view::npos ? end : std::string_view::npos;
        }
    }
    return end;
}

// Puts an item into a container: `write` makes its text for a place.
class Insertion {
  public:
    Insertion(const Document& document, Value parent, std::string key)
        : text_(document.text()), container_(container_of(document, parent)), key_(std::move(key)) {}

    // `write` may be called more than once, for different places, and must not have side effects.
    template <class Write>
    std::string before(std::size_t i, Write&& write) const {
        const auto item = [&](Place place) {
            place.column += key_.size();
            return key_ + write(place);
        };
        const std::size_t n = container_.items.size();
        if (n == 0) return into_empty(item);
        if (!container_.is_multiline(text_)) return into_line(i, item);
        Place place = place_at(text_, container_.open);
        place.indentation = item_indentation(place);
        place.column = place.indentation.size();
        const std::string line = place.line_ending + place.indentation;
        if (i == n) return at_end(line + item(place));
        const std::size_t next = container_.items[i].begin;
        if (!begins_line(text_, next))
            return replaced(text_, {{{next, next}, before_item_within_line(next, item, line)}});
        // Insert after the comma that follows the previous item, and after any comments on that line, so that comments
        // above the next item stay above it.
        std::size_t at = container_.open + 1;
        if (i > 0) at = comma_in(container_.gap(i)) + 1;
        const std::size_t comments = end_of_line_comments(text_, at);
        if (comments != std::string_view::npos) at = comments;
        if (!has_line_break(text_.substr(at, next - at))) return replaced(text_, {{{next, next}, item(place) + ", "}});
        return replaced(text_, {{{at, at}, line + item(place) + ","}});
    }

    // The comma in a gap, outside comments.
    std::size_t comma_in(Span gap) const { return skip_blank(text_, gap.begin); }

  private:
    template <class Item>
    std::string before_item_within_line(std::size_t at, const Item& item, const std::string& new_line) const {
        return item(place_at(text_, at)) + "," + new_line;
    }

    // The indentation of the items that begin a line.
    std::string item_indentation(const Place& place) const {
        for (const Span& one : container_.items)
            if (begins_line(text_, one.begin)) return indentation_at(text_, one.begin);
        return place.indentation + place.unit;
    }

    template <class Item>
    std::string into_empty(const Item& item) const {
        const Span inside = container_.gap(0);
        Place place = place_at(text_, container_.open);
        const std::string outer = place.indentation;
        Place inner = place;
        inner.indentation += inner.unit;
        inner.column = inner.indentation.size();
        if (has_comments(inside.of(text_))) {
            std::size_t end = inside.end;
            while (end > inside.begin && std::string_view(" \t\r\n").find(text_[end - 1]) != std::string_view::npos)
                --end;
            return replaced(text_, {{{end, inside.end},
                                     place.line_ending + inner.indentation + item(inner) + place.line_ending + outer}});
        }
        Place same = place;
        ++same.column;
        const std::string flat = item(same);
        const bool is_structure = flat.find('{') != std::string::npos;
        if (!has_line_break(inside.of(text_)) && !(is_structure && is_first_on_line()) && !has_line_break(flat))
            return replaced(text_, {{inside, flat}});
        return replaced(text_,
                        {{inside, place.line_ending + inner.indentation + item(inner) + place.line_ending + outer}});
    }

    // Whether only a key precedes the container on its line. If so, the document is laid out over several lines.
    bool is_first_on_line() const {
        const std::size_t column = column_at(text_, container_.open);
        if (column == container_.open) return false;  // the first line of the text
        const std::string_view before = std::string_view(text_).substr(container_.open - column, column);
        return before.find_first_of("{[") == std::string_view::npos;
    }

    template <class Item>
    std::string into_line(std::size_t i, const Item& item) const {
        const std::size_t first = container_.items[0].begin;
        if (i == container_.items.size()) {
            const std::size_t at = container_.items.back().end;
            Place place = place_at(text_, at);
            place.column += 2;
            const std::string same_line = ", " + item(place);
            if (place.column + same_line.size() <= Place::width) return replaced(text_, {{{at, at}, same_line}});
            place.column = column_at(text_, first);
            const std::string aligned = std::string(place.column, ' ');
            place.indentation = aligned;
            return replaced(text_, {{{at, at}, "," + place.line_ending + aligned + item(place)}});
        }
        const std::size_t at = container_.items[i].begin;
        return replaced(text_, {{{at, at}, item(place_at(text_, at)) + ", "}});
    }

    // `line` is the item on a line of its own.
    std::string at_end(const std::string& line) const {
        const std::size_t last = container_.items.back().end;
        const std::size_t comments = end_of_line_comments(text_, last);
        if (comments == std::string_view::npos || comments == last)
            return replaced(text_, {{{last, last}, "," + line}});
        return replaced(text_, {{{last, last}, ","}, {{comments, comments}, line}});
    }

    const std::string& text_;
    Container container_;
    std::string key_;
};

// What remains of the text on both sides of a removed item.
std::string joined(std::string before, std::string_view after) {
    const std::size_t begin = std::min(after.find_first_not_of(" \t"), after.size());
    if (begin < after.size() && (after[begin] == '\n' || after[begin] == '\r')) {
        while (!before.empty() && (before.back() == ' ' || before.back() == '\t')) before.pop_back();
        if (before.ends_with("\r\n"))
            before.resize(before.size() - 2);
        else if (before.ends_with('\n') || before.ends_with('\r'))
            before.pop_back();
        return before + std::string(after.substr(begin));
    }
    return before + std::string(after.substr(begin));
}

std::string without(const Document& document, const std::string& pointer) {
    const Value removed = value_at(document, pointer);
    const Target target = target_of(document, pointer, "removed");
    const std::string& text = document.text();
    const Container container = container_of(document, target.parent);
    std::size_t k = 0;
    for (const Value item : target.parent) {
        if (item.offset() == removed.offset()) break;
        ++k;
    }
    const std::size_t n = container.items.size();
    const Span before = container.gap(k), after = container.gap(k + 1);
    std::string left(before.of(text)), right(after.of(text));
    const bool is_last = k + 1 == n;
    if (n == 1) {
        if (!has_comments(left) && !has_comments(right)) return replaced(text, {{{before.begin, after.end}, ""}});
    } else if (is_last) {
        if (!has_comments(left)) return replaced(text, {{{before.begin, after.begin}, ""}});
        left.erase(skip_blank(text, before.begin) - before.begin, 1);
    } else {
        if (!has_comments(right)) return replaced(text, {{{container.items[k].begin, after.end}, ""}});
        right.erase(skip_blank(text, after.begin) - after.begin, 1);
    }
    return replaced(text, {{{before.begin, after.end}, joined(left, right)}});
}

// Inserts what `write(place)` returns.
template <class Write>
std::string with_inserted(const Document& document, const std::string& pointer, Write&& write) {
    const auto [parent, token] = target_of(document, pointer, "inserted");
    if (parent.is_object()) {
        if (const auto there = parent.find(token))
            throw document.error(there->key_offset(),
                                 fmt::format("there is a \"{}\" already; remove it or set it instead", token));
        return Insertion(document, parent, json_string(token) + ": ").before(parent.size(), write);
    }
    if (!parent.is_array())
        throw document.error(parent, fmt::format("nothing can be inserted into {}", phasetree::name_of(parent.kind())));
    const std::optional<std::size_t> index = token == "-" ? std::optional(parent.size()) : index_of(token);
    if (!index || *index > parent.size())
        throw document.error(parent, fmt::format("\"{}\" is not a place in this list, which has {}", token,
                                                 count_of_items(parent.size())));
    return Insertion(document, parent, "").before(*index, write);
}

bool is_inside(const std::string& pointer, const std::string& of) {
    return pointer.size() > of.size() && pointer.starts_with(of) && pointer[of.size()] == '/';
}

std::string apply(const Document& document, const SetValue& o, const Vocabulary&) {
    const Document value = new_value(o.to, "value");
    const PointerTokens tokens = pointer_tokens(o.pointer);
    if (!tokens.empty()) {
        const auto [parent, token] = target_of(document, o.pointer, "set");
        if (parent.is_object() && !parent.find(token))
            return with_inserted(document, o.pointer, [&](const Place& place) { return value_text(value, place); });
    }
    const Span old = span_of(document, value_at(document, o.pointer));
    return replaced(document.text(), {{old, value_text(value, place_at(document.text(), old.begin))}});
}

std::string apply(const Document& document, const InsertValue& o, const Vocabulary&) {
    const Document value = new_value(o.value, "value");
    return with_inserted(document, o.pointer, [&](const Place& place) { return value_text(value, place); });
}

std::string apply(const Document& document, const RemoveValue& o, const Vocabulary&) {
    return without(document, o.pointer);
}

std::string apply(const Document& document, const MoveValue& o, const Vocabulary&) {
    const Span span = span_of(document, value_at(document, o.pointer));
    if (o.pointer == o.to || is_inside(o.to, o.pointer)) {
        if (o.pointer == o.to) return document.text();
        throw document.error(span.begin, "a value cannot be moved into itself");
    }
    const std::string_view piece = span.of(document.text());
    const Place from = place_at(document.text(), span.begin);
    const Document rest = Document::from_text(without(document, o.pointer), document.name());
    return with_inserted(rest, o.to, [&](const Place& to) { return moved_text(piece, from, to); });
}

std::string apply(const Document& document, const WrapValue& o, const Vocabulary&) {
    const Document around = new_value(o.in, "wrapping");
    const Span span = span_of(document, value_at(document, o.pointer));
    const Place place = place_at(document.text(), span.begin);
    return replaced(document.text(), {{span, wrapped_text(around, span.of(document.text()), place, place)}});
}

std::string apply(const Document& document, const UnwrapValue& o, const Vocabulary&) {
    const Span span = span_of(document, value_at(document, o.pointer));
    if (!is_inside(o.keep, o.pointer))
        throw document.error(span.begin, fmt::format("{} is not inside {}", o.keep, o.pointer));
    const Span kept = span_of(document, value_at(document, o.keep));
    const std::string& text = document.text();
    return replaced(text, {{span, moved_text(kept.of(text), place_at(text, kept.begin), place_at(text, span.begin))}});
}

std::string apply(const Document& document, const RenameKey& o, const Vocabulary& vocabulary) {
    const Value value = value_at(document, o.pointer);
    const Target target = target_of(document, o.pointer, "renamed");
    if (!target.parent.is_object()) throw document.error(value, "only the members of an object have names");
    if (target.token == o.to) return document.text();
    if (const auto there = target.parent.find(o.to))
        throw document.error(there->key_offset(), fmt::format("there is a \"{}\" already; choose another name", o.to));
    const std::string& text = document.text();
    std::vector<Replacement> replacements{{span_of_value(text, value.key_offset()), json_string(o.to)}};
    if (o.references) {
        const std::optional<ReferenceKind> named = declared_at(o.pointer);
        if (!named)
            throw document.error(
                value.key_offset(),
                "references can be renamed only for phases and shapes; rename this key without \"references\"");
        for (const std::size_t offset : references_to(document, *named, target.token, vocabulary))
            replacements.push_back({span_of_value(text, offset), json_string(o.to)});
    }
    return replaced(text, std::move(replacements));
}

std::string apply(const Document&, const ReplaceText& o, const Vocabulary&) {
    return o.text;
}

}  // namespace

std::string_view name_of(const Operation& operation) {
    constexpr std::string_view names[] = {"set", "insert", "remove", "move", "wrap", "unwrap", "rename", "text"};
    return names[operation.index()];
}

std::string applied(const Document& document, const Operation& operation, const Vocabulary& vocabulary) {
    try {
        return std::visit([&](const auto& o) { return apply(document, o, vocabulary); }, operation);
    } catch (const std::invalid_argument& e) {
        throw SceneError(document.name(), e.what());
    }
}

}  // namespace phasetree::tracer::studio
