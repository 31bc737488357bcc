#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "phasetree/io/error.hpp"

namespace phasetree {

struct DocumentData;
class KeptNodes;
class ValueIterator;

/// The type of a JSON value. (The kinds of io/kind.hpp, such as a sphere light, are something else.)
enum class Kind : std::uint8_t { null, boolean, number, string, array, object };

/// The name of a type with its article: "a number", "an object", …
std::string_view name_of(Kind kind);

/// A value of a Document. It is a handle of two words: pass it by value. It is valid as long as the Document or a copy
/// of it exists. Every value knows its position in the text, and a member of an object also knows its key.
class Value {
  public:
    Kind kind() const;
    bool is_null() const { return kind() == Kind::null; }
    bool is_boolean() const { return kind() == Kind::boolean; }
    bool is_number() const { return kind() == Kind::number; }
    bool is_string() const { return kind() == Kind::string; }
    bool is_array() const { return kind() == Kind::array; }
    bool is_object() const { return kind() == Kind::object; }

    // The content. Calling the accessor of another kind throws std::logic_error.
    bool boolean() const;
    double number() const;  ///< always finite
    std::string_view string() const;

    /// The number of items of an array or members of an object; 0 for other kinds.
    std::size_t size() const;
    /// The i-th item of an array or member of an object, in file order. Throws std::out_of_range past the end.
    Value operator[](std::size_t i) const;
    /// Iterate over items or members: `for (const Value member : object) member.key()`.
    ValueIterator begin() const;
    ValueIterator end() const;
    /// The member with this key; nullopt if it is missing or this is not an object.
    std::optional<Value> find(std::string_view key) const;

    /// The key of an object's member; empty for other values.
    std::string_view key() const;

    /// Byte offset of the first character, e.g. of the opening quote or bracket.
    std::size_t offset() const;
    /// Byte offset of the key's opening quote; offset() if this is not a member of an object.
    std::size_t key_offset() const;
    /// The source text of a number, true, false or null, exactly as written.
    std::string_view written() const;

  private:
    friend class Document;
    friend class ValueIterator;
    Value(const DocumentData* data, std::uint32_t index) : data_(data), index_(index) {}

    const DocumentData* data_;
    std::uint32_t index_;
};

/// Iterator over the items or members of a Value. See Value::begin().
class ValueIterator {
  public:
    using iterator_concept = std::forward_iterator_tag;
    using iterator_category = std::input_iterator_tag;
    using value_type = Value;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = Value;

    ValueIterator() = default;
    Value operator*() const { return {data_, index_}; }
    ValueIterator& operator++() {
        ++index_;
        return *this;
    }
    ValueIterator operator++(int) {
        const ValueIterator before = *this;
        ++index_;
        return before;
    }
    bool operator==(const ValueIterator&) const = default;

  private:
    friend class Value;
    ValueIterator(const DocumentData* data, std::uint32_t index) : data_(data), index_(index) {}

    const DocumentData* data_ = nullptr;
    std::uint32_t index_ = 0;
};

/// A parsed JSON text (RFC 8259) with // and /* */ comments. Immutable, cheap to copy, and safe to share between
/// threads.
///
/// The text must be UTF-8, at most 256 MiB, and nested at most max_depth levels deep. The keys of an object must be
/// unique, numbers must be finite, and strings must not contain null characters. Anything else throws SceneError.
class Document {
  public:
    static constexpr std::size_t max_bytes = std::size_t{256} << 20;
    /// Maximum nesting. A node takes up to three levels: the node itself, its parameters, and a list of children. This
    /// allows for trees of max_tree_depth = 400 nested nodes.
    static constexpr std::size_t max_depth = 1216;

    /// Read a regular file. Directories, pipes and devices are rejected without reading.
    static Document from_file(const std::filesystem::path& path);
    static Document from_text(std::string text, std::string name = "<text>");

    Value root() const;
    const std::string& text() const;
    /// The file's name in error messages: the path as it was given.
    const std::string& name() const;

    /// Resolve a file name in the text, relative to the text's own file.
    ///
    /// Throws SceneError at the value if the path leaves the folder of with_files_within(). The message then reveals
    /// nothing about the file, not even whether it exists. A name with # stands for several files; none of them may be
    /// a link that leads out of the folder.
    std::filesystem::path file(Value named) const;
    /// Read another document, whose file name is a string in the text. It inherits the time of at() and the folder of
    /// with_files_within().
    Document beside(Value named) const;
    /// The same text, restricted to files in this folder or below it, after following symbolic links. Use it to read
    /// untrusted scenes. Throws SceneError if the folder does not exist.
    Document with_files_within(const std::filesystem::path& folder) const;

    /// The same text, for callers that need only the model. Readers still check all of the text, but do not open the
    /// files of lights, meshes, textures and voxels, which may be large or missing.
    Document without_assets() const;
    /// False for the result of without_assets(), and for documents read through beside() from it.
    bool reads_assets() const;

    /// The time in seconds at which keyed values are evaluated (io/keys.hpp). 0 by default.
    double seconds() const { return seconds_; }
    Document at(double seconds) const {
        Document then = *this;
        then.seconds_ = seconds;
        return then;
    }

    /// The same text with a cache of nodes from earlier readings (io/kept_nodes.hpp). Nodes that have not changed are
    /// reused, and new ones are kept for the next reading. Documents read through beside() share the cache.
    Document with_kept_nodes(std::shared_ptr<KeptNodes> nodes) const {
        Document then = *this;
        then.kept_nodes_ = std::move(nodes);
        return then;
    }
    /// The cache of with_kept_nodes(), or null.
    KeptNodes* kept_nodes() const { return kept_nodes_.get(); }

    /// Make an error at a byte offset, or at the first character of a value.
    SceneError error(std::size_t offset, std::string message, std::optional<std::string> suggestion = {}) const;
    SceneError error(Value value, std::string message, std::optional<std::string> suggestion = {}) const;

  private:
    explicit Document(std::shared_ptr<const DocumentData> data) : data_(std::move(data)) {}

    std::shared_ptr<const DocumentData> data_;
    struct FileAccess;
    std::shared_ptr<const FileAccess> access_;  ///< null if any file may be read
    std::shared_ptr<KeptNodes> kept_nodes_;
    double seconds_ = 0;
};

}  // namespace phasetree
