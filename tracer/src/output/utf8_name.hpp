// Names of files that are written into JSON.
#pragma once

#include <string>

namespace phasetree::tracer {

/// Throws OutputNameError if the name of a file is not UTF-8. JSON must be UTF-8, but names of files may have any
/// bytes.
void require_utf8(const std::string& name);

}  // namespace phasetree::tracer
