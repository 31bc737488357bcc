// Lists a folder with POSIX functions. The directory iterator of libstdc++ 12 allocates memory in functions that must
// not throw, so it ends the process if memory runs out.
#pragma once

#include <dirent.h>

#include <cerrno>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>

namespace phasetree::support {

/// Calls `f` with the path of each entry, in any order, until it returns false. Returns the error if the folder cannot
/// be read. Throws what `f` throws, and std::bad_alloc.
template <class F>
std::error_code each_entry(const std::filesystem::path& folder, F&& f) {
    struct Close {
        void operator()(DIR* open) const { ::closedir(open); }
    };
    const std::unique_ptr<DIR, Close> open(::opendir(folder.c_str()));
    if (!open) return {errno, std::generic_category()};
    for (;;) {
        errno = 0;
        const dirent* const entry = ::readdir(open.get());
        if (entry == nullptr) return {errno, std::generic_category()};
        const std::string_view name = entry->d_name;
        if (name == "." || name == "..") continue;
        if (!f(folder / name)) return {};
    }
}

}  // namespace phasetree::support
