#include "studio/pointer.hpp"

#include <fmt/format.h>

#include <charconv>
#include <span>
#include <stdexcept>

#include "phasetree/io/suggest.hpp"

namespace phasetree::tracer::studio {

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

PointerTokens pointer_tokens(std::string_view pointer) {
    PointerTokens tokens;
    if (pointer.empty()) return tokens;
    if (pointer[0] != '/')
        throw std::invalid_argument(
            fmt::format("\"{}\" is not a JSON pointer: it must be empty or begin with \"/\"", pointer));
    for (std::size_t i = 0; i < pointer.size(); ++i) {
        if (pointer[i] == '/') {
            tokens.emplace_back();
        } else if (pointer[i] != '~') {
            tokens.back() += pointer[i];
        } else {
            const char next = i + 1 < pointer.size() ? pointer[++i] : ' ';
            if (next != '0' && next != '1')
                throw std::invalid_argument(
                    fmt::format("\"{}\" is not a JSON pointer: \"~\" must be written \"~0\"", pointer));
            tokens.back() += next == '0' ? '~' : '/';
        }
    }
    return tokens;
}

std::string pointer_of(const PointerTokens& tokens) {
    std::string pointer;
    for (const std::string& token : tokens) pointer += "/" + escaped(token);
    return pointer;
}

std::optional<std::size_t> index_of(std::string_view token) {
    if (token.empty() || (token.size() > 1 && token[0] == '0')) return std::nullopt;
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), index);
    if (error != std::errc() || end != token.data() + token.size()) return std::nullopt;
    return index;
}

std::string count_of_items(std::size_t count) {
    return fmt::format("{} item{}", count, count == 1 ? "" : "s");
}

std::optional<Value> child_of(Value value, std::string_view token) {
    if (value.is_object()) return value.find(token);
    if (!value.is_array()) return std::nullopt;
    const std::optional<std::size_t> index = index_of(token);
    if (!index || *index >= value.size()) return std::nullopt;
    return value[*index];
}

Value value_at(const Document& document, std::string_view pointer) {
    Value value = document.root();
    for (const std::string& token : pointer_tokens(pointer)) {
        const std::optional<Value> child = child_of(value, token);
        if (child) {
            value = *child;
            continue;
        }
        if (value.is_object()) {
            std::vector<std::string_view> keys;
            for (const Value member : value) keys.push_back(member.key());
            throw document.error(value, fmt::format("there is no \"{}\" here, so nothing is at {}", token, pointer),
                                 closest(token, std::span<const std::string_view>(keys)));
        }
        if (value.is_array())
            throw document.error(
                value, fmt::format("the list has {}, so nothing is at {}", count_of_items(value.size()), pointer));
        throw document.error(value,
                             fmt::format("{} has no parts, so nothing is at {}", name_of(value.kind()), pointer));
    }
    return value;
}

}  // namespace phasetree::tracer::studio
