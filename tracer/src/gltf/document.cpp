#include "gltf/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace phasetree::tracer::gltf {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers of .glb files are little-endian");

constexpr std::uint32_t json_chunk = 0x4E4F534A, bytes_chunk = 0x004E4942;

constexpr std::size_t most_bytes = std::size_t{64} << 20;
constexpr std::size_t deepest = 64;

// What files may require: what is read, and what changes how a surface looks but not where it is. A file that requires
// another extension is refused, by its name if it is one of those that programs write.
constexpr std::array<std::string_view, 3> known_extensions{"KHR_texture_transform", "KHR_mesh_quantization",
                                                           "KHR_lights_punctual"};
constexpr std::string_view known_beginning = "KHR_materials_";
constexpr std::array<std::string_view, 5> unread_extensions{"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                                            "KHR_texture_basisu", "EXT_texture_webp",
                                                            "EXT_mesh_gpu_instancing"};

// How deep the brackets of a JSON text are within each other, those in strings aside.
std::size_t depth_of(std::string_view text) {
    std::size_t depth = 0, most = 0;
    bool is_in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') is_in_string = !is_in_string;
        if (is_in_string) {
            i += c == '\\' ? 1 : 0;  // what is behind a backslash ends no string
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

// The bytes of the next chunk, which is taken off the content.
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
    throw GltfError(fmt::format("{} {}", place_, what));
}

const Json* Item::find(std::string_view key) const {
    if (!json_->is_object()) fail("should be an object");
    const auto found = json_->find(key);
    return found == json_->end() ? nullptr : &*found;
}

std::optional<Item> Item::item(std::string_view key) const {
    const Json* found = find(key);
    if (!found) return std::nullopt;
    return Item(*found, fmt::format("\"{}\" of {}", key, place_));
}

std::vector<Item> Item::items(std::string_view key) const {
    std::vector<Item> all;
    const Json* list = find(key);
    if (!list) return all;
    if (!list->is_array()) fail(fmt::format("should have a list \"{}\"", key));
    for (const Json& json : *list) all.emplace_back(json, fmt::format("\"{}\" {} of {}", key, all.size(), place_));
    return all;
}

std::size_t Item::index_of(const Json& json, std::string_view key) const {
    // Files hold no more than 4 GB, so no valid index or count is larger.
    if (!json.is_number_unsigned() || json.get<std::uint64_t>() > 0xFFFFFFFF)
        fail(fmt::format("should have a whole number \"{}\"", key));
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
    if (!list->is_array()) fail(fmt::format("should have a list \"{}\"", key));
    for (const Json& json : *list) all.push_back(index_of(json, key));
    return all;
}

std::optional<std::vector<float>> Item::numbers(std::string_view key, std::size_t count) const {
    const Json* list = find(key);
    if (!list) return std::nullopt;
    if (!list->is_array() || list->size() != count) fail(fmt::format("should have {} numbers in \"{}\"", count, key));
    std::vector<float> all;
    for (const Json& json : *list) {
        const double value = json.is_number() ? json.get<double>() : std::nan("");
        // A coordinate of a scene is at most 10¹⁵, and squares of these are floats.
        if (!(std::abs(value) <= 1e15)) fail(fmt::format("has something else than a number in \"{}\"", key));
        all.push_back(static_cast<float>(value));
    }
    return all;
}

float Item::number(std::string_view key, float otherwise) const {
    const Json* found = find(key);
    if (!found) return otherwise;
    const double value = found->is_number() ? found->get<double>() : std::nan("");
    if (!(std::abs(value) <= 1e15)) fail(fmt::format("should have a number \"{}\"", key));
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

bool Item::flag(std::string_view key) const {
    const Json* found = find(key);
    return found && found->is_boolean() && found->get<bool>();
}

std::vector<std::string> Item::keys() const {
    std::vector<std::string> all;
    if (json_->is_object())
        for (const auto& [key, value] : json_->items()) all.push_back(key);
    return all;
}

Document::Document(std::string_view content) {
    if (content.starts_with("{") || content.starts_with("\xEF\xBB\xBF{"))
        throw GltfError("it is a .gltf file, whose parts are files of their own; save it as glTF Binary, .glb");
    if (!content.starts_with("glTF")) throw GltfError("it is no .glb file: it does not begin with \"glTF\"");
    if (number_at(content, 4) != 2) throw GltfError("it is not of version 2 of glTF");
    content = content.substr(0, number_at(content, 8));
    content.remove_prefix(std::min<std::size_t>(12, content.size()));
    std::uint32_t type = 0;
    const std::string_view text = next_chunk(content, type);
    if (type != json_chunk) throw GltfError("it does not begin with a document");
    if (text.size() > most_bytes) throw GltfError("its document is larger than 64 MiB");
    // Each bracket takes much memory while another is within it.
    if (depth_of(text) > deepest) throw GltfError(fmt::format("its document is deeper than {} brackets", deepest));
    json_ = Json::parse(text, nullptr, false);
    if (!json_.is_object()) throw GltfError("its document is not JSON");
    if (content.size() >= 8) {
        const std::string_view chunk = next_chunk(content, type);
        if (type == bytes_chunk) bytes_ = chunk;
    }
    check_extensions();
}

void Document::check_extensions() const {
    const auto required = json_.find("extensionsRequired");
    if (required == json_.end() || !required->is_array()) return;
    for (const Json& json : *required) {
        const std::string name = json.is_string() ? json.get<std::string>() : std::string();
        if (name.starts_with(known_beginning) || std::ranges::find(known_extensions, name) != known_extensions.end())
            continue;
        const bool has_name = std::ranges::find(unread_extensions, name) != unread_extensions.end();
        throw GltfError(fmt::format("it requires {}, which this program does not read; save it without",
                                    has_name ? name : "an extension of glTF"));
    }
}

std::size_t Document::count(const char* list) const {
    const auto found = json_.find(list);
    return found != json_.end() && found->is_array() ? found->size() : 0;
}

Item Document::element(const char* list, std::size_t index, const Item& from) const {
    if (index >= count(list)) from.fail(fmt::format("refers to {} of \"{}\", which has {}", index, list, count(list)));
    return {json_[list][index], fmt::format("{} of \"{}\"", index, list)};
}

std::string_view Document::view(std::size_t index, const Item& from) const {
    const Item view = element("bufferViews", index, from);
    const std::size_t buffer = view.needed_index("buffer");
    if (buffer != 0 || element("buffers", buffer, view).has("uri"))
        view.fail("is in another file; save all in one file, .glb");
    const std::size_t offset = view.index("byteOffset").value_or(0), length = view.needed_index("byteLength");
    if (offset > bytes_.size() || length > bytes_.size() - offset) view.fail("is beyond the end of the file");
    return bytes_.substr(offset, length);
}

}  // namespace phasetree::tracer::gltf
