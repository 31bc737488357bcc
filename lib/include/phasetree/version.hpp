#pragma once

namespace phasetree {

/// The library's version, "major.minor.patch". The string is valid for the lifetime of the program.
const char* version();

}  // namespace phasetree
