// Random operations on random texts, against the same operations on parsed values; and what they leave as it is:
// comments, line breaks and the notation of everything else.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>
#include <utility>

#include "studio/history.hpp"
#include "studio/layout.hpp"
#include "studio/operation.hpp"
#include "studio/pointer.hpp"
#include "studio/vocabulary.hpp"

namespace test_random_operations {

using namespace phasetree;
using namespace phasetree::tracer::studio;

namespace {

using Json = nlohmann::ordered_json;

const Vocabulary& vocabulary() {
    static const Vocabulary words;
    return words;
}

Json parsed(const std::string& text) {
    return Json::parse(text, nullptr, true, true);
}

// The same operations on parsed values.
Json& parent_in(Json& root, PointerTokens tokens) {
    tokens.pop_back();
    return root.at(Json::json_pointer(pointer_of(tokens)));
}

void insert_into(Json& root, const std::string& pointer, const Json& value) {
    const PointerTokens tokens = pointer_tokens(pointer);
    Json& parent = parent_in(root, tokens);
    if (parent.is_object())
        parent[tokens.back()] = value;
    else if (tokens.back() == "-")
        parent.push_back(value);
    else
        parent.insert(parent.begin() + static_cast<std::ptrdiff_t>(std::stoul(tokens.back())), value);
}

void remove_from(Json& root, const std::string& pointer) {
    const PointerTokens tokens = pointer_tokens(pointer);
    Json& parent = parent_in(root, tokens);
    if (parent.is_object())
        parent.erase(tokens.back());
    else
        parent.erase(parent.begin() + static_cast<std::ptrdiff_t>(std::stoul(tokens.back())));
}

Json with_null_replaced(const Json& in, const Json& by) {
    if (in.is_null()) return by;
    Json result = in;
    for (auto& child : result)
        if (child.is_structured() || child.is_null()) child = with_null_replaced(child, by);
    return result;
}

Json expected(const Json& before, const Operation& operation) {
    Json root = before;
    const auto at = [&](const std::string& pointer) -> Json& { return root.at(Json::json_pointer(pointer)); };
    if (const auto* set = std::get_if<SetValue>(&operation)) {
        if (set->pointer.empty()) return parsed(set->to);
        const PointerTokens tokens = pointer_tokens(set->pointer);
        Json& parent = parent_in(root, tokens);
        if (parent.is_object())
            parent[tokens.back()] = parsed(set->to);
        else
            parent[std::stoul(tokens.back())] = parsed(set->to);
    } else if (const auto* insert = std::get_if<InsertValue>(&operation)) {
        insert_into(root, insert->pointer, parsed(insert->value));
    } else if (const auto* remove = std::get_if<RemoveValue>(&operation)) {
        remove_from(root, remove->pointer);
    } else if (const auto* move = std::get_if<MoveValue>(&operation)) {
        const Json value = at(move->pointer);
        remove_from(root, move->pointer);
        insert_into(root, move->to, value);
    } else if (const auto* wrap = std::get_if<WrapValue>(&operation)) {
        at(wrap->pointer) = with_null_replaced(parsed(wrap->in), Json(at(wrap->pointer)));
    } else if (const auto* unwrap = std::get_if<UnwrapValue>(&operation)) {
        at(unwrap->pointer) = Json(at(unwrap->keep));
    } else if (const auto* rename = std::get_if<RenameKey>(&operation)) {
        const PointerTokens tokens = pointer_tokens(rename->pointer);
        Json& parent = parent_in(root, tokens);
        Json renamed = Json::object();
        for (const auto& [key, value] : parent.items()) renamed[key == tokens.back() ? rename->to : key] = value;
        parent = renamed;
    }
    return root;
}

// Texts of random values in random styles, with comments.
class RandomText {
  public:
    explicit RandomText(std::uint32_t seed) : random_(seed) {}

    std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }

    std::string document() {
        style_ = below(4);
        ending_ = below(5) == 0 ? "\r\n" : "\n";
        tab_ = below(6) == 0;
        return (below(3) == 0 ? comment(true) : "") + value(0, 0, true) + (below(2) ? ending_ : "");
    }
    // A value on one line without comments, as a request has it.
    std::string given() {
        const std::size_t style = std::exchange(style_, 3);
        std::string text = value(2, 0, false);
        style_ = style;
        return text;
    }
    std::string key() {
        constexpr const char* keys[] = {"a", "of", "set", "x/y", "~", "é", "with \\\"quotes\\\"", "//no", "radius"};
        return keys[below(std::size(keys))];
    }

  private:
    std::string comment(bool ends_line) {
        const std::string name = fmt::format("c{} \"[{{,", ++comments_);
        return ends_line && below(2) ? "// " + name + ending_ : "/* " + name + " */";
    }
    std::string blank(std::size_t depth, bool breaks) {
        std::string text = breaks ? ending_ + std::string(tab_ ? depth : 2 * depth, tab_ ? '\t' : ' ') : "";
        if (style_ == 2 && below(6) == 0) text += comment(breaks) + (breaks ? "  " : " ");
        return text;
    }
    std::string scalar() {
        constexpr const char* all[] = {"1",    "-0.50",     "1e3",      "true",     "false",
                                       "null", "\"glass\"", "\"// {\"", "\"\\\\\"", "\"\""};
        return all[below(std::size(all))];
    }
    std::string value(std::size_t depth, std::size_t column, bool must_be_wide) {
        if (!must_be_wide && (depth > 4 || below(3) == 0)) return scalar();
        const bool is_object = below(2) == 0;
        std::string text(1, is_object ? '{' : '[');
        const bool breaks = style_ == 0 || (style_ == 2 && below(2));
        const std::size_t n = must_be_wide ? 2 + below(4) : below(4);
        std::vector<std::string> used;
        for (std::size_t i = 0; i < n; ++i) {
            std::string name = key();
            while (std::find(used.begin(), used.end(), name) != used.end()) name += "_";
            used.push_back(name);
            if (i > 0) text += blank(0, false) + ",";
            if (style_ == 1)
                text += i == 0 ? "" : ending_ + std::string(column + 1, ' ');
            else
                text += breaks ? blank(depth + 1, true) : style_ == 3 && i == 0 ? "" : " ";
            if (is_object) text += "\"" + name + "\": ";
            text += value(depth + 1, column + 1 + (is_object ? name.size() + 4 : 0), false);
        }
        if (n > 0 || style_ == 2) text += blank(depth, breaks && n > 0);
        return text + (is_object ? '}' : ']');
    }

    std::mt19937 random_;
    std::size_t style_ = 0, comments_ = 0;
    std::string ending_ = "\n";
    bool tab_ = false;
};

void add_pointers(Value value, const std::string& pointer, std::vector<std::string>& all) {
    all.push_back(pointer);
    std::size_t i = 0;
    for (const Value child : value)
        add_pointers(child, pointer + "/" + (value.is_object() ? escaped(child.key()) : std::to_string(i++)), all);
}

std::vector<std::string> pointers_of(const Document& document) {
    std::vector<std::string> all;
    add_pointers(document.root(), "", all);
    return all;
}

// A random operation that should be possible, or not: then the oracle is not asked.
Operation random_operation(RandomText& random, const Document& document) {
    const std::vector<std::string> all = pointers_of(document);
    const auto any = [&] { return all[random.below(all.size())]; };
    const auto new_place = [&] {
        const std::string pointer = any();
        const Value value = value_at(document, pointer);
        if (value.is_object()) return pointer + "/" + escaped("new" + std::to_string(random.below(1000)));
        if (!value.is_array()) return pointer + "/0";
        return pointer + "/" + (random.below(4) == 0 ? "-" : std::to_string(random.below(value.size() + 1)));
    };
    switch (random.below(8)) {
        case 0:
            return SetValue{any(), random.given()};
        case 1:
            return SetValue{new_place(), random.given()};
        case 2:
            return InsertValue{new_place(), random.given()};
        case 3:
            return RemoveValue{any()};
        case 4:
            return MoveValue{any(), new_place()};
        case 5:
            return WrapValue{any(), random.below(2) ? R"({"set": {"phase": "glass", "of": null}})" : "[1,\n  null]"};
        case 6:
            return UnwrapValue{any(), any()};
        default:
            return RenameKey{any(), random.key() + "!", false};
    }
}

// Comments of a text outside some of its bytes.
std::vector<std::string> comments_of(const std::string& text, Span without) {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i + 1;
        if (text[i] == '"')
            end = span_of_value(text, i).end;
        else if (text.compare(i, 2, "//") == 0)
            end = std::min(text.find_first_of("\r\n", i), text.size());
        else if (text.compare(i, 2, "/*") == 0)
            end = text.find("*/", i) + 2;
        if (text[i] == '/' && !(i >= without.begin && i < without.end)) all.push_back(text.substr(i, end - i));
        i = end;
    }
    std::sort(all.begin(), all.end());
    return all;
}

// The bytes of all values beside the way to a pointer. If `without_last`, the value itself does not count.
std::vector<std::string> beside(const Document& document, const std::string& pointer) {
    std::vector<std::string> all;
    Value value = document.root();
    for (const std::string& token : pointer_tokens(pointer)) {
        const auto next = child_of(value, token);
        for (const Value child : value)
            if (!next || child.offset() != next->offset())
                all.push_back(std::string(child.key()) + std::string(span_of(document, child).of(document.text())));
        if (!next) break;
        value = *next;
    }
    return all;
}

// What an operation must leave as it is.
void check_rest(const Document& before, const Document& now, const Operation& operation) {
    const auto* set = std::get_if<SetValue>(&operation);
    const auto* insert = std::get_if<InsertValue>(&operation);
    const auto* remove = std::get_if<RemoveValue>(&operation);
    if (set || insert || remove) {
        const std::string pointer = set ? set->pointer : insert ? insert->pointer : remove->pointer;
        Span touched{0, 0};
        bool is_new = insert != nullptr;
        try {
            if (!insert) touched = span_of(before, value_at(before, pointer));
        } catch (const SceneError&) {
            is_new = true;
        }
        CHECK(comments_of(before.text(), touched) == comments_of(now.text(), {0, 0}));
        std::vector<std::string> old = beside(before, is_new ? "" : pointer), rest = beside(now, remove ? "" : pointer);
        if (is_new || remove) {
            // Compare with one value less on one side: all of its siblings remain in their order.
            PointerTokens tokens = pointer_tokens(pointer);
            if (is_new && tokens.back() == "-")
                tokens.back() = std::to_string(value_at(before, pointer_of({tokens.begin(), tokens.end() - 1})).size());
            const std::string full = pointer_of(tokens);
            old = beside(before, remove ? full : pointer_of(tokens));
            rest = beside(now, full);
            const Value parent = value_at(remove ? now : before, pointer_of({tokens.begin(), tokens.end() - 1}));
            const Document& smaller = remove ? now : before;
            auto& list = remove ? rest : old;
            PointerTokens of_parent(tokens.begin(), tokens.end() - 1);
            list = beside(smaller, pointer_of(of_parent));
            for (const Value child : parent)
                list.push_back(std::string(child.key()) + std::string(span_of(smaller, child).of(smaller.text())));
        }
        CHECK(old == rest);
    } else if (std::holds_alternative<MoveValue>(operation) || std::holds_alternative<WrapValue>(operation)) {
        const auto count = [](const Document& d) { return comments_of(d.text(), {0, 0}).size(); };
        CHECK(count(before) == count(now));
    }
}

}  // namespace

TEST_CASE("random operations do to a text what they do to its values, and undoing them restores every byte") {
    std::size_t done = 0;
    for (std::uint32_t seed = 0; seed < 1500; ++seed) {
        RandomText random(seed);
        const std::string first = random.document();
        CAPTURE(seed);
        History history(first);
        std::size_t steps = 0;
        for (int i = 0; i < 8; ++i) {
            const Document before = Document::from_text(history.text());
            const Operation operation = random_operation(random, before);
            std::string text;
            try {
                text = applied(before, operation, vocabulary());
            } catch (const SceneError&) {
                continue;
            }
            CAPTURE(before.text());
            CAPTURE(name_of(operation));
            CAPTURE(text);
            const Document now = Document::from_text(text);
            CHECK(parsed(text) == expected(parsed(before.text()), operation));
            check_rest(before, now, operation);
            ++done;
            if (text != history.text()) ++steps;
            history.add(text, "step");
        }
        const std::string last = history.text();
        for (std::size_t i = 0; i < steps; ++i) CHECK(history.undo());
        CHECK_FALSE(history.undo());
        CHECK(history.text() == first);
        while (history.redo()) {
        }
        CHECK(history.text() == last);
    }
    CHECK(done > 5000);
}

}  // namespace test_random_operations
