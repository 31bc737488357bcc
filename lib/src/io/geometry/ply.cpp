#include "io/geometry/ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "phasetree/io/error.hpp"

namespace phasetree::io {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are read as they stand in little-endian files");

struct NamedType {
    std::string_view name, other_name;
    std::size_t bytes;
};
constexpr std::array<NamedType, 8> types{{{"char", "int8", 1},
                                          {"uchar", "uint8", 1},
                                          {"short", "int16", 2},
                                          {"ushort", "uint16", 2},
                                          {"int", "int32", 4},
                                          {"uint", "uint32", 4},
                                          {"float", "float32", 4},
                                          {"double", "float64", 8}}};
constexpr std::size_t most_properties = 1000;
constexpr double longest_list = 1 << 25;

std::optional<Ply::Type> type_of(std::string_view name) {
    const auto found =
        std::ranges::find_if(types, [&](const NamedType& t) { return name == t.name || name == t.other_name; });
    if (found == types.end()) return std::nullopt;
    return static_cast<Ply::Type>(found - types.begin());
}
std::size_t bytes_of(Ply::Type type) {
    return types[static_cast<std::size_t>(type)].bytes;
}

template <class Number>
double as_number(const std::array<char, 8>& bytes) {
    Number n;
    std::memcpy(&n, bytes.data(), sizeof n);
    return static_cast<double>(n);
}
double as_number(const std::array<char, 8>& bytes, Ply::Type type) {
    switch (type) {
        case Ply::Type::int8:
            return as_number<std::int8_t>(bytes);
        case Ply::Type::uint8:
            return as_number<std::uint8_t>(bytes);
        case Ply::Type::int16:
            return as_number<std::int16_t>(bytes);
        case Ply::Type::uint16:
            return as_number<std::uint16_t>(bytes);
        case Ply::Type::int32:
            return as_number<std::int32_t>(bytes);
        case Ply::Type::uint32:
            return as_number<std::uint32_t>(bytes);
        case Ply::Type::float32:
            return as_number<float>(bytes);
        case Ply::Type::float64:
            return as_number<double>(bytes);
    }
    return 0;
}

}  // namespace

std::optional<std::size_t> Ply::Element::find(std::string_view property) const {
    const auto found = std::ranges::find(properties, property, &Property::name);
    if (found == properties.end()) return std::nullopt;
    return static_cast<std::size_t>(found - properties.begin());
}

Ply::Ply(std::filesystem::path path, std::string_view content)
    : path_(std::move(path)), content_(content), words_(content) {
    read_header();
    rest_ = content_.substr(words_.offset());
    check_claims();
}

void Ply::fail(std::string_view what) const {
    throw SceneError(path_.string(), fmt::format("{} (line {})", what, words_.number()));
}
void Ply::fail(const Element& element, std::string_view what) const {
    throw SceneError(path_.string(), fmt::format("{} (row {} of its {})", what, row_,
                                                 element.name == "face"        ? "faces"
                                                 : element.name == "tristrips" ? "triangle strips"
                                                 : element.name == "vertex"    ? "vertices"
                                                                               : "elements"));
}

void Ply::read_header() {
    if (!words_.next_line() || words_.word() != "ply") fail("is not a PLY file: it does not begin with \"ply\"");
    bool has_format = false;
    while (words_.next_line()) {
        const std::string_view kind = words_.word();
        if (kind == "end_header") {
            if (!has_format) fail("the header names no format");
            return;
        }
        if (kind == "format") {
            const std::string_view name = words_.word();
            if (name == "ascii")
                format_ = Format::words;
            else if (name == "binary_little_endian")
                format_ = Format::little_endian;
            else if (name == "binary_big_endian")
                format_ = Format::big_endian;
            else
                fail("the header names an unknown format");
            has_format = true;
        } else if (kind == "element") {
            const std::string name(words_.word());
            const auto rows = number_of<std::uint64_t>(words_.word());
            if (name.empty() || !rows) fail("an element needs a name and a number of rows");
            if (elements_.size() == most_properties) fail("the header has too many elements");
            elements_.push_back({name, *rows, {}});
        } else if (kind == "property") {
            add_property();
        }
    }
    fail("the header has no end");
}

void Ply::add_property() {
    if (elements_.empty()) fail("a property comes before the first element");
    std::string_view word = words_.word();
    Property property;
    if (word == "list") {
        property.count = type_of(words_.word());
        if (!property.count || *property.count >= Type::float32) fail("the length of a list has an unknown type");
        word = words_.word();
    }
    const auto type = type_of(word);
    if (!type) fail("a property has an unknown type");
    property.type = *type;
    property.name = words_.word();
    if (elements_.back().properties.size() == most_properties) fail("an element has too many properties");
    elements_.back().properties.push_back(property);
}

void Ply::check_claims() const {
    std::uint64_t left = rest_.size();
    for (const Element& e : elements_) {
        std::uint64_t least = 0;  // minimum number of bytes per row
        for (const Property& p : e.properties)
            least += format_ == Format::words ? 2 : bytes_of(p.count.value_or(p.type));
        if (e.rows == 0) continue;
        // The last word need not be followed by a blank.
        if (least == 0 || e.rows > (left + 1) / least)
            throw SceneError(path_.string(), "is shorter than its header declares");
        left -= std::min(left, e.rows * least);
    }
}

double Ply::read(const Element& element, Type type) {
    if (format_ == Format::words) {
        const std::string_view word = words_.word_of_any_line();
        if (word.empty()) fail(element, "the file ends too early");
        const auto number = number_or_nan<double>(word);
        if (!number) fail(element, "expected a number");
        return *number;
    }
    const std::size_t count = bytes_of(type);
    if (rest_.size() < count) fail(element, "the file ends too early");
    std::array<char, 8> bytes{};
    for (std::size_t i = 0; i < count; ++i) bytes[format_ == Format::big_endian ? count - 1 - i : i] = rest_[i];
    rest_.remove_prefix(count);
    return as_number(bytes, type);
}

double Ply::number(const Element& element, const Row& row, std::size_t property) const {
    const std::vector<double>& values = row[property];
    if (values.size() != 1)
        fail(element, fmt::format("its {} must be a single number", element.properties[property].name));
    if (!std::isfinite(values[0]))
        fail(element, fmt::format("its {} is not a number", element.properties[property].name));
    return values[0];
}

void Ply::read_row(const Element& element, Row& row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
        const Property& p = element.properties[i];
        row[i].clear();
        std::uint64_t count = 1;
        if (p.count) {
            const double length = read(element, *p.count);
            if (!(length >= 0 && length <= longest_list)) fail(element, "a list has an invalid length");
            count = static_cast<std::uint64_t>(length);
        }
        for (; count > 0; --count) row[i].push_back(read(element, p.type));
    }
}

}  // namespace phasetree::io
