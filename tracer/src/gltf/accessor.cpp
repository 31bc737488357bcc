#include "gltf/accessor.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace phasetree::tracer::gltf {

namespace {

template <class Number>
Number at(std::string_view bytes, std::size_t offset) {
    Number n;
    std::memcpy(&n, bytes.data() + offset, sizeof n);
    return n;
}

std::size_t columns_of(const Item& accessor) {
    const std::string type = accessor.text("type");
    for (const auto& [name, columns] : {std::pair("SCALAR", 1), {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}})
        if (type == name) return static_cast<std::size_t>(columns);
    accessor.fail("has a \"type\" other than SCALAR, VEC2, VEC3, VEC4 and MAT4");
}

}  // namespace

Accessor::Accessor(const Document& document, std::size_t index, const Item& from)
    : item_(document.element("accessors", index, from)), columns_(columns_of(item_)) {
    if (item_.has("sparse")) fail("is sparse, which this program does not read");
    rows_ = item_.needed_index("count");
    const std::size_t type = item_.needed_index("componentType");
    std::size_t size = 0;
    for (const auto& [known, bytes] : {std::pair(Type::int8, 1),
                                       {Type::uint8, 1},
                                       {Type::int16, 2},
                                       {Type::uint16, 2},
                                       {Type::uint32, 4},
                                       {Type::float32, 4}})
        if (type == static_cast<std::size_t>(known)) type_ = known, size = static_cast<std::size_t>(bytes);
    if (size == 0) fail("has an unknown \"componentType\"");
    is_normalised_ = item_.flag("normalized");
    const auto view = item_.index("bufferView");
    if (!view) fail("has no bytes in the file");
    bytes_ = document.view(*view, item_);
    const std::size_t offset = item_.index("byteOffset").value_or(0), row = size * columns_;
    // 0 is what programs write that mean none.
    const std::size_t stride = document.element("bufferViews", *view, item_).index("byteStride").value_or(0);
    stride_ = stride == 0 ? row : stride;
    if (stride_ < row) fail("has rows that overlap");
    if (offset > bytes_.size()) fail("is beyond the end of its bytes");
    bytes_.remove_prefix(offset);
    if (rows_ > 0 && (bytes_.size() < row || (bytes_.size() - row) / stride_ < rows_ - 1))
        fail("is beyond the end of its bytes");
}

double Accessor::number(std::size_t row, std::size_t column) const {
    const std::size_t offset = row * stride_;
    const auto scaled = [&](double value, double largest) {
        return is_normalised_ ? std::max(value / largest, -1.0) : value;
    };
    switch (type_) {
        case Type::int8:
            return scaled(at<std::int8_t>(bytes_, offset + column), 127);
        case Type::uint8:
            return scaled(at<std::uint8_t>(bytes_, offset + column), 255);
        case Type::int16:
            return scaled(at<std::int16_t>(bytes_, offset + 2 * column), 32767);
        case Type::uint16:
            return scaled(at<std::uint16_t>(bytes_, offset + 2 * column), 65535);
        case Type::uint32:
            return at<std::uint32_t>(bytes_, offset + 4 * column);
        case Type::float32:
            return static_cast<double>(at<float>(bytes_, offset + 4 * column));
    }
    return 0;
}

double Accessor::finite_number(std::size_t row, std::size_t column) const {
    const double value = number(row, column);
    if (!(std::abs(value) <= most_magnitude)) fail("has something that is no number, or is beyond 10¹⁵");
    return value;
}

std::uint32_t Accessor::index(std::size_t row) const {
    const std::size_t offset = row * stride_;
    switch (type_) {
        case Type::uint8:
            return at<std::uint8_t>(bytes_, offset);
        case Type::uint16:
            return at<std::uint16_t>(bytes_, offset);
        case Type::uint32:
            return at<std::uint32_t>(bytes_, offset);
        default:
            fail("has indices that are not whole numbers from 0");
    }
}

}  // namespace phasetree::tracer::gltf
