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

/// What a JSON value is.
enum class Kind : std::uint8_t { null, boolean, number, string, array, object };

/// "a number", "an object", …
std::string_view name_of(Kind kind);

/// A value of a Document: a handle of two words, to be passed by value, good for as long as the Document (or a copy of
/// it) lives. Every value knows where it stands in the text, and a member of an object also knows its key.
class Value {
  public:
    Kind kind() const;
    bool is_null() const { return kind() == Kind::null; }
    bool is_boolean() const { return kind() == Kind::boolean; }
    bool is_number() const { return kind() == Kind::number; }
    bool is_string() const { return kind() == Kind::string; }
    bool is_array() const { return kind() == Kind::array; }
    bool is_object() const { return kind() == Kind::object; }

    // The content. Asking for another kind than the value's is a mistake of the program: std::logic_error.
    bool boolean() const;
    double number() const;  ///< always finite
    std::string_view string() const;

    /// The number of items of an array or members of an object; 0 for everything else.
    std::size_t size() const;
    /// The i-th item of an array or member of an object, in the order of the file. std::out_of_range past the end.
    Value operator[](std::size_t i) const;
    /// Iterates over items or members: `for (const Value member : object) member.key()`.
    ValueIterator begin() const;
    ValueIterator end() const;
    /// The object's member of this key; nothing when it is missing or this is no object.
    std::optional<Value> find(std::string_view key) const;

    /// The key of an object's member, and empty for everything else.
    std::string_view key() const;

    /// Byte offset of the first character, e.g. of the opening quote or bracket.
    std::size_t offset() const;
    /// Byte offset of the opening quote of the key; offset() for what is no member of an object.
    std::size_t key_offset() const;
    /// The text of a number, true, false or null just as it was written.
    std::string_view written() const;

  private:
    friend class Document;
    friend class ValueIterator;
    Value(const DocumentData* data, std::uint32_t index) : data_(data), index_(index) {}

    const DocumentData* data_;
    std::uint32_t index_;
};

/// See Value::begin().
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

/// A JSON text (RFC 8259) with // and /* */ comments, read whole: immutable, cheap to copy, safe to share by threads.
/// The text is UTF-8, at most 256 MiB, nested at most max_depth levels deep; the keys of an object differ from each
/// other; numbers are finite; strings hold no zero character. Anything else is a SceneError.
class Document {
  public:
    static constexpr std::size_t max_bytes = std::size_t{256} << 20;
    /// A node is an object, its parameters another, and its children may be in a list: three levels. That is room for
    /// a tree of 400 nodes one in the other, which is the deepest that there may be (max_tree_depth).
    static constexpr std::size_t max_depth = 1216;

    /// Regular files only: a directory, a pipe or a device is an error at once.
    static Document from_file(const std::filesystem::path& path);
    static Document from_text(std::string text, std::string name = "<text>");

    Value root() const;
    const std::string& text() const;
    /// What errors call the file: the path as it was given.
    const std::string& name() const;

    /// The file that a string of the text names, relative to the text's own file. SceneError at the value if it leaves
    /// the folder that the files must lie in; then nothing is said of the file, not even whether there is one. A name
    /// with # stands for several files, of which a link must lead none out of that folder.
    std::filesystem::path file(Value named) const;
    /// Another document, whose file a string of the text names, at the same time. Its own files must lie in the same
    /// folder, if any.
    Document beside(Value named) const;
    /// The same text, whose files must lie in this folder or below it after following symbolic links. Use it to read
    /// untrusted scenes. SceneError if there is no such folder.
    Document with_files_within(const std::filesystem::path& folder) const;

    /// The same text, for a caller that needs the model alone. Readers check everything that the text says, but they do
    /// not open the files of lights, meshes, textures and voxels: these may be large, or missing.
    Document without_assets() const;
    /// False for what without_assets() returns, and for documents beside it.
    bool reads_assets() const;

    /// The time, in seconds, at which what changes with time is read (io/keys.hpp); 0 unless it was set.
    double seconds() const { return seconds_; }
    Document at(double seconds) const {
        Document then = *this;
        then.seconds_ = seconds;
        return then;
    }

    /// The same text, whose nodes are taken from those that an earlier reading made, where nothing of them changed, and
    /// are kept for the next (io/kept_nodes.hpp). What is read beside it does the same.
    Document with_kept_nodes(std::shared_ptr<KeptNodes> nodes) const {
        Document then = *this;
        then.kept_nodes_ = std::move(nodes);
        return then;
    }
    /// Null unless it was set.
    KeptNodes* kept_nodes() const { return kept_nodes_.get(); }

    /// An error at a byte offset, or at the first character of a value.
    SceneError error(std::size_t offset, std::string message, std::optional<std::string> suggestion = {}) const;
    SceneError error(Value value, std::string message, std::optional<std::string> suggestion = {}) const;

  private:
    explicit Document(std::shared_ptr<const DocumentData> data) : data_(std::move(data)) {}

    std::shared_ptr<const DocumentData> data_;
    struct FileAccess;
    std::shared_ptr<const FileAccess> access_;  ///< null for any file anywhere
    std::shared_ptr<KeptNodes> kept_nodes_;
    double seconds_ = 0;
};

}  // namespace phasetree
