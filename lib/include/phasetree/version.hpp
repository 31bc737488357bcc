#pragma once

/// Which phasetree this is. All strings live as long as the program.
namespace phasetree {

/// The library's version, "major.minor.patch".
const char* version();

/// The version and a hash of the sources, the compiler and the processor architecture: "0.9.0+3f2a91c04d7e". Files of
/// cells, parts and checkpoints fit together only if their build_id() is the same, because another build may compute
/// other bits.
const char* build_id();

/// The latest commit that changed the sources, for people: "8f1d19c6a3b2", "8f1d19c6a3b2 with changes", or "" if the
/// sources came without their history. Never compared.
const char* source_commit();

/// The compiler's name and version: "GNU 12.2.0".
const char* compiler();

}  // namespace phasetree
