#include "view/numbers.hpp"

#include <fmt/format.h>

namespace phasetree::tracer::view {

namespace {

// A key within a pointer (RFC 6901, Section 3).
std::string escaped(std::string_view key) {
    std::string result;
    for (const char c : key) {
        if (c == '~')
            result += "~0";
        else if (c == '/')
            result += "~1";
        else
            result += c;
    }
    return result;
}

// Calls visit(number, pointer) for each number of the text, in its order, and leave(value, pointer, whether there was
// any) behind each value.
template <class Visit, class Leave>
bool each_number(Value value, const std::string& pointer, const Visit& visit, const Leave& leave) {
    bool has_any = value.is_number();
    if (has_any) visit(value, pointer);
    std::size_t i = 0;
    for (const Value child : value) {
        const std::string name = value.is_object() ? escaped(child.key()) : std::to_string(i++);
        if (each_number(child, pointer + "/" + name, visit, leave)) has_any = true;
    }
    if (has_any) leave(value, pointer);
    return has_any;
}

}  // namespace

TextNumbers numbers_of(const Document& document) {
    TextNumbers result;
    const std::string& text = document.text();
    std::size_t line = 1, counted = 0;
    const auto add = [&](Value number, const std::string& pointer) {
        if (pointer == "/version") return;
        if (result.numbers.size() == TextNumbers::most) {
            result.has_more = true;
            return;
        }
        // Lines end as SceneError counts them: at LF, CR LF or CR.
        for (; counted < number.offset(); ++counted)
            if (text[counted] == '\n' || (text[counted] == '\r' && text[counted + 1] != '\n')) ++line;
        result.numbers.push_back({pointer, line, number.number()});
    };
    const auto leave = [&](Value value, const std::string& pointer) {
        if (!value.key().empty() && !result.has_more) result.members.emplace(value.key_offset(), pointer);
    };
    each_number(document.root(), "", add, leave);
    return result;
}

std::string with_numbers(const Document& document, const NumberEdits& edits) {
    const std::string& text = document.text();
    std::string result;
    std::size_t kept = 0;
    const auto replace = [&](Value number, const std::string& pointer) {
        const auto edit = edits.find(pointer);
        if (edit == edits.end() || edit->second == number.number()) return;
        result.append(text, kept, number.offset() - kept);
        result += fmt::format("{}", edit->second);
        kept = number.offset() + number.written().size();
    };
    each_number(document.root(), "", replace, [](Value, const std::string&) {});
    return result.append(text, kept);
}

}  // namespace phasetree::tracer::view
