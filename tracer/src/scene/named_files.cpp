#include "scene/named_files.hpp"

#include <optional>
#include <stdexcept>
#include <system_error>

#include "scene/gltf_files.hpp"
#include "scene/placed.hpp"
#include "volume/read_volume.hpp"

namespace phasetree::tracer {

namespace {

std::optional<std::filesystem::path> named_file(const Document& document, Value string) {
    if (string.string().empty()) return std::nullopt;
    try {
        std::error_code problem;
        std::filesystem::path path = document.file(string);
        if (std::filesystem::is_regular_file(path, problem)) return path;
    } catch (const SceneError&) {  // outside the folder that files must be in, so it is never read
    }
    return std::nullopt;
}

// Text like "#rrggbb" is not a file name.
bool is_colour(std::string_view text) {
    return text.starts_with('#') && text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string_view::npos;
}

// The images of a stack; empty if the string does not name one.
std::vector<std::filesystem::path> layers_named_by(const Document& document, Value string) {
    std::vector<std::filesystem::path> layers;
    try {
        for (std::filesystem::path& layer : layers_of_stack(document.file(string))) {
            std::error_code problem;
            if (std::filesystem::is_regular_file(layer, problem)) layers.push_back(std::move(layer));
        }
    } catch (const std::runtime_error&) {  // the reader reports it if there should be a stack
    }
    return layers;
}

std::uint64_t bytes_named_in(const Document& document, Value value) {
    std::uint64_t bytes = 0;
    if (value.kind() == Kind::string) {
        for (const std::filesystem::path& path : named_files(document, value)) {
            std::error_code problem;
            const std::uintmax_t size = std::filesystem::file_size(path, problem);
            bytes += problem ? 0 : size;
        }
        return bytes;
    }
    if (value.kind() == Kind::array || value.kind() == Kind::object)
        for (const Value member : value) bytes += bytes_named_in(document, member);
    return bytes;
}

}  // namespace

std::vector<std::filesystem::path> named_files(const Document& document, Value string) {
    if (is_colour(string.string())) return {};
    std::vector<std::filesystem::path> files;
    if (std::filesystem::path(string.string()).filename().string().find('#') != std::string::npos)
        files = layers_named_by(document, string);
    if (const auto path = named_file(document, string)) {
        files.push_back(*path);
        if (is_gltf(*path))
            for (std::filesystem::path& file : files_of_gltf(*path)) files.push_back(std::move(file));
    }
    return files;
}

void each_document(const Document& document, const std::function<void(const Document&)>& f) {
    f(document);
    const auto objects = has_objects(document) ? document.root().find("objects") : std::nullopt;
    if (!objects) return;
    for (const Value object : *objects)
        if (const auto file = object.find("file"); file && file->is_string()) f(document.beside(*file));
}

std::uint64_t bytes_of_named_files(const Document& document) {
    std::uint64_t bytes = 0;
    try {
        each_document(document, [&](const Document& d) { bytes += bytes_named_in(d, d.root()); });
    } catch (const SceneError&) {  // reading the scene reports the same error
    }
    return bytes;
}

}  // namespace phasetree::tracer
