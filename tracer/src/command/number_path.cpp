#include "command/number_path.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "command/errors.hpp"
#include "phasetree/io/keys.hpp"
#include "phasetree/io/suggest.hpp"

namespace phasetree::tracer {

namespace {

// At most this many keys are listed in an error.
constexpr std::size_t most_listed = 12;

void replace_all(std::string& text, std::string_view what, std::string_view by) {
    for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
}

[[noreturn]] void throw_no_member(const std::string& path, Value object, const std::string& key) {
    std::vector<std::string> keys;
    for (const Value member : object) keys.emplace_back(member.key());
    const auto meant = closest(key, keys);
    const bool lists = !meant && !keys.empty() && keys.size() <= most_listed;
    throw UsageError(fmt::format("--set: {} has no \"{}\"{}", path.empty() ? "the scene" : "\"" + path + "\"", key,
                                 meant   ? fmt::format(" (did you mean \"{}\"?)", *meant)
                                 : lists ? fmt::format(" (it has {})", fmt::join(keys, ", "))
                                         : ""));
}

// The member or item that a step of the path leads to.
Value child_of(Value value, const std::string& path, const std::string& step) {
    if (value.is_object()) {
        std::string key = step;
        replace_all(key, "~1", "/");
        replace_all(key, "~0", "~");
        const std::optional<Value> member = value.find(key);
        if (!member) throw_no_member(path, value, key);
        return *member;
    }
    if (!value.is_array())
        throw UsageError(fmt::format("--set: \"{}\" is {} and has no \"{}\"", path, name_of(value.kind()), step));
    const bool is_index = !step.empty() && step.size() < 10 && step.find_first_not_of("0123456789") == step.npos &&
                          (step.size() == 1 || step.front() != '0');
    const std::size_t index = is_index ? std::stoul(step) : value.size();
    if (index >= value.size())
        throw UsageError(value.size() == 0
                             ? fmt::format("--set: the list \"{}\" is empty", path)
                             : fmt::format("--set: \"{}\" is a list, whose items are 0 to {}, so it has no \"{}\"",
                                           path, value.size() - 1, step));
    return value[index];
}

// Which keyframe a number belongs to.
struct InKey {
    std::optional<double> seconds;  // the time of the keyframe whose value contains the number
    bool is_time = false;
};

// Sets `in_key` if the path leads into {"keys": [[seconds, value], …]}.
Value value_at(const Document& document, const std::string& pointer, InKey& in_key) {
    Value value = document.root();
    std::vector<std::string> steps;
    std::size_t at = 0;
    while (at < pointer.size()) {
        const std::size_t end = std::min(pointer.find('/', at + 1), pointer.size());
        const std::string step = pointer.substr(at + 1, end - at - 1);
        const bool is_item_of_key = steps.size() >= 2 && steps[steps.size() - 2] == "keys" && value.is_array() &&
                                    value.size() == 2 && value[0].is_number();
        if (is_item_of_key && step == "0") in_key.is_time = true;
        if (is_item_of_key && step == "1") in_key.seconds = value[0].number();
        steps.push_back(step);
        value = child_of(value, pointer.substr(0, at), step);
        at = end;
    }
    return value;
}

// The keyframes of a value, as paths that can be chosen.
std::string paths_of_keys(const std::string& pointer, Value keys) {
    std::vector<std::string> paths;
    for (std::size_t i = 0; i < std::min(keys.size(), most_listed); ++i)
        if (keys[i].is_array() && keys[i].size() == 2 && keys[i][0].is_number())
            paths.push_back(fmt::format("{}/keys/{}/1 (at {} s)", pointer, i, keys[i][0].number()));
    return fmt::format("{}{}", fmt::join(paths, ", "), keys.size() > most_listed ? " …" : "");
}

double number_of(const Document& document, const std::string& pointer, InKey& in_key) {
    bool is_escaped = true;  // each ~ is followed by 0 or 1
    for (std::size_t at = pointer.find('~'); at != pointer.npos; at = pointer.find('~', at + 1))
        is_escaped = is_escaped && at + 1 < pointer.size() && (pointer[at + 1] == '0' || pointer[at + 1] == '1');
    if (!pointer.starts_with('/') || !is_escaped)
        throw UsageError(
            fmt::format("--set: must be the path of a number in the scene file, such as "
                        "/tree/set/of/sphere/radius, but is \"{}\"",
                        pointer));
    const Value value = value_at(document, pointer, in_key);
    if (pointer == "/version") throw UsageError("--set: \"/version\" is the version of the scene format");
    if (value.is_number()) return value.number();
    if (value.is_object() && Keys::are_in(value) && value.find("keys")->is_array())
        throw UsageError(fmt::format("--set: \"{}\" has keyframes; choose the value of one of them: {}", pointer,
                                     paths_of_keys(pointer, *value.find("keys"))));
    std::vector<std::string> keys;
    for (const Value member : value) keys.emplace_back(member.key());
    const bool lists = value.is_object() && !keys.empty() && keys.size() <= most_listed;
    throw UsageError(fmt::format("--set: \"{}\" is {}, not a number{}", pointer, name_of(value.kind()),
                                 lists              ? fmt::format("; it has {}", fmt::join(keys, ", "))
                                 : value.is_array() ? "; append the index of an item, such as /0"
                                                    : ""));
}

// The bracket of PATH=LOW:HIGH.
void set_bracket(NumberToSet& number, const std::string& text) {
    const std::size_t colon = text.find(':');
    const auto is_number = [&](const std::string& part, double& to) {
        return CLI::detail::lexical_cast(part, to) && std::isfinite(to);
    };
    if (colon == text.npos || !is_number(text.substr(0, colon), number.low) ||
        !is_number(text.substr(colon + 1), number.high))
        throw UsageError(fmt::format("--set: the bracket must be LOW:HIGH, such as 0.1:0.5, but is \"{}\"", text));
    if (!(number.low < number.high))
        throw UsageError(fmt::format("--set: the bracket {} must have two ends, the lower one first", text));
}

}  // namespace

NumberToSet number_to_set(const std::string& text, const Document& document) {
    // A key in the path may contain "=", and then "/" may follow; neither is part of a bracket.
    const std::size_t split = text.rfind('=');
    const bool has_bracket = split != text.npos && text.find('/', split) == text.npos;
    NumberToSet number;
    number.pointer = text.substr(0, has_bracket ? split : text.npos);
    InKey in_key;
    const double there = number_of(document, number.pointer, in_key);
    number.key_seconds = in_key.seconds;
    number.is_time_of_key = in_key.is_time;
    if (has_bracket) {
        set_bracket(number, text.substr(split + 1));
        return number;
    }
    if (there == 0)
        throw UsageError(
            fmt::format("--set: the number at \"{}\" is 0, so it gives no bracket; give one, as in "
                        "{}=0.1:0.5",
                        number.pointer, number.pointer));
    number.low = std::min(0.5 * there, 2 * there);
    number.high = std::max(0.5 * there, 2 * there);
    if (!std::isfinite(number.low) || !std::isfinite(number.high))
        throw UsageError(fmt::format("--set: the number at \"{}\" is too large", number.pointer));
    return number;
}

}  // namespace phasetree::tracer
