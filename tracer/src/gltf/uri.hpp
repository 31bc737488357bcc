// What a glTF document names by a URI: bytes that are written into it ("data:…"), or a file beside it.
//
// Reference: RFC 3986 (URI: generic syntax), RFC 2397 (the "data" URL scheme), RFC 4648 (base 64).
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace phasetree::tracer::gltf {

/// Gives all bytes of a file, by its path from the folder of the document, which is relative and has no "..". It may
/// throw what it wants.
using ReadFile = std::function<std::string(const std::string& path)>;

/// All bytes that a URI names. Throws GltfError, whose message is to follow the place of the URI, for a URI that is
/// neither of the two, or that names a file outside the document's folder.
std::string bytes_of_uri(std::string_view uri, const ReadFile& read_file);

/// The path of the file that a URI names, from the folder of the document; empty for data. Throws as above.
std::string path_of_uri(std::string_view uri);

}  // namespace phasetree::tracer::gltf
