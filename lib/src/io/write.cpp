#include "phasetree/io/write.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>

#include "tree/node.hpp"

namespace phasetree {

namespace {

std::string in_quotes(std::string_view text) {
    return nlohmann::json(text).dump();
}

// The shortest text that reads as the same float. "-0" would be read as an integer, which has no negative zero.
std::string as_text(float v) {
    return v == 0 && std::signbit(v) ? "-0.0" : fmt::format("{}", v);
}
std::string as_text(int v) {
    return fmt::format("{}", v);
}
template <glm::length_t n>
std::string as_text(const glm::vec<n, float>& v) {
    std::string text = "[";
    for (glm::length_t i = 0; i < n; ++i) text += (i > 0 ? ", " : "") + as_text(v[i]);
    return text + "]";
}

class Writer {
  public:
    explicit Writer(const SceneTree& tree) : tree_(tree) { count(tree.object); }

    // material(i) returns the material of phase i.
    template <class Material>
    std::string document(Material&& material) {
        const std::string object = node(tree_.object);
        std::string text = "{\n  \"version\": 1,\n  \"phases\": {";
        for (std::size_t i = 1; i < tree_.phases.names.size(); ++i)
            text += fmt::format("{}\n    {}: {}", i > 1 ? "," : "", in_quotes(tree_.phases.names[i]), material(i));
        text += "\n  },\n";
        if (!shapes_.empty()) {
            text += "  \"shapes\": {";
            for (std::size_t i = 0; i < shapes_.size(); ++i)
                text += fmt::format("{}\n    {}", i > 0 ? "," : "", shapes_[i]);
            text += "\n  },\n";
        }
        return text + "  \"tree\": " + object + "\n}\n";
    }

  private:
    template <class Handle>
    void count(const Handle& handle) {
        if (++uses_[handle.node()] > 1) return;
        std::visit([&](const auto& n) { for_each_child(n, [&](const auto& child) { count(child); }); },
                   handle.node()->node);
    }

    // A node, or the name of the shape by which it was replaced.
    template <class Handle>
    std::string node(const Handle& handle) {
        if (const auto found = names_.find(handle.node()); found != names_.end()) return in_quotes(found->second);
        std::string text = std::visit([&](const auto& n) { return parameters(n); }, handle.node()->node);
        if (uses_[handle.node()] == 1) return text;
        const std::string name = fmt::format("shape {}", shapes_.size() + 1);
        shapes_.push_back(in_quotes(name) + ": " + text);
        names_.emplace(handle.node(), name);
        return in_quotes(name);
    }

    template <class N>
    std::string parameters(const N& n) {
        std::string text;
        for_each_parameter(n, [&](const auto& v, const Parameter& p) {
            if (p.optional && is_absent(v)) return;
            text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", in_quotes(p.name), value(v, p));
        });
        return fmt::format("{{{}: {{{}}}}}", in_quotes(N::info.name), text);
    }

    template <class T>
    static bool is_absent(const T& v) {
        if constexpr (requires { v.content; })
            return !v.content;
        else if constexpr (requires { v.empty(); })
            return v.empty();
        else if constexpr (requires { static_cast<bool>(v.node()); })
            return !v;
        else
            return false;
    }

    template <class T>
    std::string value(const T& v, const Parameter& p) {
        if constexpr (std::is_same_v<T, Field> || std::is_same_v<T, Phased>) {
            return node(v);
        } else if constexpr (std::is_same_v<T, Phase>) {
            return in_quotes(tree_.phases.names.at(v.index));
        } else if constexpr (std::is_same_v<T, PhaseSet>) {
            std::vector<Phase> all;
            for_each_phase(v.bits, [&](int i) { all.push_back(Phase{static_cast<std::uint8_t>(i)}); });
            return value(all, p);
        } else if constexpr (std::is_same_v<T, std::string>) {
            return in_quotes(v);
        } else if constexpr (requires { v.content; }) {
            if (v.path.empty()) throw ModelError(fmt::format("\"{}\" was not read from a file", p.name));
            return in_quotes(v.path);
        } else if constexpr (requires { v.front(); }) {
            std::string text = "[";
            for (const auto& item : v) text += (text.size() > 1 ? ", " : "") + value(item, p);
            return text + "]";
        } else {
            return as_text(v);
        }
    }

    const SceneTree& tree_;
    std::unordered_map<const void*, int> uses_;
    std::unordered_map<const void*, std::string> names_;
    std::vector<std::string> shapes_;
};

}  // namespace

std::string write_tree(const SceneTree& tree) {
    return Writer(tree).document([](std::size_t) { return R"({"diffuse": {"color": [0.5, 0.5, 0.5]}})"; });
}

std::string write_tree(const SceneTree& tree, std::span<const std::string> materials) {
    if (materials.size() != tree.phases.size()) throw std::out_of_range("a material for each phase is needed");
    return Writer(tree).document([&](std::size_t i) { return materials[i - 1]; });
}

std::string write_tree_without_materials(const SceneTree& tree) {
    return Writer(tree).document([](std::size_t) { return "null"; });
}

}  // namespace phasetree
