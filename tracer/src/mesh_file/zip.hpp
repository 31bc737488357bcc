// ZIP archives (PKWARE, APPNOTE.TXT 6.3), as far as packages of documents need them: a few files, compressed.
#pragma once

#include <span>
#include <string>

namespace phasetree::tracer {

struct ZipFile {
    std::string name;  ///< of ASCII
    std::string bytes;
};

/// The bytes of an archive. The same files give the same bytes: all are dated the first of January 1980. Throws
/// std::length_error if it would have more than 2 GB.
std::string zip_of(std::span<const ZipFile>);

}  // namespace phasetree::tracer
