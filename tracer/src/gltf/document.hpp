// A glTF 2.0 file: a JSON document, and bytes to which it refers. In the binary form, .glb, they stand behind it in
// the same file; else, in .gltf, they are files beside it, or are written into the document.
//
// What the document says is never believed: each number that is asked for has the type and the bounds that glTF gives
// it, or GltfError says what is wrong. Messages tell the place in the document, and quote nothing of the file but
// names.
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

/// A coordinate of a scene is at most this, and squares of it are floats.
inline constexpr double most_magnitude = 1e15;

/// What is wrong with a file, or what this program does not read, without the file's name.
class GltfError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// An object of the document, such as {"mesh": 3}, with its place in the document, such as nodes[2], for messages.
class Item {
  public:
    Item(const Json& json, std::string place) : json_(&json), place_(std::move(place)) {}

    bool has(std::string_view key) const { return find(key) != nullptr; }
    /// The object that is called so; nothing if there is none.
    std::optional<Item> item(std::string_view key) const;
    /// The objects of the list that is called so; none if there is no list.
    std::vector<Item> items(std::string_view key) const;
    /// A number from 0.
    std::optional<std::size_t> index(std::string_view key) const;
    std::size_t needed_index(std::string_view key) const;
    /// The numbers from 0 of the list that is called so.
    std::vector<std::size_t> indices(std::string_view key) const;
    float number(std::string_view key, float otherwise) const;
    /// The extension of that name; nothing if there is none.
    std::optional<Item> extension(std::string_view name) const;
    /// This many finite numbers; nothing if there is no such list.
    std::optional<std::vector<float>> numbers(std::string_view key, std::size_t count) const;
    glm::vec3 vec3(std::string_view key, const glm::vec3& otherwise) const;
    /// A text; empty if there is none.
    std::string text(std::string_view key) const;
    /// The texts of the list that is called so; what is no text in it is empty.
    std::vector<std::string> texts(std::string_view key) const;
    bool flag(std::string_view key, bool otherwise = false) const;
    /// How many elements the list has that is called so.
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
    /// `content` is all of the file, which must outlive the document. Files that it names are asked for by `read_file`:
    /// those of buffers at once, those of images by image(). Without it a file that names others is rejected.
    explicit Document(std::string_view content, ReadFile read_file = {});

    Item root() const { return {json_, ""}; }
    /// How many elements one of the document's lists has, such as "meshes".
    std::size_t count(const char* list) const;
    /// An element of such a list. `from` refers to it.
    Item element(const char* list, std::size_t index, const Item& from) const;
    /// All bytes of an element of "bufferViews", whatever its "byteStride" is; compressed ones are not decoded.
    std::string_view view(std::size_t index, const Item& from) const;
    /// The bytes that an object with "buffer", "byteOffset" and "byteLength" names.
    std::string_view bytes_in_buffer(const Item&) const;
    /// All bytes of an element of "images".
    std::string image(const Item& image) const;
    /// The paths of all files that the document names, from its folder; what cannot be used is left out.
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
