#include "command/run_command.hpp"

#include <fmt/format.h>

#include <new>

#include "command/commands.hpp"
#include "command/errors.hpp"
#include "command/exit_codes.hpp"
#include "command/numbers.hpp"
#include "command/streams.hpp"
#include "command/subcommand.hpp"
#include "command/version_report.hpp"
#include "film_file/error.hpp"
#include "output/error.hpp"
#include "output/preparation_progress.hpp"
#include "phasetree/cells/file.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree/model/handle.hpp"
#include "view/server.hpp"

namespace phasetree::tracer {

namespace {

int run_subcommand(int argc, char** argv) {
    CLI::App app("Path-trace scenes of multiphase signed distance fields.", "phasetree");
    app.set_version_flag("--version", version_report, "Print the build and the versions of its libraries");
    app.require_subcommand(1);
    std::string footer = "Exit codes:";
    for (const ExitCode& e : exit_codes) footer += fmt::format("\n  {:<5}{}", e.code, e.meaning);
    app.footer(footer);
    Run run;
    add_commands(app, run);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return report_parse_error(app, e);
    }
    try {
        const PreparationProgress progress(ProgressOutput::standard_error(false));
        return run();
    } catch (const StandardOutputError&) {
        throw;
    } catch (const SceneError& e) {
        say("{}\n", e.what());
    } catch (const InputError& e) {
        say("{}\n", e.what());
    } catch (const ModelError& e) {
        say("phasetree: {}\n", e.what());
    } catch (const UsageError& e) {
        say("phasetree: {}\n", e.what());
    } catch (const view::MissingLibraryError& e) {
        say("phasetree: {}\n", e.what());
    } catch (const OutputNameError& e) {
        say("phasetree: {}\n", e.what());
    } catch (const FilmFileError& e) {
        say("phasetree: {}\n", e.what());
    } catch (const DisplayError& e) {
        say("phasetree: {}\n", e.what());
    } catch (const std::bad_alloc&) {
        say("phasetree: out of memory\n");
        return exit_code::failure;
    } catch (const std::exception& e) {  // OutputError among others
        say("phasetree: {}\n", e.what());
        return exit_code::failure;
    }
    return exit_code::usage;
}

}  // namespace

int run_command(int argc, char** argv) {
    guard_standard_streams();
    try {
        const int code = run_subcommand(argc, argv);
        finish_output();
        return code;
    } catch (const StandardOutputError& e) {
        if (!e.is_broken_pipe()) say("phasetree: {}\n", e.what());
        return exit_code::failure;
    } catch (const std::bad_alloc&) {  // while the command line was parsed
        say("phasetree: out of memory\n");
        return exit_code::failure;
    }
}

}  // namespace phasetree::tracer
