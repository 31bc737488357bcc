#include "output/file.hpp"

#include <fmt/format.h>
#include <system_error>

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

struct FilesTogether::File {
    explicit File(const std::filesystem::path& name) : path(name), content(name) {
        std::error_code ignored;
        is_new = !std::filesystem::exists(path, ignored);
    }

    std::filesystem::path path;
    support::WholeFile content;
    bool is_new = false;
};

FilesTogether::FilesTogether() = default;
FilesTogether::~FilesTogether() = default;

void FilesTogether::add(std::string_view bytes, const std::filesystem::path& path) {
    try {
        support::WholeFile& content = files_.emplace_back(path).content;
        content.write(std::as_bytes(std::span(bytes)));
        content.close();
    } catch (const support::FileError& error) {
        throw failure(path, error);
    }
}

void FilesTogether::finish() {
    for (auto file = files_.begin(); file != files_.end(); ++file) try {
            file->content.finish();
        } catch (const support::FileError& error) {
            std::error_code ignored;
            for (auto renamed = files_.begin(); renamed != file; ++renamed)
                if (renamed->is_new) std::filesystem::remove(renamed->path, ignored);
            throw failure(file->path, error);
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
