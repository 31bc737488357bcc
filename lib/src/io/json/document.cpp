#include "phasetree/io/document.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/json/document_data.hpp"
#include "io/json/lexis.hpp"
#include "io/json/parse.hpp"
#include "io/read_file.hpp"
#include "phasetree_support/folder.hpp"

namespace phasetree {

namespace {

using Entry = DocumentData::Entry;

const Entry& expect(const DocumentData& data, std::uint32_t index, Kind kind) {
    const Entry& entry = data.values[index];
    if (static_cast<Kind>(entry.kind) != kind) {
        throw std::logic_error("phasetree::Value: asked for the content of " + std::string(name_of(kind)) +
                               ", but is " + std::string(name_of(static_cast<Kind>(entry.kind))));
    }
    return entry;
}

DocumentData::Span children_of(const Entry& entry) {
    const auto kind = static_cast<Kind>(entry.kind);
    return kind == Kind::array || kind == Kind::object ? entry.span : DocumentData::Span{0, 0};
}

}  // namespace

std::string_view name_of(Kind kind) {
    switch (kind) {
        case Kind::null:
            return "null";
        case Kind::boolean:
            return "a boolean";
        case Kind::number:
            return "a number";
        case Kind::string:
            return "a string";
        case Kind::array:
            return "an array";
        case Kind::object:
            return "an object";
    }
    return "nothing";
}

Kind Value::kind() const {
    return static_cast<Kind>(data_->values[index_].kind);
}
bool Value::boolean() const {
    return expect(*data_, index_, Kind::boolean).boolean;
}
double Value::number() const {
    return expect(*data_, index_, Kind::number).number;
}
std::string_view Value::string() const {
    return data_->string(expect(*data_, index_, Kind::string).span);
}
std::size_t Value::size() const {
    return children_of(data_->values[index_]).count;
}

Value Value::operator[](std::size_t i) const {
    const DocumentData::Span children = children_of(data_->values[index_]);
    if (i >= children.count) throw std::out_of_range("phasetree::Value: index past the end");
    return {data_, children.first + static_cast<std::uint32_t>(i)};
}

ValueIterator Value::begin() const {
    return {data_, children_of(data_->values[index_]).first};
}

ValueIterator Value::end() const {
    const DocumentData::Span children = children_of(data_->values[index_]);
    return {data_, children.first + children.count};
}

std::optional<Value> Value::find(std::string_view key) const {
    if (!is_object()) return std::nullopt;
    const DocumentData& data = *data_;
    const auto [first, count] = children_of(data.values[index_]);
    const auto key_at = [&](std::uint32_t i) { return data.key_of(data.values[i]); };
    if (count <= DocumentData::wide) {
        for (std::uint32_t i = first; i < first + count; ++i) {
            if (key_at(i) == key) return Value(data_, i);
        }
        return std::nullopt;
    }
    const auto index = std::ranges::lower_bound(data.indices, first, {}, &DocumentData::Index::first);
    const auto sorted = std::span(data.by_key).subspan(index->begin, count);
    const auto found = std::ranges::lower_bound(sorted, key, {}, key_at);
    if (found == sorted.end() || key_at(*found) != key) return std::nullopt;
    return Value(data_, *found);
}

std::string_view Value::key() const {
    return data_->key_of(data_->values[index_]);
}
std::size_t Value::offset() const {
    return data_->values[index_].offset;
}

std::size_t Value::key_offset() const {
    const Entry& entry = data_->values[index_];
    return entry.key == DocumentData::no_key ? entry.offset : data_->keys[entry.key].offset;
}

std::string_view Value::written() const {
    const std::string_view text = data_->text;
    const std::size_t first = offset();
    return text.substr(first, io::word_end(text, first) - first);
}

Document Document::from_file(const std::filesystem::path& path) {
    return from_text(io::read_file(path), path.string());
}

Document Document::from_text(std::string text, std::string name) {
    const auto data = std::make_shared<DocumentData>();
    data->name = std::move(name);
    data->text = std::move(text);
    io::parse(*data);
    return Document(data);
}

Value Document::root() const {
    return {data_.get(), data_->root};
}
const std::string& Document::text() const {
    return data_->text;
}
const std::string& Document::name() const {
    return data_->name;
}

namespace {

// Whether a path without links is in a folder or one of its subfolders.
bool is_within(const std::filesystem::path& folder, const std::filesystem::path& real) {
    const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), real.begin(), real.end());
    return end == folder.end();
}

// Whether everything that a name with # can match is within a folder. Links in its own folder may lead elsewhere; they
// count if their names begin and end like it.
bool are_layers_within(const std::filesystem::path& folder, const std::filesystem::path& name) {
    const std::string file_name = name.filename().string();
    const std::string begin = file_name.substr(0, file_name.find('#'));
    const std::string end = file_name.substr(file_name.rfind('#') + 1);
    bool all = true;
    (void)support::each_entry(name.parent_path(), [&](const std::filesystem::path& entry) {
        std::error_code problem;
        const std::string found = entry.filename().string();
        if (found.starts_with(begin) && found.ends_with(end) && std::filesystem::is_symlink(entry, problem))
            all = all && is_within(folder, std::filesystem::weakly_canonical(entry, problem)) && !problem;
        return all;
    });
    return all;
}

}  // namespace

// Which of the files that a text names may be read.
struct Document::FileAccess {
    std::optional<std::filesystem::path> within{};  // the folder's path without links
    bool has_assets = true;
};

std::filesystem::path Document::file(Value named) const {
    const std::filesystem::path path = std::filesystem::path(name()).parent_path() / named.string();
    if (!access_ || !access_->within) return path;
    const std::filesystem::path& folder = *access_->within;
    // Opens the path without links, which is the one that was checked.
    std::error_code problem;
    std::filesystem::path real = std::filesystem::weakly_canonical(std::filesystem::absolute(path, problem), problem);
    const bool is_stack = named.string().find('#') != std::string_view::npos;
    if (problem || !is_within(folder, real) || (is_stack && !are_layers_within(folder, real)))
        throw error(named, fmt::format("\"{}\" is outside {}, the folder that files must be in", named.string(),
                                       folder.string()));
    return real;
}

Document Document::beside(Value named) const {
    Document other = from_file(file(named));
    other.access_ = access_;
    other.kept_nodes_ = kept_nodes_;
    other.seconds_ = seconds_;
    return other;
}

Document Document::with_files_within(const std::filesystem::path& folder) const {
    std::error_code problem;
    std::filesystem::path real = std::filesystem::canonical(folder, problem);
    if (problem || !std::filesystem::is_directory(real, problem)) throw SceneError(folder.string(), "is not a folder");
    Document confined = *this;
    confined.access_ = std::make_shared<const FileAccess>(FileAccess{std::move(real), reads_assets()});
    return confined;
}

Document Document::without_assets() const {
    Document other = *this;
    other.access_ = std::make_shared<const FileAccess>(FileAccess{access_ ? access_->within : std::nullopt, false});
    return other;
}

bool Document::reads_assets() const {
    return !access_ || access_->has_assets;
}

SceneError Document::error(std::size_t offset, std::string message, std::optional<std::string> suggestion) const {
    return {data_->name, data_->text, offset, std::move(message), std::move(suggestion)};
}

SceneError Document::error(Value value, std::string message, std::optional<std::string> suggestion) const {
    return error(value.offset(), std::move(message), std::move(suggestion));
}

}  // namespace phasetree
