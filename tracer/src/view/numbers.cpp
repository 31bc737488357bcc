#include "view/numbers.hpp"

#include <fmt/format.h>

#include "studio/pointer.hpp"

namespace phasetree::tracer::view {

namespace {

// Calls visit(number, pointer) for each number of the text, in order, and leave(value, pointer, whether it contained
// any) after each value.
template <class Visit, class Leave>
bool each_number(Value value, const std::string& pointer, const Visit& visit, const Leave& leave) {
    bool has_any = value.is_number();
    if (has_any) visit(value, pointer);
    std::size_t i = 0;
    for (const Value child : value) {
        const std::string name = value.is_object() ? studio::escaped(child.key()) : std::to_string(i++);
        if (each_number(child, pointer + "/" + name, visit, leave)) has_any = true;
    }
    if (has_any) leave(value, pointer);
    return has_any;
}

// Calls replace(number, replacement) for each edited number, in the order of the text.
template <class Replace>
void each_replacement(const Document& document, const NumberEdits& edits, const Replace& replace) {
    const auto visit = [&](Value number, const std::string& pointer) {
        const auto edit = edits.find(pointer);
        if (edit != edits.end() && edit->second != number.number()) replace(number, fmt::format("{}", edit->second));
    };
    if (!edits.empty()) each_number(document.root(), "", visit, [](Value, const std::string&) {});
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
        // Line endings as SceneError counts them: LF, CR LF or CR.
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
    each_replacement(document, edits, [&](Value number, const std::string& by) {
        result.append(text, kept, number.offset() - kept);
        result += by;
        kept = number.offset() + number.written().size();
    });
    return result.append(text, kept);
}

std::size_t offset_in_original(const Document& document, const NumberEdits& edits, std::size_t offset) {
    std::size_t longer = 0, shorter = 0;  // growth and shrinkage of the text before
    each_replacement(document, edits, [&](Value number, const std::string& by) {
        if (number.offset() + longer - shorter >= offset) return;
        longer += by.size();
        shorter += number.written().size();
    });
    return offset + shorter - longer;
}

}  // namespace phasetree::tracer::view
