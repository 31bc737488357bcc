#pragma once

/// How the value of a node's parameter is drawn.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "phasetree/model/from_file.hpp"
#include "phasetree/model/parameter.hpp"
#include "phasetree/nodes/fields/ball_list.hpp"
#include "phasetree/nodes/fields/height_grid.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/siren_network.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/intersect_shape.hpp"
#include "support/random_mesh.hpp"
#include "support/random_text.hpp"
#include "support/random_tree.hpp"
#include "support/random_voxels.hpp"

namespace phasetree::tests::detail {

inline float allowed(float v, const Limits& l, Random& rng) {
    if (l.contains(v)) return v;
    const float low = std::max(l.low, -1.f), high = std::min(l.high, 1.f);
    return rng.uniform(low + 0.01f * (high - low), high - 0.01f * (high - low));
}

/// A number that suits its unit and limits; mostly small sizes, a few large ones.
inline float random_number(Random& rng, const Parameter& p) {
    const bool negative = p.limits.contains(-0.01f), round = rng.chance(0.3);
    const auto rounded = [&](float v, float unit) { return round ? std::round(v / unit) * unit : v; };
    if (p.unit == "degrees") return allowed(rounded(rng.uniform(-180, 180), 45), p.limits, rng);
    if (p.unit == "degrees/m") return allowed(rounded(rng.uniform(-150, 150), 45), p.limits, rng);
    // Counts; and waves long enough that an object has not thousands of them.
    if (p.unit.empty() && p.limits.low > 2) return std::floor(rng.uniform(p.limits.low, p.limits.low + 6));
    if (p.name == "period" || p.name == "scale") return rounded(rng.uniform(0.4f, 1.5f), 0.25f);
    if (p.unit == "m" && !negative) {
        const float u = rng.uniform(0, 1);
        return allowed(rounded(0.04f + 1.2f * u * u, 0.25f), p.limits, rng);
    }
    if (p.unit == "m") return allowed(rounded(rng.uniform(-0.6f, 0.6f), 0.25f), p.limits, rng);
    if (negative) return allowed(rounded(rng.uniform(-1, 1), 1), p.limits, rng);
    return allowed(rounded(rng.uniform(0.4f, 2.2f), 0.5f), p.limits, rng);
}

inline Field bounded(Random& rng, Field f) {
    if (bounds(f).finite()) return f;
    return Intersection{.of = {std::move(f), Sphere{.radius = rng.uniform(0.8f, 1.6f)}}};
}
inline Phased bounded(Random& rng, Phased a) {
    if (bounds(a).finite()) return a;
    return IntersectShape{.of = std::move(a), .shape = Sphere{.radius = rng.uniform(0.8f, 1.6f)}, .phases_cut = {}};
}

/// A formula; some of them need bounds, and are rejected without.
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

/// A value of a parameter; what is random of a child is bounded if the node needs that.
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
    } else if constexpr (std::is_same_v<Value, FromFile<SirenNetwork>>) {
        SirenNetwork network;
        network.radius = rng.uniform(0.5f, 1.2f);
        for (const auto& [inputs, outputs] : {std::pair(3, 7), std::pair(7, 5), std::pair(5, 1)}) {
            SirenNetwork::Layer layer{inputs, outputs, {}, {}};
            for (int i = 0; i < inputs * outputs; ++i) layer.weights.push_back(rng.uniform(-0.9f, 0.9f));
            for (int o = 0; o < outputs; ++o) layer.bias.push_back(rng.uniform(-0.9f, 0.5f));
            network.layers.push_back(std::move(layer));
        }
        value.content = std::make_shared<const SirenNetwork>(std::move(network));
    } else if constexpr (std::is_same_v<Value, FromFile<TriangleMesh>>) {
        value = held(random_mesh(rng, rng.below(2), 0.3f));
    } else if constexpr (std::is_same_v<Value, FromFile<BallList>>) {
        BallList list;
        const bool has_radii = rng.chance(0.7), has_phases = rng.chance(0.7);
        for (int left = 1 + rng.below(rng.chance(0.3) ? 60 : 6); left > 0; --left) {
            list.centres.emplace_back(random_number(rng, {"", "m", ""}), random_number(rng, {"", "m", ""}),
                                      random_number(rng, {"", "m", ""}));
            if (has_radii) list.radii.push_back(rng.chance(0.3) ? 0.25f : rng.uniform(0.05f, 0.4f));
            if (has_phases) list.phases.push_back(static_cast<std::uint8_t>(rng.below(2)));
        }
        value.content = std::make_shared<const BallList>(std::move(list));
    } else if constexpr (std::is_same_v<Value, FromFile<TextOutlines>>) {
        value = held_content(random_text(rng));
    } else if constexpr (std::is_same_v<Value, FromFile<VoxelGrid>>) {
        value = held_content(random_level_set(rng));
    } else if constexpr (std::is_same_v<Value, FromFile<LabelGrid>>) {
        value = held_content(random_labels(rng, 2 + rng.below(3)));
    } else if constexpr (std::is_same_v<Value, FromFile<HeightGrid>>) {
        HeightGrid grid{2 + rng.below(4), 2 + rng.below(4), {}};
        for (int i = 0; i < grid.width * grid.height; ++i) grid.values.push_back(rng.uniform(0, 1));
        value.content = std::make_shared<const HeightGrid>(std::move(grid));
    } else if constexpr (std::is_same_v<Value, std::vector<float>> || std::is_same_v<Value, std::vector<Phase>>) {
        // A node's lists belong together, one as long as the other, or one shorter, or one for all: it refuses the
        // rest.
        value.resize(static_cast<std::size_t>(1 + rng.below(3)));
        Parameter each = p;
        each.optional = false;
        for (auto& item : value) fill(rng, item, each, depth, needs_bounded);
    } else {
        // Mostly two or three, periodically the single child that a fold over the rest must survive.
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

}  // namespace phasetree::tests::detail
