#include "command/scene_file.hpp"

#include <unistd.h>
#include <CLI/CLI.hpp>

#include <cerrno>
#include <cmath>
#include <system_error>

namespace phasetree::tracer {

namespace {

std::string standard_input(const std::string& shown) {
    std::string text;
    std::size_t length = 0;
    while (true) {
        text.resize(std::max<std::size_t>(2 * length, 1 << 16));
        const ssize_t got = ::read(STDIN_FILENO, text.data() + length, text.size() - length);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw SceneError(shown, "cannot be read: " + std::generic_category().message(errno));
        length += static_cast<std::size_t>(got);
        if (length > Document::max_bytes) throw SceneError(shown, "is larger than 256 MiB");
        if (got == 0) break;
    }
    text.resize(length);
    return text;
}

}  // namespace

std::shared_ptr<SceneFile> add_scene_file(CLI::App& command) {
    auto file = std::make_shared<SceneFile>();
    command.add_option("scene", file->name, "Scene file; - reads standard input")->required();
    command
        .add_option("--assets-within", file->assets_within,
                    "Reject files named by the scene that lie outside this folder once links are followed. Use this "
                    "for untrusted scenes (default: any file may be named)")
        ->option_text("DIR");
    command.add_option("--at", file->at, "Time, in seconds, at which to read an animated scene (default: 0)")
        ->check([](const std::string& text) {
            double seconds = 0;
            const bool is_time = CLI::detail::lexical_cast(text, seconds) && std::isfinite(seconds);
            return std::string(is_time ? "" : "must be a number of seconds");
        })
        ->option_text("SECONDS");
    return file;
}

void add_object(CLI::App& command, std::optional<std::string>& object) {
    command
        .add_option("--object", object,
                    "Use only this object of a scene with several, in its own space (default: all of them, placed in "
                    "the scene)")
        ->option_text("NAME");
}

Document read_document(const SceneFile& file) {
    const Document document = file.is_standard_input() ? Document::from_text(standard_input(file.shown()), file.shown())
                                                       : Document::from_file(file.name);
    const Document then = document.at(file.at.value_or(0));
    return file.assets_within ? then.with_files_within(*file.assets_within) : then;
}

}  // namespace phasetree::tracer
