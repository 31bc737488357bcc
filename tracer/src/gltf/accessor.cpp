#include "gltf/accessor.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "gltf/accessors.hpp"

namespace phasetree::tracer::gltf {

namespace {

template <class Number>
Number at(std::string_view bytes, std::size_t offset) {
    Number n;
    std::memcpy(&n, bytes.data() + offset, sizeof n);
    return n;
}

// Rows without bytes take memory when they are read, and a small file can declare billions.
constexpr std::size_t most_rows_of_zeros = 10'000'000;

}  // namespace

std::size_t Accessor::columns_of(const Item& accessor) {
    const std::string type = accessor.text("type");
    for (const auto& [name, columns] : {std::pair("SCALAR", 1), {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}})
        if (type == name) return static_cast<std::size_t>(columns);
    accessor.fail("has a \"type\" other than SCALAR, VEC2, VEC3, VEC4 and MAT4");
}

std::optional<Accessor::Type> Accessor::type_of(std::size_t number) {
    for (const Type type : {Type::int8, Type::uint8, Type::int16, Type::uint16, Type::uint32, Type::float32})
        if (number == static_cast<std::size_t>(type)) return type;
    return std::nullopt;
}

std::size_t Accessor::size_of(Type type) {
    if (type == Type::int8 || type == Type::uint8) return 1;
    return type == Type::int16 || type == Type::uint16 ? 2 : 4;
}

Accessor::Rows Accessor::rows_in(std::string_view bytes, std::size_t stride, std::size_t offset, std::size_t count,
                                 Type type, std::size_t columns, const Item& item) {
    const std::size_t row = size_of(type) * columns;
    // Some programs write 0 for "no stride".
    if (stride == 0) stride = row;
    if (stride < row) item.fail("has rows that overlap");
    if (offset > bytes.size()) item.fail("extends beyond the end of its bytes");
    bytes.remove_prefix(offset);
    if (count > 0 && (bytes.size() < row || (bytes.size() - row) / stride < count - 1))
        item.fail("extends beyond the end of its bytes");
    return {bytes, stride, type};
}

Accessor::Accessor(const Document& document, std::size_t index, const Item& from)
    : item_(document.element("accessors", index, from)),
      rows_(item_.needed_index("count")),
      columns_(columns_of(item_)),
      is_normalised_(item_.flag("normalized")) {
    const auto type = type_of(item_.needed_index("componentType"));
    if (!type) fail("has an unknown \"componentType\"");
    values_.type = *type;
}

Accessor::Accessor(Accessors& all, std::size_t index, const Item& from) : Accessor(all.document(), index, from) {
    const auto view = item_.index("bufferView");
    const auto sparse = item_.item("sparse");
    if (view) {
        const std::string_view bytes = all.bytes_of_view(*view, item_);
        const std::size_t stride = all.document().element("bufferViews", *view, item_).index("byteStride").value_or(0);
        values_ = rows_in(bytes, stride, item_.index("byteOffset").value_or(0), rows_, values_.type, columns_, item_);
        has_values_ = true;
    } else if (rows_ > most_rows_of_zeros) {
        fail("has more than 10 million rows but no \"bufferView\" for them");
    }
    if (sparse) read_replacements(all, index, *sparse);
}

Accessor::Accessor(const Document& document, std::size_t index, const Item& from, std::string_view decoded,
                   bool is_uint32)
    : Accessor(document, index, from) {
    if (is_uint32) values_.type = Type::uint32;
    values_ = rows_in(decoded, 0, 0, rows_, values_.type, columns_, item_);
    has_values_ = true;
}

void Accessor::read_replacements(Accessors& all, std::size_t index, const Item& sparse) {
    const auto indices = sparse.item("indices"), values = sparse.item("values");
    if (!indices || !values) sparse.fail("must have \"indices\" and \"values\"");
    Replacements r;
    r.count = sparse.needed_index("count");
    if (r.count > rows_) sparse.fail("has a larger \"count\" than its accessor");
    const auto type = type_of(indices->needed_index("componentType"));
    if (type != Type::uint8 && type != Type::uint16 && type != Type::uint32)
        indices->fail("has a \"componentType\" other than 5121, 5123 and 5125");
    const auto rows = [&](const Item& item, Type of, std::size_t columns) {
        const std::string_view bytes = all.bytes_of_view(item.needed_index("bufferView"), item);
        return rows_in(bytes, 0, item.index("byteOffset").value_or(0), r.count, of, columns, item);
    };
    r.indices = rows(*indices, *type, 1);
    r.values = rows(*values, values_.type, columns_);
    if (all.must_check(index, r.count))
        for (std::size_t i = 0; i < r.count; ++i) {
            const std::size_t row = r.indices.whole_number(i);
            if (row >= rows_) indices->fail("refers to a row beyond the end of its accessor");
            if (i > 0 && row <= r.indices.whole_number(i - 1))
                indices->fail("must increase strictly, but a number is not larger than the one before it");
        }
    replacements_ = r;
}

std::optional<std::size_t> Accessor::Replacements::of(std::size_t row) const {
    std::size_t low = 0, high = count;
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        if (indices.whole_number(middle) < row)
            low = middle + 1;
        else
            high = middle;
    }
    return low < count && indices.whole_number(low) == row ? std::optional(low) : std::nullopt;
}

Accessor::Place Accessor::place_of(std::size_t row) const {
    if (replacements_)
        if (const auto replacement = replacements_->of(row)) return {&replacements_->values, *replacement};
    return {has_values_ ? &values_ : nullptr, row};
}

double Accessor::Rows::number(std::size_t row, std::size_t column) const {
    const std::size_t offset = row * stride;
    switch (type) {
        case Type::int8:
            return at<std::int8_t>(bytes, offset + column);
        case Type::uint8:
            return at<std::uint8_t>(bytes, offset + column);
        case Type::int16:
            return at<std::int16_t>(bytes, offset + 2 * column);
        case Type::uint16:
            return at<std::uint16_t>(bytes, offset + 2 * column);
        case Type::uint32:
            return at<std::uint32_t>(bytes, offset + 4 * column);
        case Type::float32:
            return static_cast<double>(at<float>(bytes, offset + 4 * column));
    }
    return 0;
}

std::uint32_t Accessor::Rows::whole_number(std::size_t row) const {
    const std::size_t offset = row * stride;
    if (type == Type::uint8) return at<std::uint8_t>(bytes, offset);
    return type == Type::uint16 ? at<std::uint16_t>(bytes, offset) : at<std::uint32_t>(bytes, offset);
}

double Accessor::number(std::size_t row, std::size_t column) const {
    const Place place = place_of(row);
    if (!place.rows) return 0;
    const double value = place.rows->number(place.row, column);
    if (!is_normalised_) return value;
    switch (values_.type) {
        case Type::int8:
            return std::max(value / 127, -1.0);
        case Type::uint8:
            return value / 255;
        case Type::int16:
            return std::max(value / 32767, -1.0);
        case Type::uint16:
            return value / 65535;
        default:
            return value;
    }
}

double Accessor::finite_number(std::size_t row, std::size_t column) const {
    const double value = number(row, column);
    if (!(std::abs(value) <= most_magnitude)) fail("has a value that is not a number, or beyond 10¹⁵");
    return value;
}

std::uint32_t Accessor::index(std::size_t row) const {
    if (values_.type != Type::uint8 && values_.type != Type::uint16 && values_.type != Type::uint32)
        fail("has indices that are not whole numbers of at least 0");
    const Place place = place_of(row);
    return place.rows ? place.rows->whole_number(place.row) : 0;
}

}  // namespace phasetree::tracer::gltf
