// URIs of a glTF document: bytes that are encoded in it ("data:…"), or a file in its folder.
//
// Reference: RFC 3986 (URI: generic syntax), RFC 2397 (the "data" URL scheme), RFC 4648 (base 64).
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace phasetree::tracer::gltf {

/// Reads a whole file. The path is relative to the folder of the document and has no "..". It may throw any exception.
using ReadFile = std::function<std::string(const std::string& path)>;

/// All bytes to which a URI refers. Throws GltfError for a URI that is neither of the two, or that names a file outside
/// the document's folder. The caller puts the place of the URI before the message.
std::string bytes_of_uri(std::string_view uri, const ReadFile& read_file);

/// The path of the file that a URI names, relative to the folder of the document; empty for data. Throws as above.
std::string path_of_uri(std::string_view uri);

}  // namespace phasetree::tracer::gltf
