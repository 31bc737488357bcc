#include "fuzz/mutate.hpp"

#include <fmt/format.h>

#include <cstdlib>

namespace phasetree::fuzz {

namespace {

// Numbers at which programs break: the ends of types, what rounds, what is almost another.
constexpr std::string_view numbers[] = {
    "0",    "-0",    "1",      "-1",  "2",        "3",   "7",     "63",         "64",          "65",         "255",
    "0.5",  "-0.25", "1e-3",   "1e3", "1e-7",     "1e7", "1e-20", "1e20",       "1e-38",       "1e-45",      "3.4e38",
    "1e39", "1e308", "1e-320", "360", "16777217", "0.1", "100",   "2147483647", "-2147483648", "4294967296", "1e18",
};

// A part of a text.
struct Part {
    std::size_t begin = 0, end = 0;
};

bool is_number_character(char c) {
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.' || c == 'e' || c == 'E';
}

// What of a text looks like a number, whatever is around it.
std::vector<Part> numbers_of(const std::string& text) {
    std::vector<Part> found;
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i;
        bool has_digit = false;
        for (; end < text.size() && is_number_character(text[end]); ++end)
            has_digit = has_digit || (text[end] >= '0' && text[end] <= '9');
        if (has_digit) found.push_back({i, end});
        i = std::max(end, i + 1);
    }
    return found;
}

struct JsonParts {
    std::vector<Part> values;  // of any kind, also objects and lists whole
    std::vector<Part> items;   // values with their keys
    std::vector<Part> words;   // what stands in quotes, without them
};

// Bears texts that are no JSON.
JsonParts parts_of(const std::string& text) {
    JsonParts parts;
    std::vector<std::size_t> open;
    std::vector<std::size_t> item{0};  // where the member that is being read begins, at each depth
    const auto add = [&](std::size_t begin, std::size_t end) {
        parts.values.push_back({begin, end});
        parts.items.push_back({std::min(item.back(), begin), end});
    };
    bool fresh = true;  // no part of this member was seen yet
    for (std::size_t i = 0; i < text.size();) {
        const char c = text[i];
        if (fresh && c != ' ' && c != '\n' && c != '\r' && c != '\t' && c != ',') {
            item.back() = i;
            fresh = false;
        }
        if (c == '"') {
            std::size_t end = i + 1;
            while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2 : 1;
            end = std::min(end + 1, text.size());
            parts.words.push_back({i + 1, std::max(end - 1, i + 1)});
            const std::size_t next = text.find_first_not_of(" \t\r\n", end);
            if (next == std::string::npos || text[next] != ':') add(i, end);
            i = end;
        } else if (c == '{' || c == '[') {
            open.push_back(i++);
            item.push_back(i);
            fresh = true;
        } else if (c == '}' || c == ']') {
            ++i;
            if (open.empty()) continue;
            item.pop_back();
            add(open.back(), i);
            open.pop_back();
            fresh = false;
        } else if (c == ',' || c == ':' || c == ' ' || c == '\n' || c == '\r' || c == '\t') {
            if (c == ',') fresh = true;
            ++i;
        } else {
            const std::size_t end = std::min(text.find_first_of(",:{}[]\" \t\r\n", i), text.size());
            add(i, end);
            i = std::max(end, i + 1);
        }
    }
    return parts;
}

std::string replaced(const std::string& text, Part part, std::string_view by) {
    return fmt::format("{}{}{}", std::string_view(text).substr(0, part.begin), by,
                       std::string_view(text).substr(part.end));
}

std::string other_number(const std::string& old, Random& random) {
    if (random.below(2) == 0) return std::string(random.of(numbers));
    const double v = std::strtod(old.c_str(), nullptr);
    constexpr double factors[] = {-1, 0.5, 2, 0.9, 1.1, 1.0000001, 10, 0.1, 1000, 0.001};
    return fmt::format("{}",
                       random.below(4) == 0 ? static_cast<double>(random.below(41)) - 20 : v * random.of(factors));
}

std::string with_other_number(const std::string& text, Random& random) {
    const std::vector<Part> found = numbers_of(text);
    if (found.empty()) return text;
    const Part at = random.of(found);
    return replaced(text, at, other_number(text.substr(at.begin, at.end - at.begin), random));
}

std::string with_other_bytes(std::string text, Random& random) {
    if (text.empty()) return std::string(1, static_cast<char>(random()));
    const std::size_t at = random.below(text.size()), length = std::min(random.below(16) + 1, text.size() - at);
    switch (random.below(6)) {
        case 0:
            text[at] = static_cast<char>(static_cast<unsigned char>(text[at]) ^ (1u << random.below(8)));
            return text;
        case 1:
            text[at] = static_cast<char>(random());
            return text;
        case 2:
            return text.erase(at, length);
        case 3:
            return text.insert(random.below(text.size()), text.substr(at, length));
        case 4:
            for (std::size_t i = 0; i < length && i < 4; ++i)
                text[at + i] = random.below(2) == 0 ? '\0' : static_cast<char>(0xff);
            return text;
        default:
            return text.substr(0, at);
    }
}

std::string with_other_line(const std::string& text, const std::vector<std::string>& words, Random& random) {
    std::vector<Part> lines;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
        lines.push_back({begin, end});
        begin = end;
    }
    if (lines.empty()) return random.of(words);
    const Part one = random.of(lines), other = random.of(lines);
    const std::string copy = text.substr(other.begin, other.end - other.begin);
    switch (random.below(3)) {
        case 0:
            return replaced(text, one, "");
        case 1:
            return replaced(text, one, copy);
        default:
            return replaced(text, {one.begin, one.begin}, copy);
    }
}

std::string with_other_json(const std::string& text, const std::vector<std::string>& words, Random& random) {
    const JsonParts parts = parts_of(text);
    if (parts.values.empty() || parts.words.empty()) return with_other_bytes(text, random);
    const Part value = random.of(parts.values), item = random.of(parts.items);
    const auto copy = [&](Part p) { return text.substr(p.begin, p.end - p.begin); };
    switch (random.below(7)) {
        case 0:
            return replaced(text, value, copy(random.of(parts.values)));
        case 1: {  // with a comma, on whichever side it is
            const std::size_t next = text.find_first_not_of(" \t\r\n", item.end);
            if (next != std::string::npos && text[next] == ',') return replaced(text, {item.begin, next + 1}, "");
            const std::size_t last = item.begin == 0 ? 0 : text.find_last_not_of(" \t\r\n", item.begin - 1);
            const bool is_last = last != std::string::npos && text[last] == ',';
            return replaced(text, {is_last ? last : item.begin, item.end}, "");
        }
        case 2:
            return replaced(text, {item.begin, item.begin}, copy(random.of(parts.items)) + ", ");
        case 3:
            return replaced(text, random.of(parts.words), random.of(words));
        case 4:
            return replaced(text, random.of(parts.words), copy(random.of(parts.words)));
        case 5:
            return replaced(text, value, fmt::format("{{\"{}\": {{\"of\": {}}}}}", random.of(words), copy(value)));
        default:
            return replaced(text, {item.begin, item.begin},
                            fmt::format("\"{}\": {}, ", random.of(words), random.of(numbers)));
    }
}

}  // namespace

std::string mutated(const std::string& input, Inputs inputs, const std::vector<std::string>& words, Random& random) {
    const std::size_t kind = random.below(8);
    if (inputs == Inputs::bytes || kind == 0) return with_other_bytes(input, random);
    if (kind <= 3) return with_other_number(input, random);
    return inputs == Inputs::lines ? with_other_line(input, words, random) : with_other_json(input, words, random);
}

}  // namespace phasetree::fuzz
