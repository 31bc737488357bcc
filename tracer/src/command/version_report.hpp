// What `phasetree --version` prints.
#pragma once

#include <string>

namespace phasetree::tracer {

/// The build, and one line per optional or required library, for people and scripts. The first line is "phasetree" and
/// build_id(); each other line is a name, a colon and a value, which is "no" for a missing optional library. Later
/// versions may add lines but do not change names. The last line does not end with a line feed.
std::string version_report();

}  // namespace phasetree::tracer
