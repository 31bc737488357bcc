// A glTF 2.0 file: a JSON document, and bytes to which it refers. In the binary form, .glb, the bytes follow the
// document in the same file. In the text form, .gltf, they are in separate files, or encoded in the document.
//
// The document is not trusted. Every requested number has the type and the range that glTF specifies, or GltfError is
// thrown. Messages name the place in the document, and quote only names from the file.
//
// Reference: Khronos Group, glTF 2.0 Specification, 2021 (ISO/IEC 12113:2022).
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "gltf/uri.hpp"

namespace phasetree::tracer::gltf {

using Json = nlohmann::json;

/// The maximum coordinate of a scene; its square is still a finite float.
inline constexpr double most_magnitude = 1e15;

/// A mistake in a file, or something that this program does not read. The message does not contain the file's name.
class GltfError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// An object of the document, such as {"mesh": 3}, with its place in the document, such as nodes[2], for messages.
class Item {
  public:
    Item(const Json& json, std::string place) : json_(&json), place_(std::move(place)) {}

    bool has(std::string_view key) const { return find(key) != nullptr; }
    /// The object with this key; nullopt if there is none.
    std::optional<Item> item(std::string_view key) const;
    /// The objects of the list with this key; empty if there is no list.
    std::vector<Item> items(std::string_view key) const;
    /// A whole number of at least 0; nullopt if there is none.
    std::optional<std::size_t> index(std::string_view key) const;
    std::size_t needed_index(std::string_view key) const;
    /// The whole numbers of the list with this key, each at least 0.
    std::vector<std::size_t> indices(std::string_view key) const;
    float number(std::string_view key, float otherwise) const;
    /// The extension with this name; nullopt if there is none.
    std::optional<Item> extension(std::string_view name) const;
    /// A list of this many finite numbers; nullopt if there is none.
    std::optional<std::vector<float>> numbers(std::string_view key, std::size_t count) const;
    glm::vec3 vec3(std::string_view key, const glm::vec3& otherwise) const;
    /// A text; empty if there is none.
    std::string text(std::string_view key) const;
    /// The texts of the list with this key; items that are not texts become empty.
    std::vector<std::string> texts(std::string_view key) const;
    bool flag(std::string_view key, bool otherwise = false) const;
    /// The number of elements of the list with this key.
    std::size_t count(std::string_view key) const;
    /// The names of the members.
    std::vector<std::string> keys() const;
    const std::string& place() const { return place_; }

    [[noreturn]] void fail(std::string_view what) const;

  private:
    const Json* find(std::string_view key) const;
    std::size_t index_of(const Json&, std::string_view key) const;

    const Json* json_;
    std::string place_;  ///< empty for the root
};

class Document {
  public:
    /// `content` is the whole file and must outlive the document. `read_file` reads the files that it names: those of
    /// buffers immediately, those of images when image() is called. Without `read_file`, a file that names others is
    /// rejected.
    explicit Document(std::string_view content, ReadFile read_file = {});

    Item root() const { return {json_, ""}; }
    /// The number of elements of one of the document's lists, such as "meshes".
    std::size_t count(const char* list) const;
    /// An element of such a list. `from` refers to it.
    Item element(const char* list, std::size_t index, const Item& from) const;
    /// All bytes of an element of "bufferViews", regardless of its "byteStride". Compressed ones are not decoded.
    std::string_view view(std::size_t index, const Item& from) const;
    /// The bytes to which an object with "buffer", "byteOffset" and "byteLength" refers.
    std::string_view bytes_in_buffer(const Item&) const;
    /// All bytes of an element of "images".
    std::string image(const Item& image) const;
    /// The paths of all files that the document names, relative to its folder, except those that cannot be used.
    std::vector<std::string> files() const;

  private:
    void check_version() const;
    void read_buffers();
    std::string bytes_of(const Item& named) const;

    Json json_;
    ReadFile read_file_;
    std::string_view bytes_;            // the binary chunk of a .glb file
    std::vector<std::string> buffers_;  // by index; empty if it has no URI
};

}  // namespace phasetree::tracer::gltf
