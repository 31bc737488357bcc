#include "phasetree/io/object_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/glm.hpp>

#include "io/json/utf8.hpp"
#include "phasetree/io/suggest.hpp"

namespace phasetree {

ObjectReader::ObjectReader(const Document& document, Value object, std::string_view what)
    : document_(&document), object_(object), what_(what) {
    if (!object.is_object()) {
        throw document.error(object, fmt::format("{} must be an object, but is {}", what, name_of(object.kind())));
    }
}

std::string ObjectReader::quoted(std::string_view key) {
    return io::in_quotes(key);
}

bool ObjectReader::knows(std::string_view key) const {
    return std::ranges::any_of(known_,
                               [&](const std::string& known) { return known == key || is_other_spelling(key, known); });
}

void ObjectReader::allow(std::initializer_list<std::string_view> keys) {
    for (const std::string_view key : keys) {
        if (std::ranges::find(known_, key) == known_.end()) known_.emplace_back(key);
    }
}

std::optional<Value> ObjectReader::value(std::string_view key) {
    allow({key});
    const std::optional<Value> found = object_.find(key), other = value_in_other_spelling(key);
    if (found && other)
        throw document_->error(other->key_offset(), fmt::format("{} has both {} and {}; remove one of them", what_,
                                                                quoted(key), quoted(other->key())));
    return found ? found : other;
}

std::optional<Value> ObjectReader::value_in_other_spelling(std::string_view key) const {
    if (!has_other_spelling(key)) return std::nullopt;
    for (const Value member : object_)
        if (is_other_spelling(member.key(), key)) return member;
    return std::nullopt;
}

Value ObjectReader::required_value(std::string_view key) {
    if (const auto found = value(key)) return *found;
    // If a key is missing, the cause is usually a misspelt one.
    for (const Value member : object_) {
        if (!knows(member.key()) && closest(member.key(), {key})) {
            throw document_->error(member.key_offset(),
                                   fmt::format("{} needs {}, but has {}", what_, quoted(key), quoted(member.key())),
                                   std::string(key));
        }
    }
    throw document_->error(object_, fmt::format("{} needs {}", what_, quoted(key)));
}

glm::vec3 ObjectReader::required_colour(std::string_view key, const Range& range) {
    return as_colour(document(), required_value(key), quoted(key), range);
}

glm::vec3 ObjectReader::optional_colour(std::string_view key, const glm::vec3& fallback, const Range& range) {
    const std::optional<Value> found = value(key);
    return found ? as_colour(document(), *found, quoted(key), range) : fallback;
}

void ObjectReader::finish() const {
    for (const Value member : object_) {
        if (knows(member.key())) continue;
        std::string message = fmt::format("unknown key {} in {}", quoted(member.key()), what_);
        const auto meant = closest(member.key(), known_);
        if (!meant) message += valid_names("key", known_);
        throw document_->error(member.key_offset(), std::move(message), meant);
    }
}

}  // namespace phasetree
