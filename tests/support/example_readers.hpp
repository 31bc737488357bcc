#pragma once

/// Readers for the files that examples name, without the libraries that read them.

#include <functional>

#include "phasetree/io/file_readers.hpp"

namespace phasetree::tests {

/// For each content that a program reads, a reader of contents that suit the examples of the nodes (scenes/nodes).
/// `check` is called with each name first, and may throw.
FileReaders example_readers(std::function<void(const std::filesystem::path&)> check = {});

}  // namespace phasetree::tests
