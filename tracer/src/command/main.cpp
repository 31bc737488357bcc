#include <fmt/format.h>

#include <new>

#include "command/commands.hpp"
#include "command/numbers.hpp"
#include "command/option_error.hpp"
#include "command/streams.hpp"
#include "command/subcommand.hpp"
#include "command/version_report.hpp"
#include "film_file/error.hpp"
#include "output/error.hpp"
#include "phasetree/cells/file.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree/model/handle.hpp"
#include "view/server.hpp"

namespace {

using namespace phasetree;
using tracer::say;

int run_command(int argc, char** argv) {
    CLI::App app("Multiphase signed distance fields, path traced.", "phasetree");
    app.set_version_flag("--version", tracer::version_report, "Print the build, and which libraries it was built with");
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0 for success; 1 if the run was interrupted or something could not be written;\n"
        "2 for a scene, input or arguments that are wrong; 3 of check for a scene that is only a tree;\n"
        "75 of a render that SIGTERM or SIGHUP ended and that --resume goes on with; 130 if Ctrl-C ended it.");
    tracer::Run run;
    tracer::add_commands(app, run);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return tracer::exit_code(app, e);
    }
    try {
        return run();
    } catch (const tracer::StandardOutputError&) {
        throw;
    } catch (const SceneError& e) {
        say("{}\n", e.what());
    } catch (const tracer::InputError& e) {
        say("{}\n", e.what());
    } catch (const ModelError& e) {
        say("phasetree: {}\n", e.what());
    } catch (const tracer::OptionError& e) {
        say("phasetree: {}\n", e.what());
    } catch (const tracer::view::MissingLibraryError& e) {
        say("phasetree: {}\n", e.what());
    } catch (const CellsFileError& e) {
        say("phasetree: {}\n", e.what());
    } catch (const tracer::OutputError& e) {
        say("phasetree: {}\n", e.what());
    } catch (const tracer::FilmFileError& e) {
        say("phasetree: {}\n", e.what());
    } catch (const tracer::DisplayError& e) {
        say("phasetree: {}\n", e.what());
    } catch (const std::bad_alloc&) {
        say("phasetree: out of memory\n");
        return 1;
    } catch (const std::exception& e) {
        say("phasetree: {}\n", e.what());
        return 1;
    }
    return 2;
}

}  // namespace

int main(int argc, char** argv) {
    tracer::guard_standard_streams();
    try {
        const int code = run_command(argc, argv);
        tracer::finish_output();
        return code;
    } catch (const tracer::StandardOutputError& e) {
        if (!e.is_broken_pipe()) say("phasetree: {}\n", e.what());
        return 1;
    } catch (const std::bad_alloc&) {  // while the command line was parsed
        say("phasetree: out of memory\n");
        return 1;
    }
}
