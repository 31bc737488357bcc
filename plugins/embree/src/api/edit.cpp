// Edits a scene's text in place, keeping comments, layout and the line numbers in errors.

#include <charconv>

#include "api/tree_data.hpp"

namespace phasetree::embree::api {

namespace {

// Decodes one step of a pointer: "~1" is a slash and "~0" a tilde.
std::string unescaped(std::string_view pointer, std::string_view token) {
    std::string text;
    for (std::size_t i = 0; i < token.size(); ++i) {
        if (token[i] != '~') {
            text += token[i];
            continue;
        }
        const char next = i + 1 < token.size() ? token[++i] : '\0';
        if (next != '0' && next != '1')
            throw invalid("path \"{}\": \"~\" must be written ~0 (and \"/\" within a key ~1)", pointer);
        text += next == '0' ? '~' : '/';
    }
    return text;
}

Value value_at(const Document& document, std::string_view pointer) {
    Value at = document.root();
    if (pointer.empty()) return at;
    if (pointer[0] != '/') throw invalid("path \"{}\" must start with \"/\", as in \"/tree/sphere/radius\"", pointer);
    for (std::size_t begin = 1; begin <= pointer.size();) {
        const std::size_t end = std::min(pointer.find('/', begin), pointer.size());
        const std::string token = unescaped(pointer, pointer.substr(begin, end - begin));
        const std::string_view before = pointer.substr(0, begin - 1);
        if (at.is_object()) {
            const std::optional<Value> member = at.find(token);
            if (!member) throw invalid("path \"{}\": \"{}\" does not exist in \"{}\"", pointer, token, before);
            at = *member;
        } else if (at.is_array()) {
            std::size_t index = 0;
            const auto [stop, error] = std::from_chars(token.data(), token.data() + token.size(), index);
            if (error != std::errc() || stop != token.data() + token.size() || index >= at.size())
                throw invalid("path \"{}\": \"{}\" is a list of {}, which has no item \"{}\"", pointer, before,
                              at.size(), token);
            at = at[index];
        } else {
            throw invalid("path \"{}\": \"{}\" is {} and has no parts", pointer, before, name_of(at.kind()));
        }
        begin = end + 1;
    }
    return at;
}

}  // namespace

// The text must be valid JSON with comments.
std::size_t end_of(const std::string& text, const Value& value) {
    std::size_t at = value.offset();
    if (!value.is_string() && !value.is_array() && !value.is_object()) return at + value.written().size();
    const auto after_string = [&](std::size_t i) {
        for (++i; text[i] != '"'; ++i)
            if (text[i] == '\\') ++i;
        return i + 1;
    };
    int depth = 0;
    do {
        const char c = text[at];
        if (c == '"') {
            at = after_string(at);
            continue;
        }
        if (c == '/') {
            at = text[at + 1] == '/' ? text.find_first_of("\r\n", at) : text.find("*/", at + 2) + 2;
            continue;
        }
        if (c == '{' || c == '[') ++depth;
        if (c == '}' || c == ']') --depth;
        ++at;
    } while (depth > 0);
    return at;
}

std::string with_value(const Document& document, std::string_view pointer, std::string_view value) {
    // Parse the value separately first. An invalid value, or a comment after it, could otherwise change the meaning of
    // the surrounding text.
    const Document own = Document::from_text(std::string(value), fmt::format("the value for {}", pointer));
    const std::size_t begin = own.root().offset(), end = end_of(own.text(), own.root());
    const Value old = value_at(document, pointer);
    std::string text = document.text();
    text.replace(old.offset(), end_of(text, old) - old.offset(), own.text(), begin, end - begin);
    return text;
}

}  // namespace phasetree::embree::api
