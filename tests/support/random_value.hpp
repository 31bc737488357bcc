#pragma once

/// Draws a value for a node's parameter.

#include <cmath>
#include <iterator>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "phasetree/model/from_file.hpp"
#include "phasetree/model/parameter.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/intersect_shape.hpp"
#include "support/random_mesh.hpp"
#include "support/random_number.hpp"
#include "support/random_tree.hpp"
#include "support/set_algebra/all.hpp"

namespace phasetree::tests {

inline TriangleMesh random_content(Random& rng, std::type_identity<TriangleMesh>) {
    return random_mesh(rng, rng.below(2), 0.3f);
}

namespace detail {

inline Field bounded(Random& rng, Field f) {
    if (bounds(f).finite()) return f;
    return Intersection{.of = {std::move(f), Sphere{.radius = rng.uniform(0.8f, 1.6f)}}};
}
inline Phased bounded(Random& rng, Phased a) {
    if (bounds(a).finite()) return a;
    return IntersectShape{.of = std::move(a), .shape = Sphere{.radius = rng.uniform(0.8f, 1.6f)}, .phases_cut = {}};
}

/// A formula. Some formulas need bounds, and are rejected without them.
inline std::string random_formula(Random& rng) {
    static constexpr const char* formulas[] = {
        "length(x, y, z) - A",
        "r = sqrt(x^2 + y^2); sqrt((r - A)^2 + z^2) - B / 3",
        "max(abs(x) - A, abs(y - B) - A, abs(z) - B) + 0.05",
        "min(length(x - A, y), length(y, z + B)) - 0.3",
        "smooth_min(length(x, y, z) - A, abs(z - B) - 0.1, B)",
        "x^2 + B * y^2 + z^4 - A",
        "sin(3 * x) * cos(2 * y) - z * A",
        "exp(-x^2) * B - abs(z) / 2 + tanh(y * A) / 4",
        "-smooth_max(A * x - y^3, z / (1 + x^2), B) + 0.2",
    };
    std::string text = formulas[rng.below(static_cast<int>(std::size(formulas)))];
    for (const char* letter : {"A", "B"}) {
        const std::string number = std::to_string(rng.uniform(0.3f, 1));
        for (std::size_t at = text.find(letter); at != std::string::npos; at = text.find(letter))
            text.replace(at, 1, number);
    }
    return text;
}

/// The content of a file, drawn by the oracle of the node that reads it (set_algebra/all.hpp).
template <class Content>
FromFile<Content> with_random_content(Random& rng, const FromFile<Content>&) {
    return {.content = std::make_shared<const Content>(random_content(rng, std::type_identity<Content>{}))};
}

/// A value of a parameter. A random child is bounded if the node requires this.
template <class Value>
void fill(Random& rng, Value& value, const Parameter& p, int depth, bool needs_bounded) {
    const auto draw = [&](auto& child) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(child)>, Field>)
            child = random_field(rng, depth);
        else
            child = random_object(rng, depth);
        if (needs_bounded) child = phasetree::tests::detail::bounded(rng, child);
    };
    if (p.optional && rng.chance(0.3)) return;
    if constexpr (std::is_same_v<Value, float>) {
        value = random_number(rng, p);
    } else if constexpr (std::is_same_v<Value, int>) {
        // Counts multiply, in a grid and down the tree. A slope that is only sampled is not proven.
        value = p.name == "samples" ? 0 : 1 + rng.below(2);
    } else if constexpr (std::is_same_v<Value, std::string>) {
        static constexpr const char* rules[] = {"", "winding_number", "even_odd", "non_zero"};
        value = p.name == "rule" ? rules[rng.below(4)] : random_formula(rng);
    } else if constexpr (std::is_same_v<Value, glm::vec3>) {
        for (int i = 0; i < 3; ++i) value[i] = random_number(rng, p);
    } else if constexpr (std::is_same_v<Value, glm::vec2>) {
        for (int i = 0; i < 2; ++i) value[i] = random_number(rng, p);
    } else if constexpr (std::is_same_v<Value, Phase>) {
        value = Phase{static_cast<std::uint8_t>(1 + rng.below(random_phases))};
    } else if constexpr (std::is_same_v<Value, PhaseSet>) {
        value = PhaseSet{(rng.bits() & ((1u << (random_phases + 1)) - 1)) & ~std::uint64_t{rng.chance(0.8)}};
    } else if constexpr (std::is_same_v<Value, Field> || std::is_same_v<Value, Phased>) {
        draw(value);
    } else if constexpr (requires { value.content; }) {
        value = with_random_content(rng, value);
    } else if constexpr (std::is_same_v<Value, std::vector<float>> || std::is_same_v<Value, std::vector<Phase>>) {
        // The lists of a node belong together: they are equally long, or one is shorter by one, or has one number for
        // all. The node rejects any other lengths.
        value.resize(static_cast<std::size_t>(1 + rng.below(3)));
        Parameter each = p;
        each.optional = false;
        for (auto& item : value) fill(rng, item, each, depth, needs_bounded);
    } else {
        // Mostly two or three children, sometimes a single one, which operators on several children must accept.
        using Entry = typename Value::value_type;
        const bool is_outline = std::is_same_v<Entry, glm::vec2>;
        if constexpr (std::is_same_v<Entry, glm::vec3>) {
            if (p.name == "bounds") {
                const glm::vec3 middle(rng.uniform(-0.3f, 0.3f), 0, 0), half(rng.uniform(0.8f, 1.6f));
                value = {middle - half, middle + half};
                return;
            }
        }
        value.resize(static_cast<std::size_t>(is_outline ? 3 + rng.below(4) : rng.chance(0.1) ? 1 : 2 + rng.below(2)));
        if constexpr (std::is_same_v<Entry, Field> || std::is_same_v<Entry, Phased>) {
            for (auto& child : value) draw(child);
        } else {
            Parameter each = p;
            each.optional = false;
            for (auto& v : value) fill(rng, v, each, depth, needs_bounded);
        }
    }
}

}  // namespace detail

}  // namespace phasetree::tests
