// Version and build of the library. All strings are valid for the lifetime of the program.
#pragma once

namespace phasetree {

/// The library's version, "major.minor.patch".
const char* version();

/// The version and a hash of the sources, the compiler and the processor architecture: "0.10.0+3f2a91c04d7e". Cell
/// files, and the part and checkpoint files of the path tracer, can only be combined if their build_id() is the same,
/// because different builds may compute different bits.
const char* build_id();

/// The latest commit that changed the sources, for display only and never compared: "8f1d19c6a3b2", "8f1d19c6a3b2 with
/// changes", or "" if the sources came without their history.
const char* source_commit();

/// The compiler's name and version: "GNU 12.2.0".
const char* compiler();

}  // namespace phasetree
