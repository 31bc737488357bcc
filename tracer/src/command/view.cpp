#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "command/commands.hpp"
#include "command/errors.hpp"
#include "command/max_memory.hpp"
#include "command/streams.hpp"
#include "command/viewed_file.hpp"
#include "output/interrupt.hpp"
#include "render/threads.hpp"
#include "view/server.hpp"

namespace phasetree::tracer {

namespace {

struct ViewOptions {
    std::shared_ptr<SceneFile> scene;
    std::optional<int> samples, width;
    std::optional<std::string> display, view;

    ViewedFile file() const { return {*scene, display, view}; }
    int threads = 0, port = 0;
    std::size_t max_bytes = 0;
    bool opens = false, saves = true;
};

// Starts the desktop's browser without waiting for it. If there is none, the printed address is enough.
void open_browser(const std::string& url) {
    std::string program = "xdg-open", address = url;
    char* const arguments[] = {program.data(), address.data(), nullptr};
    posix_spawn_file_actions_t quiet;
    posix_spawn_file_actions_init(&quiet);
    posix_spawn_file_actions_addopen(&quiet, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&quiet, 2, "/dev/null", O_WRONLY, 0);
    pid_t browser = 0;
    if (::posix_spawnp(&browser, program.c_str(), &quiet, nullptr, arguments, environ) != 0)
        say("phasetree: warning: cannot start xdg-open; open the address yourself\n");
    posix_spawn_file_actions_destroy(&quiet);
}

int view_scene(const ViewOptions& options) {
    view::require_server();
    if (options.scene->is_standard_input())
        throw UsageError("view: the scene must be a file, because it is read again whenever it is saved");
    const AvailableThreads threads(options.threads);
    const ViewedFile file = options.file();
    const std::unique_ptr<studio::EditedDocument> document = file.document(options.saves);
    const view::SessionOptions session_options{
        .name = options.scene->shown(),
        .threads = threads.count(),
        .max_bytes = options.max_bytes,
        .samples = options.samples,
        .width = options.width,
        .write_camera = [&](const std::string& camera) { write_camera(*document, camera); },
        .write_numbers = [&](const view::NumberEdits& numbers) { write_numbers(*document, numbers); },
        .tell = [](std::string_view text) { say(text); }};
    // Report an initially invalid scene as every other subcommand does.
    const view::ReadScene read = file.reader(*document);
    const InterruptGuard guard;
    view::Session session(read, session_options);
    document->on_change([&] { session.text_changed(); });
    view::serve(session, {.document = document.get(),
                          .port = options.port,
                          .is_over = [] { return interrupted(); },
                          .serving =
                              [&](const std::string& url) {
                                  put("{}\n", url);
                                  finish_output();
                                  say("phasetree: serving {} until Ctrl-C\n", options.scene->shown());
                                  if (options.opens) open_browser(url);
                              }});
    return 0;
}

}  // namespace

void add_view(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("view", "Show a scene in the browser and edit it live");
    command->footer(
        "Prints the address of a page on this machine and serves it until Ctrl-C. The address is\n"
        "different each time, and anyone on this machine who knows it can use the page. The picture\n"
        "keeps improving, and the scene is read again when one of its files is saved.");
    auto o = std::make_shared<ViewOptions>();
    o->scene = add_scene_file(*command);
    command->add_flag("--open", o->opens, "Open the page in the desktop's browser with xdg-open");
    command->add_flag("!--no-save", o->saves,
                      "Save the scene only when the page asks for it, not after each change made in the page");
    command->add_option("--port", o->port, "Port on 127.0.0.1 (default: any free one)")->check(CLI::Range(1, 65535));
    command->add_option("--spp", o->samples, "Final number of samples per pixel (default: that of the scene)")
        ->check(CLI::Range(1, 1 << 24));
    command
        ->add_option("--width", o->width,
                     "Width of the picture in pixels; the height keeps the proportions (default: that of the scene)")
        ->check(CLI::Range(1, 8192));
    command->add_option("--threads", o->threads, "Number of threads (default: one per core)")
        ->check(CLI::Range(1, 1024));
    add_max_memory(*command, o->max_bytes);
    command->add_option("--display", o->display, "OpenColorIO display (default: that of the configuration)");
    command->add_option("--view", o->view, "OpenColorIO view (default: that of the scene or the configuration)");
    command->callback([o, &run] { run = [o] { return view_scene(*o); }; });
}

}  // namespace phasetree::tracer
