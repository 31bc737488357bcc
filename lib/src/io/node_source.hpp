#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "phasetree/io/kept_nodes.hpp"
#include "tree/node.hpp"

namespace phasetree::io {

/// The state of a regular file, which changes when the file does. Nothing for a file that is not regular, or that was
/// saved within the last second.
std::optional<std::string> state_of(const std::filesystem::path& file);

/// A node that takes a file. By convention, that parameter is called `file`.
template <class N>
concept MadeFromFile = requires(N& node) {
    node.file.content;
};

/// Serialises parameters, so that equal texts mean equal parameters.
class ParameterBytes {
  public:
    template <class T>
    requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void add(T value) {
        char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        text.append(bytes, sizeof value);
    }
    void add(const std::string& value) {
        add(value.size());
        text += value;
    }
    void add(const glm::vec2& value) {
        add(value.x);
        add(value.y);
    }
    void add(const glm::vec3& value) {
        add(value.x);
        add(value.y);
        add(value.z);
    }
    void add(Phase value) { add(value.index); }
    template <class Item>
    void add(const std::vector<Item>& list) {
        add(list.size());
        for (const Item& item : list) add(item);
    }
    template <class Content>
    void add(const FromFile<Content>& file) {
        add(file.path);
    }

    std::string text{};
};

/// What a node that takes a file is made from: its parameters, which must have been read, and the files that the file's
/// name matches, which need not have been. Returns nullopt if one of them has no state.
template <MadeFromFile N>
std::optional<KeptNodes::Source> source_of(N& node, const std::filesystem::path& file,
                                           std::span<const std::filesystem::path> files) {
    std::string states;
    for (const std::filesystem::path& one : files) {
        const std::optional<std::string> state = state_of(one);
        if (!state) return std::nullopt;
        states += one.string() + ' ' + *state + '\n';
    }
    ParameterBytes bytes;
    bytes.add(std::string(N::info.name));
    bytes.add(file.string());
    for_each_parameter(node, [&](const auto& value, const Parameter&) { bytes.add(value); });
    return KeptNodes::Source{std::move(bytes.text), std::move(states)};
}

}  // namespace phasetree::io
