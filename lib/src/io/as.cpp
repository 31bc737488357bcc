#include <fmt/format.h>

#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <type_traits>

#include "io/json/utf8.hpp"
#include "phasetree/io/keys.hpp"
#include "phasetree/io/object_reader.hpp"

namespace phasetree {

namespace {

// A problem with a value. The message is "<subject> <complaint>", where the subject is the requested value or an item
// inside it.
struct Complaint {
    Value value;
    std::string text;
    std::string items = {};  // "item 3 of ", "item 1 of item 3 of ", …
};

using Checked = std::optional<Complaint>;

std::string shown(const Value& value) {
    return value.is_number() || value.is_boolean() ? io::printable(value.written(), 40)
                                                   : std::string(name_of(value.kind()));
}

Complaint must_be(Value value, std::string_view what) {
    return {value, fmt::format("must be {}, but is {}", what, name_of(value.kind()))};
}

template <class Number>
Checked read_number(Value value, const Range& range, Number& out) {
    constexpr bool is_integer = std::is_integral_v<Number>;
    if (!value.is_number()) return must_be(value, is_integer ? "a whole number" : "a number");
    const double number = value.number();
    const auto complain = [&](std::string_view what) {
        return Complaint{value, fmt::format("must be {}, but is {}", what, shown(value))};
    };
    if (is_integer && number != std::trunc(number)) return complain("a whole number");
    // Check the caller's range first: "positive" says more than the limits of the type.
    if (!range.contains(number)) return complain(describe(range));
    constexpr double lowest = static_cast<double>(std::numeric_limits<Number>::lowest());
    constexpr double highest = static_cast<double>(std::numeric_limits<Number>::max());
    if (number < lowest) return complain(fmt::format("at least {}", std::numeric_limits<Number>::lowest()));
    if (number > highest) return complain(fmt::format("at most {}", std::numeric_limits<Number>::max()));
    out = static_cast<Number>(number);
    // A positive double can become zero as a float. A float that would be subnormal is read as zero, which is what
    // tracing treats it as. Limits are rounded to floats in the same way; for example, 0.1 becomes slightly more.
    if constexpr (!is_integer) {
        if (std::abs(out) < std::numeric_limits<Number>::min()) out = std::copysign(Number(0), out);
        const auto as_number = [&](double limit) {
            return limit < lowest || limit > highest ? limit : static_cast<double>(static_cast<Number>(limit));
        };
        Range rounded = range;
        rounded.min = as_number(range.min);
        rounded.max = as_number(range.max);
        if (!rounded.contains(static_cast<double>(out))) return complain(describe(range) + " as a 32-bit float");
    }
    return std::nullopt;
}

float mixed(float a, float b, double share) {
    return static_cast<float>(std::lerp(static_cast<double>(a), static_cast<double>(b), share));
}
double mixed(double a, double b, double share) {
    return std::lerp(a, b, share);
}
template <glm::length_t n, class Number>
glm::vec<n, Number> mixed(glm::vec<n, Number> a, const glm::vec<n, Number>& b, double share) {
    for (glm::length_t i = 0; i < n; ++i) a[i] = mixed(a[i], b[i], share);
    return a;
}

// The value of keyframes at the document's time. All of them are read, so that mistakes are found whatever the time is.
template <class T, class ReadOne>
T of_keys(const Document& document, const Keys& keys, ReadOne&& read_one) {
    const Keys::Place place = keys.at(document.seconds());
    T before{}, after{};
    for (std::size_t i = 0; i < keys.count(); ++i) {
        const T value = read_one(keys.value(i));
        if (i == place.before) before = value;
        if (i == place.before + 1) after = value;
    }
    return place.share > 0 ? mixed(before, after, place.share) : before;
}

template <class T>
Checked read_keys(const Document& document, Value value, const Range& range, T& out);

template <class Number>
Checked read_number_or_keys(const Document& document, Value value, const Range& range, Number& out) {
    if (Keys::are_in(value)) return read_keys(document, value, range, out);
    return read_number(value, range, out);
}

Checked read(const Document& document, Value value, const Range& range, float& out) {
    return read_number_or_keys(document, value, range, out);
}
Checked read(const Document& document, Value value, const Range& range, double& out) {
    return read_number_or_keys(document, value, range, out);
}
Checked read(const Document&, Value value, const Range& range, int& out) {
    return read_number(value, range, out);
}
Checked read(const Document&, Value value, const Range& range, unsigned& out) {
    return read_number(value, range, out);
}

Checked read(const Document&, Value value, const Range&, bool& out) {
    if (!value.is_boolean()) return must_be(value, "true or false");
    out = value.boolean();
    return std::nullopt;
}

Checked read(const Document&, Value value, const Range&, std::string& out) {
    if (!value.is_string()) return must_be(value, "a string");
    out = value.string();
    return std::nullopt;
}

// "item 2 of …", counting from 1.
Complaint inside(Complaint complaint, std::size_t index) {
    complaint.items += fmt::format("item {} of ", index + 1);
    return complaint;
}

template <glm::length_t n, class Number>
Checked read(const Document& document, Value value, const Range& range, glm::vec<n, Number>& out) {
    if (Keys::are_in(value)) return read_keys(document, value, range, out);
    constexpr std::string_view what = n == 2   ? "two numbers [x, y]"
                                      : n == 3 ? "three numbers [x, y, z]"
                                               : "four numbers [x, y, z, w]";
    if (!value.is_array()) return must_be(value, what);
    if (value.size() != n) return Complaint{value, fmt::format("must be {}, but has {}", what, value.size())};
    for (glm::length_t i = 0; i < n; ++i) {
        const std::size_t index = static_cast<std::size_t>(i);
        if (const Checked wrong = read(document, value[index], range, out[i])) return inside(*wrong, index);
    }
    return std::nullopt;
}

template <class Item>
Checked read(const Document& document, Value value, const Range& range, std::vector<Item>& out) {
    if (!value.is_array()) return must_be(value, "an array");
    out.clear();
    out.reserve(value.size());
    for (const Value item_value : value) {
        Item item{};
        if (const Checked wrong = read(document, item_value, range, item)) return inside(*wrong, out.size());
        out.push_back(std::move(item));
    }
    return std::nullopt;
}

template <class T>
Checked read_keys(const Document& document, Value value, const Range& range, T& out) {
    Checked wrong;
    out = of_keys<T>(document, Keys(document, value, "the animated value"), [&](Value one) {
        T read_out{};
        if (!wrong) wrong = read(document, one, range, read_out);
        return read_out;
    });
    return wrong;
}

SceneError error_of(const Document& document, std::string_view what, const Complaint& complaint) {
    return document.error(complaint.value, fmt::format("{}{} {}", complaint.items, what, complaint.text));
}

// IEC 61966-2-1; the encoded value is in 0 … 1.
float linear_of_srgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

std::optional<unsigned> hexadecimal(char c) {
    if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
    if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a') + 10;
    if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A') + 10;
    return std::nullopt;
}

std::optional<glm::vec3> linear_of_hexadecimal(std::string_view text) {
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    glm::vec3 colour{};
    for (glm::length_t i = 0; i < 3; ++i) {
        const std::size_t at = 1 + 2 * static_cast<std::size_t>(i);
        const auto high = hexadecimal(text[at]), low = hexadecimal(text[at + 1]);
        if (!high || !low) return std::nullopt;
        colour[i] = linear_of_srgb(static_cast<float>(16 * *high + *low) / 255.0f);
    }
    return colour;
}

}  // namespace

template <Readable T>
T as(const Document& document, Value value, std::string_view what, const Range& range) {
    T out{};
    if (const Checked wrong = read(document, value, range, out)) throw error_of(document, what, *wrong);
    return out;
}

glm::vec3 as_colour(const Document& document, Value value, std::string_view what, const Range& range) {
    constexpr std::string_view either = "[r, g, b] or \"#rrggbb\"";
    if (Keys::are_in(value))
        return of_keys<glm::vec3>(document, Keys(document, value, "the animated value"),
                                  [&](Value one) { return as_colour(document, one, what, range); });
    if (value.is_string()) {
        const auto colour = linear_of_hexadecimal(value.string());
        if (!colour) {
            throw document.error(value,
                                 fmt::format("{} must be {}, but is {}", what, either, io::in_quotes(value.string())));
        }
        for (glm::length_t i = 0; i < 3; ++i) {
            if (range.contains(static_cast<double>((*colour)[i]))) continue;
            throw document.error(value, fmt::format("{} must be {} in each component, but {} is {} in linear light",
                                                    what, describe(range), value.string(), (*colour)[i]));
        }
        return *colour;
    }
    if (!value.is_array()) throw error_of(document, what, must_be(value, either));
    if (value.size() != 3) {
        throw document.error(value, fmt::format("{} must be {}, but has {}", what, either, value.size()));
    }
    return as<glm::vec3>(document, value, what, range);
}

// All types that Readable allows.
template bool as<bool>(const Document&, Value, std::string_view, const Range&);
template int as<int>(const Document&, Value, std::string_view, const Range&);
template unsigned as<unsigned>(const Document&, Value, std::string_view, const Range&);
template float as<float>(const Document&, Value, std::string_view, const Range&);
template double as<double>(const Document&, Value, std::string_view, const Range&);
template std::string as<std::string>(const Document&, Value, std::string_view, const Range&);
template glm::vec2 as<glm::vec2>(const Document&, Value, std::string_view, const Range&);
template glm::vec3 as<glm::vec3>(const Document&, Value, std::string_view, const Range&);
template glm::vec4 as<glm::vec4>(const Document&, Value, std::string_view, const Range&);
template glm::dvec2 as<glm::dvec2>(const Document&, Value, std::string_view, const Range&);
template glm::dvec3 as<glm::dvec3>(const Document&, Value, std::string_view, const Range&);
template glm::dvec4 as<glm::dvec4>(const Document&, Value, std::string_view, const Range&);
template std::vector<bool> as<std::vector<bool>>(const Document&, Value, std::string_view, const Range&);
template std::vector<int> as<std::vector<int>>(const Document&, Value, std::string_view, const Range&);
template std::vector<unsigned> as<std::vector<unsigned>>(const Document&, Value, std::string_view, const Range&);
template std::vector<float> as<std::vector<float>>(const Document&, Value, std::string_view, const Range&);
template std::vector<double> as<std::vector<double>>(const Document&, Value, std::string_view, const Range&);
template std::vector<std::string> as<std::vector<std::string>>(const Document&, Value, std::string_view, const Range&);
template std::vector<glm::vec2> as<std::vector<glm::vec2>>(const Document&, Value, std::string_view, const Range&);
template std::vector<glm::vec3> as<std::vector<glm::vec3>>(const Document&, Value, std::string_view, const Range&);
template std::vector<glm::vec4> as<std::vector<glm::vec4>>(const Document&, Value, std::string_view, const Range&);
template std::vector<glm::dvec2> as<std::vector<glm::dvec2>>(const Document&, Value, std::string_view, const Range&);
template std::vector<glm::dvec3> as<std::vector<glm::dvec3>>(const Document&, Value, std::string_view, const Range&);
template std::vector<glm::dvec4> as<std::vector<glm::dvec4>>(const Document&, Value, std::string_view, const Range&);

}  // namespace phasetree
