#include "output/file.hpp"

#include <fmt/format.h>

#include "output/error.hpp"
#include "phasetree_support/whole_file.hpp"

namespace phasetree::tracer {
namespace {

OutputError failure(const std::filesystem::path& path, const support::FileError& error) {
    return OutputError(fmt::format("cannot write \"{}\": {}", path.string(), error.what()));
}

}  // namespace

void write_file(std::span<const unsigned char> bytes, const std::filesystem::path& path) {
    try {
        support::WholeFile file(path);
        file.write(std::as_bytes(bytes));
        file.finish();
    } catch (const support::FileError& error) {
        throw failure(path, error);
    }
}

void check_file_writable(const std::filesystem::path& path) {
    try {
        const support::WholeFile unfinished(path);
    } catch (const support::FileError& error) {
        throw failure(path, error);
    }
}

}  // namespace phasetree::tracer
