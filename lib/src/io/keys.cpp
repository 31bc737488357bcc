#include "phasetree/io/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "phasetree/io/object_reader.hpp"
#include "phasetree/io/suggest.hpp"

namespace phasetree {

namespace {

bool is_smooth(const Document& document, Value word) {
    const auto way = as<std::string>(document, word, "\"between\"");
    if (way == "smooth") return true;
    if (way == "linear") return false;
    throw document.error(word, fmt::format("\"between\" must be \"linear\" or \"smooth\", but is \"{}\"", way),
                         closest(way, {"linear", "smooth"}));
}

Value list_in(const Document& document, Value value, std::string_view what) {
    ObjectReader reader(document, value, what);
    const Value list = reader.required_value("keys");
    reader.allow({"between"});
    reader.finish();
    return list;
}

void collect_times(Value value, std::vector<double>& times) {
    if (const auto keys = value.find("keys"))
        for (const Value key : *keys)
            if (key.size() == 2 && key[0].is_number()) times.push_back(key[0].number());
    for (const Value member : value) collect_times(member, times);
}

}  // namespace

Keys::Keys(const Document& document, Value value, std::string_view what) : list_(list_in(document, value, what)) {
    if (!list_.is_array() || list_.size() < 2)
        throw document.error(list_, "\"keys\" must be a list of two or more [seconds, value]");
    if (list_.size() > most)
        throw document.error(list_, fmt::format("\"keys\" has {} keys; the limit is {}", list_.size(), most));
    if (const auto word = value.find("between")) is_smooth_ = is_smooth(document, *word);
    double before = -std::numeric_limits<double>::infinity();
    for (const Value key : list_) {
        if (!key.is_array() || key.size() != 2) throw document.error(key, "a key must be [seconds, value]");
        const auto now = as<double>(document, key[0], "the time of a key");
        if (!(now > before))
            throw document.error(
                key[0],
                fmt::format("a key must be later than the one before it, but {} s comes after {} s", now, before));
        if (are_in(key[1])) throw document.error(key[1], "the value of a key must not have keys");
        before = now;
    }
}

Keys::Place Keys::at(double now) const {
    std::size_t low = 0, high = count();  // The position is in [low, high).
    while (high - low > 1) {
        const std::size_t middle = low + (high - low) / 2;
        (seconds(middle) <= now ? low : high) = middle;
    }
    if (now <= seconds(0) || low + 1 == count()) return {low, 0};
    // Times may be so far apart that their difference overflows.
    const double share = (now / 2 - seconds(low) / 2) / (seconds(low + 1) / 2 - seconds(low) / 2);
    return {low, is_smooth_ ? share * share * (3 - 2 * share) : share};
}

std::vector<double> times_of_keys(Value value) {
    std::vector<double> times;
    collect_times(value, times);
    return times;
}

std::string schema_of_keys() {
    using Json = nlohmann::ordered_json;
    const Json key{
        {"type", "array"}, {"minItems", 2}, {"maxItems", 2}, {"items", {{{"type", "number"}}, Json::object()}}};
    return Json{
        {"type", "object"},
        {"description", "Values at increasing times in seconds, with linear or smooth interpolation in between."},
        {"properties",
         {{"keys", {{"type", "array"}, {"minItems", 2}, {"maxItems", Keys::most}, {"items", key}}},
          {"between", {{"enum", {"linear", "smooth"}}, {"default", "linear"}}}}},
        {"required", {"keys"}},
        {"additionalProperties", false}}
        .dump();
}

std::string schema_of_keyed(const std::string& schema) {
    using Json = nlohmann::ordered_json;
    return Json{{"anyOf", {{{"$ref", "#/definitions/keys"}}, Json::parse(schema)}}}.dump();
}

}  // namespace phasetree
