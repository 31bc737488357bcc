#include "command/reading.hpp"

#include <fmt/format.h>

#include <system_error>

#include "command/exit_codes.hpp"
#include "command/load.hpp"
#include "output/late_progress.hpp"
#include "output/preparation_progress.hpp"
#include "phasetree_support/reading.hpp"
#include "scene/fingerprint.hpp"
#include "scene/named_files.hpp"

namespace phasetree::tracer {

namespace {

// Runs `read`, which reads this many bytes, with a progress bar.
template <class Read>
auto showing(const char* task, std::uint64_t bytes, bool quiet, Read&& read) {
    LateProgress progress(ProgressOutput::standard_error(quiet), task);
    std::uint64_t done = 0;
    const support::ReadingListener listener([&](std::uint64_t more) {
        done += more;
        // Some bytes may not have been counted, so never report a progress of 1, which would read as complete.
        const double share = static_cast<double>(done) / static_cast<double>(std::max(bytes, std::uint64_t{1}));
        progress.tell(std::min(share, 0.9999));
    });
    auto result = read();
    progress.tell(1);
    return result;
}

}  // namespace

EndingAtOnce ending_at_once(std::string_view what, bool can_resume) {
    // Erases a progress bar, if one is drawn.
    const char* start = ProgressOutput::standard_error(false).terminal ? "\r\x1b[K" : "";
    return {{exit_code::interrupted, can_resume ? exit_code::resumable : exit_code::failure},
            fmt::format("{}phasetree: interrupted while {}; no file was written\n", start, what)};
}

EndingAtOnce ending_before_results() {
    const char* start = ProgressOutput::standard_error(false).terminal ? "\r\x1b[K" : "";
    return {{exit_code::interrupted, exit_code::failure},
            fmt::format("{}phasetree: interrupted while the scene was being read; nothing is known yet\n", start)};
}

Document read_document_showing(const SceneFile& file, bool quiet) {
    std::error_code unknown;
    const std::uintmax_t size = file.is_standard_input() ? 0 : std::filesystem::file_size(file.name, unknown);
    return showing("reading the scene", unknown ? 0 : size, quiet, [&] { return read_document(file); });
}

Scene load_scene_showing(const Document& document, bool quiet) {
    const PreparationProgress preparing(ProgressOutput::standard_error(quiet));
    return showing("reading the scene's files", bytes_of_named_files(document), quiet,
                   [&] { return load_scene(document); });
}

std::uint64_t fingerprint_showing(const Document& document, bool quiet) {
    return showing("checking the scene's files", bytes_of_named_files(document), quiet,
                   [&] { return fingerprint(document); });
}

}  // namespace phasetree::tracer
