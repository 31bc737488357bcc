// What is in a folder, by POSIX: the directory iterator of libstdc++ 12 takes memory where nothing may be thrown, so
// when that runs out the process would end.
#pragma once

#include <dirent.h>

#include <cerrno>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>

namespace phasetree::support {

/// Calls `f` with the path of each entry, in any order, until it returns false. Returns what went wrong with the
/// folder, if anything did; throws what `f` throws, and std::bad_alloc.
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
