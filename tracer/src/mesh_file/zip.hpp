// ZIP archives (PKWARE, APPNOTE.TXT 6.3), as far as document packages need them: a few compressed files.
#pragma once

#include <span>
#include <string>

namespace phasetree::tracer {

struct ZipFile {
    std::string name;  ///< ASCII
    std::string bytes;
};

/// The bytes of an archive. Equal files give equal bytes, because all are dated 1 January 1980. Throws
/// std::length_error if the archive would exceed 2 GB.
std::string zip_of(std::span<const ZipFile>);

}  // namespace phasetree::tracer
