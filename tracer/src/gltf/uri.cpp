#include "gltf/uri.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>

#include "gltf/document.hpp"

namespace phasetree::tracer::gltf {

namespace {

int digit_of(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

// Whether a text has this ending, ignoring case. The ending is in lower case.
bool has_ending(std::string_view text, std::string_view ending) {
    if (text.size() < ending.size()) return false;
    return std::ranges::equal(text.substr(text.size() - ending.size()), ending,
                              [](unsigned char a, char b) { return std::tolower(a) == static_cast<unsigned char>(b); });
}

// Decodes escapes such as %20. Invalid ones are kept, because some programs write names without escaping them.
std::string without_percents(std::string_view text) {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool is_code =
            text[i] == '%' && i + 2 < text.size() && digit_of(text[i + 1]) >= 0 && digit_of(text[i + 2]) >= 0;
        plain += is_code ? static_cast<char>(16 * digit_of(text[i + 1]) + digit_of(text[i + 2])) : text[i];
        i += is_code ? 2 : 0;
    }
    return plain;
}

int value_in_base64(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    if (c == '/' || c == '_') return 63;
    return -1;
}

std::string from_base64(std::string_view text) {
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        if (c == '=') break;
        if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
        const int value = value_in_base64(c);
        if (value < 0) throw GltfError("has data that are not valid base64");
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 0xFF);
    }
    return bytes;
}

// Whether it begins with a scheme such as "https:"; "C:" counts as one.
bool has_scheme(std::string_view uri) {
    const std::size_t colon = uri.find_first_of(":/?#");
    return colon != std::string_view::npos && colon > 0 && uri[colon] == ':' &&
           std::ranges::all_of(uri.substr(0, colon), [](unsigned char c) {
               return std::isalnum(c) != 0 || c == '+' || c == '-' || c == '.';
           });
}

bool is_data(std::string_view uri) {
    return has_ending(uri.substr(0, 5), "data:");
}

}  // namespace

std::string path_of_uri(std::string_view uri) {
    if (is_data(uri)) return {};
    if (has_scheme(uri)) throw GltfError("is outside the folder of the document; files are never downloaded");
    std::string path = without_percents(uri);
    // Some programs on Windows write backslashes.
    std::ranges::replace(path, '\\', '/');
    const std::filesystem::path relative(path);
    const bool leaves = std::ranges::find(relative, std::filesystem::path("..")) != relative.end();
    if (path.empty() || path.find('\0') != std::string::npos || relative.is_absolute() || leaves)
        throw GltfError("must name a file in the folder of the document or in a subfolder");
    return path;
}

std::string bytes_of_uri(std::string_view uri, const ReadFile& read_file) {
    if (!is_data(uri)) {
        const std::string path = path_of_uri(uri);
        if (!read_file) throw GltfError("is in a separate file");
        return read_file(path);
    }
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) throw GltfError("has no comma before its data");
    std::string data = without_percents(uri.substr(comma + 1));
    return has_ending(uri.substr(0, comma), ";base64") ? from_base64(data) : data;
}

}  // namespace phasetree::tracer::gltf
