#include "scene/read_transform.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <system_error>

#include "phasetree/io/keys.hpp"
#include "phasetree/io/read_kind.hpp"
#include "phasetree_support/reading.hpp"
#include "scene/object_kinds.hpp"
#include "scene/placed.hpp"

namespace phasetree::tracer {

namespace {

constexpr const char* unusable = "the transform is singular, or moves or scales the object beyond what can be traced";

template <class Kind>
Transform map_of(Kind kind) {
    try {
        if constexpr (requires { kind.prepare(); }) kind.prepare();
    } catch (const ModelError& e) {
        throw std::invalid_argument(e.what());
    }
    const AffineMap::Inverse map = kind.map().affine().inverse();
    const Transform result{map.matrix, map.by};
    if (!result.is_usable()) throw std::invalid_argument(unusable);
    return result;
}

template <>
Transform map_of(Affine kind) {
    const Transform result{{glm::dvec3(kind.x), glm::dvec3(kind.y), glm::dvec3(kind.z)}, glm::dvec3(kind.by)};
    if (!result.is_usable()) throw std::invalid_argument(unusable);
    return result;
}

Transform read_one(const Document& document, Value value) {
    Transform transform;
    with_kind(TransformKinds(), document, value, "a transform", [&]<class Kind>(Value member) {
        transform = read_kind<Kind>(document, member, fmt::format("\"{}\"", Kind::info.name), map_of<Kind>);
    });
    return transform;
}

// The images of the unit vectors, and of the origin.
Transform of_twelve(const float* n) {
    Transform t;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) t.matrix[column][row] = static_cast<double>(n[3 * column + row]);
    t.by = {n[9], n[10], n[11]};
    return t;
}

std::uint64_t little_endian(const unsigned char* bytes, int count) {
    std::uint64_t number = 0;
    for (int i = count - 1; i >= 0; --i) number = number << 8 | bytes[i];
    return number;
}

}  // namespace

namespace {

constexpr const char* turned_inside_out = "between this key and the one before it, the transform would become singular";

// Interpolation between two usable transforms is usable too; see moving_transform.cpp for the reason.
Transform between_keys(const Document& document, Value value) {
    const Keys keys(document, value, "the animated value");
    const Keys::Place place = keys.at(document.seconds());
    Pose before, after;
    bool mirrored = false;
    for (std::size_t i = 0; i < keys.count(); ++i) {
        const Pose pose = Pose::of(read_transform(document, keys.value(i)));
        if (i > 0 && pose.mirrors() != mirrored) throw document.error(keys.value(i), turned_inside_out);
        mirrored = pose.mirrors();
        if (i == place.before) before = pose;
        if (i == place.before + 1) after = pose;
    }
    return place.share > 0 ? between(before, after, place.share).transform()
                           : read_transform(document, keys.value(place.before));
}

}  // namespace

Transform read_transform(const Document& document, Value value) {
    if (Keys::are_in(value)) return between_keys(document, value);
    if (!value.is_array()) return read_one(document, value);
    if (value.size() == 0) throw document.error(value, "\"transform\" must not be an empty list");
    Transform all;
    for (const Value step : value) all = read_one(document, step) * all;
    if (!all.is_usable()) throw document.error(value, unusable);
    return all;
}

ReadTransform read_transform(const Document& document, Value value, const Shutter& shutter) {
    ReadTransform result{read_transform(at_moment(document, shutter, 0), value), std::nullopt};
    std::vector<MovingTransform::Moment> moments;
    bool moves = false;
    for (const double moment : moments_of(document, value, shutter)) {
        const Transform then = read_transform(at_moment(document, shutter, moment), value);
        moments.push_back({moment, Pose::of(then)});
        moves = moves || then != result.at_opening;
    }
    if (!moves) return result;
    for (const auto& moment : moments)
        if (moment.pose.mirrors() != moments.front().pose.mirrors())
            throw document.error(value, "the transform would become singular while the shutter is open");
    result.moving.emplace(std::move(moments));
    return result;
}

std::vector<Transform> read_transforms(const Document& document, Value list) {
    if (!list.is_array() || list.size() == 0)
        throw document.error(list, "\"transforms\" must be a list of [x, y, z] or of lists of 12 numbers");
    std::vector<Transform> all;
    all.reserve(list.size());
    for (const Value item : list) {
        if (!item.is_array() || (item.size() != 3 && item.size() != 12))
            throw document.error(item,
                                 "an instance must be [x, y, z], the image of the origin, or a list of 12 numbers");
        std::array<float, 12> n{1, 0, 0, 0, 1, 0, 0, 0, 1};
        std::size_t i = 12 - item.size();
        for (const Value number : item) n[i++] = as<float>(document, number, "a number of an instance");
        const Transform transform = of_twelve(n.data());
        if (!transform.is_usable()) throw document.error(item, unusable);
        all.push_back(transform);
    }
    return all;
}

std::vector<Transform> read_transforms_file(const Document& document, Value named) {
    const std::string name = as<std::string>(document, named, "\"file\"");
    const std::filesystem::path path = document.file(named);
    const auto wrong = [&](const std::string& what) {
        return document.error(named, fmt::format("\"{}\" {}", name, what));
    };
    std::error_code problem;
    if (!std::filesystem::is_regular_file(path, problem)) throw wrong("is not a readable file");
    const std::uint64_t bytes = std::filesystem::file_size(path, problem);
    std::ifstream file(path, std::ios::binary);
    std::array<unsigned char, 16> head{};
    if (problem || !file) throw wrong("cannot be read");
    if (!file.read(reinterpret_cast<char*>(head.data()), head.size()) || std::memcmp(head.data(), "PTPLACES", 8) != 0)
        throw wrong("is not a file of instances: it does not begin with PTPLACES and a number");
    const std::uint64_t count = little_endian(head.data() + 8, 8);
    if (count == 0) throw wrong("has no instances");
    if (count > most_instances) throw wrong(fmt::format("has {} instances; the limit is {}", count, most_instances));
    if (bytes != 16 + 48 * count)
        throw wrong(
            fmt::format("declares {} instances, which take {} bytes, but has {} bytes", count, 16 + 48 * count, bytes));
    std::vector<Transform> all;
    all.reserve(count);
    std::array<unsigned char, 48> raw{};
    support::ReadingPlace place;
    for (std::uint64_t i = 0; i < count; ++i) {
        if (!file.read(reinterpret_cast<char*>(raw.data()), raw.size())) throw wrong("cannot be read completely");
        std::array<float, 12> n{};
        for (std::size_t k = 0; k < n.size(); ++k)
            n[k] = std::bit_cast<float>(static_cast<std::uint32_t>(little_endian(raw.data() + 4 * k, 4)));
        const Transform transform = of_twelve(n.data());
        if (!transform.is_usable())
            throw wrong(fmt::format("has an unusable instance, number {} counted from 0: {}", i, unusable));
        all.push_back(transform);
        place.reached(16 + 48 * (i + 1));
    }
    place.finished(bytes);
    return all;
}

}  // namespace phasetree::tracer
