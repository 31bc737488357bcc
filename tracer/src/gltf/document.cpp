#include "gltf/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

namespace phasetree::tracer::gltf {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers of .glb files are little-endian");

constexpr std::uint32_t json_chunk = 0x4E4F534A, bytes_chunk = 0x004E4942;

constexpr std::size_t most_bytes_of_json = std::size_t{64} << 20;
constexpr std::size_t most_depth = 64;
constexpr std::size_t most_bytes_of_buffers = std::size_t{1} << 30;

// The nesting depth of the brackets of a JSON text, ignoring those in strings.
std::size_t depth_of(std::string_view text) {
    std::size_t depth = 0, most = 0;
    bool is_in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') is_in_string = !is_in_string;
        if (is_in_string) {
            i += c == '\\' ? 1 : 0;  // the character after a backslash does not end a string
        } else if (c == '{' || c == '[') {
            most = std::max(most, ++depth);
        } else if (depth > 0 && (c == '}' || c == ']')) {
            --depth;
        }
    }
    return most;
}

std::uint32_t number_at(std::string_view content, std::size_t at) {
    if (content.size() < at + 4) throw GltfError("the file ends too early");
    std::uint32_t n;
    std::memcpy(&n, content.data() + at, sizeof n);
    return n;
}

// Removes the next chunk from the content and returns its bytes.
std::string_view next_chunk(std::string_view& content, std::uint32_t& type) {
    const std::size_t size = number_at(content, 0);
    type = number_at(content, 4);
    if (content.size() - 8 < size) throw GltfError("the file ends too early");
    const std::string_view chunk = content.substr(8, size);
    content.remove_prefix(8 + size);
    return chunk;
}

}  // namespace

void Item::fail(std::string_view what) const {
    throw GltfError(fmt::format("{} {}", place_.empty() ? "the file" : place_, what));
}

const Json* Item::find(std::string_view key) const {
    if (!json_->is_object()) fail("must be an object");
    const auto found = json_->find(key);
    return found == json_->end() ? nullptr : &*found;
}

std::optional<Item> Item::item(std::string_view key) const {
    const Json* found = find(key);
    if (!found) return std::nullopt;
    return Item(*found, fmt::format("{}{}{}", place_, place_.empty() ? "" : ".", key));
}

std::optional<Item> Item::extension(std::string_view name) const {
    const auto extensions = item("extensions");
    return extensions ? extensions->item(name) : std::nullopt;
}

std::vector<Item> Item::items(std::string_view key) const {
    std::vector<Item> all;
    const Json* list = find(key);
    if (!list) return all;
    if (!list->is_array()) fail(fmt::format("must have a list \"{}\"", key));
    for (const Json& json : *list)
        all.emplace_back(json, fmt::format("{}{}{}[{}]", place_, place_.empty() ? "" : ".", key, all.size()));
    return all;
}

std::size_t Item::index_of(const Json& json, std::string_view key) const {
    // Files hold no more than 4 GB, so no valid index or count is larger.
    if (!json.is_number_unsigned() || json.get<std::uint64_t>() > 0xFFFFFFFF)
        fail(fmt::format("must have a whole number \"{}\"", key));
    return json.get<std::size_t>();
}

std::optional<std::size_t> Item::index(std::string_view key) const {
    const Json* found = find(key);
    if (!found) return std::nullopt;
    return index_of(*found, key);
}

std::size_t Item::needed_index(std::string_view key) const {
    const auto found = index(key);
    if (!found) fail(fmt::format("has no \"{}\"", key));
    return *found;
}

std::vector<std::size_t> Item::indices(std::string_view key) const {
    std::vector<std::size_t> all;
    const Json* list = find(key);
    if (!list) return all;
    if (!list->is_array()) fail(fmt::format("must have a list \"{}\"", key));
    for (const Json& json : *list) all.push_back(index_of(json, key));
    return all;
}

std::optional<std::vector<float>> Item::numbers(std::string_view key, std::size_t count) const {
    const Json* list = find(key);
    if (!list) return std::nullopt;
    if (!list->is_array() || list->size() != count) fail(fmt::format("must have {} numbers in \"{}\"", count, key));
    std::vector<float> all;
    for (const Json& json : *list) {
        const double value = json.is_number() ? json.get<double>() : std::nan("");
        if (!(std::abs(value) <= most_magnitude))
            fail(fmt::format("must have numbers in \"{}\", each at most 10¹⁵ in magnitude", key));
        all.push_back(static_cast<float>(value));
    }
    return all;
}

float Item::number(std::string_view key, float otherwise) const {
    const Json* found = find(key);
    if (!found) return otherwise;
    const double value = found->is_number() ? found->get<double>() : std::nan("");
    if (!(std::abs(value) <= most_magnitude))
        fail(fmt::format("must have a number \"{}\", at most 10¹⁵ in magnitude", key));
    return static_cast<float>(value);
}

glm::vec3 Item::vec3(std::string_view key, const glm::vec3& otherwise) const {
    const auto found = numbers(key, 3);
    return found ? glm::vec3((*found)[0], (*found)[1], (*found)[2]) : otherwise;
}

std::string Item::text(std::string_view key) const {
    const Json* found = find(key);
    return found && found->is_string() ? found->get<std::string>() : std::string();
}

std::vector<std::string> Item::texts(std::string_view key) const {
    std::vector<std::string> all;
    const Json* list = find(key);
    if (list && list->is_array())
        for (const Json& json : *list) all.push_back(json.is_string() ? json.get<std::string>() : std::string());
    return all;
}

bool Item::flag(std::string_view key, bool otherwise) const {
    const Json* found = find(key);
    return found && found->is_boolean() ? found->get<bool>() : otherwise;
}

std::size_t Item::count(std::string_view key) const {
    const Json* list = find(key);
    return list && list->is_array() ? list->size() : 0;
}

std::vector<std::string> Item::keys() const {
    std::vector<std::string> all;
    if (json_->is_object())
        for (const auto& [key, value] : json_->items()) all.push_back(key);
    return all;
}

Document::Document(std::string_view content, ReadFile read_file) : read_file_(std::move(read_file)) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    std::string_view text = content;
    if (content.starts_with("glTF")) {
        if (number_at(content, 4) != 2) throw GltfError("it is not glTF version 2");
        content = content.substr(0, number_at(content, 8));
        content.remove_prefix(std::min<std::size_t>(12, content.size()));
        std::uint32_t type = 0;
        text = next_chunk(content, type);
        if (type != json_chunk) throw GltfError("it does not begin with a JSON document");
        if (content.size() >= 8) {
            const std::string_view chunk = next_chunk(content, type);
            if (type == bytes_chunk) bytes_ = chunk;
        }
    } else if (text.starts_with(byte_order_mark)) {
        text.remove_prefix(byte_order_mark.size());
    }
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos || text[first] != '{')
        throw GltfError("it is not a glTF file: it begins neither with \"glTF\" nor with a JSON document");
    if (text.size() > most_bytes_of_json) throw GltfError("its JSON document is larger than 64 MiB");
    // Each level costs memory in the parser.
    if (depth_of(text) > most_depth)
        throw GltfError(fmt::format("its JSON document is nested more than {} levels deep", most_depth));
    json_ = Json::parse(text, nullptr, false);
    if (!json_.is_object()) throw GltfError("its document is not valid JSON in UTF-8");
    check_version();
    read_buffers();
}

void Document::check_version() const {
    const auto asset = root().item("asset");
    const std::string version = asset ? asset->text("version") : "", least = asset ? asset->text("minVersion") : "";
    if (!version.starts_with("2.") || (!least.empty() && least != "2.0")) throw GltfError("it is not glTF version 2.0");
}

std::size_t Document::count(const char* list) const {
    return root().count(list);
}

Item Document::element(const char* list, std::size_t index, const Item& from) const {
    if (index >= count(list))
        from.fail(fmt::format("refers to {}[{}], but there are only {}", list, index, count(list)));
    return {json_[list][index], fmt::format("{}[{}]", list, index)};
}

std::string Document::bytes_of(const Item& named) const {
    try {
        return bytes_of_uri(named.text("uri"), read_file_);
    } catch (const GltfError& e) {
        named.fail(e.what());
    }
}

void Document::read_buffers() {
    buffers_.resize(count("buffers"));
    std::size_t left = most_bytes_of_buffers;
    for (std::size_t i = 0; i < buffers_.size(); ++i) {
        const Item buffer = element("buffers", i, root());
        if (!buffer.has("uri")) continue;
        buffers_[i] = bytes_of(buffer);
        if (buffers_[i].size() > left) throw GltfError("its buffers exceed 1 GiB in total");
        left -= buffers_[i].size();
    }
}

std::string_view Document::view(std::size_t index, const Item& from) const {
    return bytes_in_buffer(element("bufferViews", index, from));
}

std::string_view Document::bytes_in_buffer(const Item& view) const {
    const std::size_t number = view.needed_index("buffer");
    const Item buffer = element("buffers", number, view);
    const bool has_uri = buffer.has("uri");
    if (!has_uri && number != 0) buffer.fail("has no bytes");
    const std::string_view bytes = has_uri ? std::string_view(buffers_[number]) : bytes_;
    const std::size_t offset = view.index("byteOffset").value_or(0), length = view.needed_index("byteLength");
    if (offset > bytes.size() || length > bytes.size() - offset) view.fail("extends beyond the end of its buffer");
    return bytes.substr(offset, length);
}

std::string Document::image(const Item& image) const {
    if (const auto number = image.index("bufferView")) return std::string(view(*number, image));
    if (!image.has("uri")) image.fail("has no bytes");
    return bytes_of(image);
}

std::vector<std::string> Document::files() const {
    std::vector<std::string> files;
    for (const char* list : {"buffers", "images"})
        for (std::size_t i = 0; i < count(list); ++i) try {
                const Item item = element(list, i, root());
                std::string path = item.has("uri") ? path_of_uri(item.text("uri")) : "";
                if (!path.empty()) files.push_back(std::move(path));
            } catch (const GltfError&) {  // it does not name a file that can be read
            }
    return files;
}

}  // namespace phasetree::tracer::gltf
