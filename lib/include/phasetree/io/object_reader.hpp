#pragma once

#include <concepts>
#include <glm/fwd.hpp>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "phasetree/io/document.hpp"
#include "phasetree/io/range.hpp"

namespace phasetree {

namespace io {
template <class T, class... Ts>
concept one_of = (std::same_as<T, Ts> || ...);
template <class T>
concept readable_item = one_of<T, bool, int, unsigned, float, double, std::string, glm::vec2, glm::vec3, glm::vec4,
                               glm::dvec2, glm::dvec3, glm::dvec4>;
template <class T>
inline constexpr bool is_list = false;
template <readable_item T>
inline constexpr bool is_list<std::vector<T>> = true;
}  // namespace io

/// The types that a value can be read as: bool, int, unsigned, float, double, std::string, glm vectors of float and
/// double, and a std::vector of any of these.
template <class T>
concept Readable = io::readable_item<T> || io::is_list<T>;

/// Read a value as a T.
///
/// Every number, including those in vectors and lists, must be in the range and must fit its type: integers must be
/// whole, and floats must not overflow to infinity. Throws SceneError at the value, or at the item of an array. `what`
/// begins the message, e.g. `"radius"`.
template <Readable T>
T as(const Document& document, Value value, std::string_view what, const Range& range = {});

/// Read a colour in linear Rec.709 RGB. It is written as [r, g, b], three linear numbers, or as "#rrggbb" in sRGB,
/// which is decoded with the exact piecewise curve of IEC 61966-2-1. Each component must be in the range. Throws
/// SceneError.
glm::vec3 as_colour(const Document& document, Value value, std::string_view what,
                    const Range& range = Range::not_negative());

/// Reads the members of an object by key, in British or American spelling (is_other_spelling). It remembers all
/// requested keys, so that finish() can report unknown ones.
class ObjectReader {
  public:
    /// `what` names the object in messages: "the camera", "the sphere". The document must outlive the reader. Throws
    /// SceneError if the value is not an object.
    ObjectReader(const Document& document, Value object, std::string_view what);

    template <Readable T>
    T required(std::string_view key, const Range& range = {}) {
        return as<T>(document(), required_value(key), quoted(key), range);
    }

    /// Read an optional member. The fallback for a missing key is not checked against the range.
    template <Readable T>
    T optional(std::string_view key, T fallback, const Range& range = {}) {
        const std::optional<Value> found = value(key);
        return found ? as<T>(document(), *found, quoted(key), range) : fallback;
    }

    /// Read an optional member without a fallback.
    template <Readable T>
    std::optional<T> maybe(std::string_view key, const Range& range = {}) {
        const std::optional<Value> found = value(key);
        return found ? std::optional<T>(as<T>(document(), *found, quoted(key), range)) : std::nullopt;
    }

    glm::vec3 required_colour(std::string_view key, const Range& range = Range::not_negative());
    glm::vec3 optional_colour(std::string_view key, const glm::vec3& fallback,
                              const Range& range = Range::not_negative());

    /// The member itself, to be read by other code. Throws SceneError if it is given in both spellings.
    std::optional<Value> value(std::string_view key);
    Value required_value(std::string_view key);

    /// Mark keys as known without reading them.
    void allow(std::initializer_list<std::string_view> keys);

    /// Throw SceneError for the first unknown key. Call it when everything has been read.
    void finish() const;

    const Document& document() const { return *document_; }
    Value object() const { return object_; }
    const std::string& what() const { return what_; }

  private:
    static std::string quoted(std::string_view key);
    bool knows(std::string_view key) const;
    std::optional<Value> value_in_other_spelling(std::string_view key) const;

    const Document* document_;
    Value object_;
    std::string what_;
    std::vector<std::string> known_;
};

}  // namespace phasetree
