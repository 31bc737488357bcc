// What `phasetree --version` prints.
#pragma once

#include <string>

namespace phasetree::tracer {

/// The build, and a line for each library that it was built with or without, for people and scripts: the first line is
/// "phasetree" and build_id(), and each of the others a name, a colon and a value. The value is "no" for an optional
/// library that is missing. Names stay as they are in later versions, which may add lines. The last line
/// does not end with a line feed.
std::string version_report();

}  // namespace phasetree::tracer
