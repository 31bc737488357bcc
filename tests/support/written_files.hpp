// Files that a test writes, to check how a reader handles them.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "phasetree/io/error.hpp"
#include "phasetree_support/temporary_directory.hpp"

namespace phasetree::tests {

template <class Content>
class WrittenFiles {
  public:
    explicit WrittenFiles(Content (*reader)(const std::filesystem::path&)) : reader_(reader) {}

    Content read(const std::string& name, const std::string& content) const {
        std::ofstream(folder_.path() / name, std::ios::binary) << content;
        return reader_(folder_.path() / name);
    }
    /// The error, without the file's folder; "read" if there is none.
    std::string said(const std::string& name, const std::string& content) const {
        try {
            (void)read(name, content);
        } catch (const SceneError& e) {
            const std::string text = e.what(), folder = folder_.path().string() + "/";
            REQUIRE(text.starts_with(folder));
            return text.substr(folder.size());
        }
        return "read";
    }
    const std::filesystem::path& path() const { return folder_.path(); }

  private:
    Content (*reader_)(const std::filesystem::path&);
    support::TemporaryDirectory folder_;
};

/// The bytes of a number as this machine has them, or in the reverse order.
template <class Number>
std::string bytes(Number n, bool is_reversed = false) {
    std::string s(sizeof n, '\0');
    std::memcpy(s.data(), &n, sizeof n);
    if (is_reversed) std::reverse(s.begin(), s.end());
    return s;
}

}  // namespace phasetree::tests
