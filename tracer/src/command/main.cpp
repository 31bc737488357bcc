#include <fmt/format.h>

#include <cstdio>
#include <new>

#include "command/commands.hpp"
#include "command/numbers.hpp"
#include "command/subcommand.hpp"
#include "output/error.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/reading/error.hpp"
#include "phasetree/version.hpp"

int main(int argc, char** argv) {
    using namespace phasetree;
    CLI::App app("Multiphase signed distance fields, path traced.", "phasetree");
    app.set_version_flag("--version", fmt::format("phasetree {}", version()));
    app.require_subcommand(1);
    tracer::Run run;
    tracer::add_commands(app, run);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return tracer::exit_code(app, e);
    }
    try {
        return run();
    } catch (const SceneError& e) {
        fmt::print(stderr, "{}\n", e.what());
    } catch (const tracer::InputError& e) {
        fmt::print(stderr, "{}\n", e.what());
    } catch (const ModelError& e) {
        fmt::print(stderr, "phasetree: {}\n", e.what());
    } catch (const tracer::OutputError& e) {
        fmt::print(stderr, "phasetree: {}\n", e.what());
    } catch (const tracer::DisplayError& e) {
        fmt::print(stderr, "phasetree: {}\n", e.what());
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "phasetree: out of memory\n");
        return 1;
    } catch (const std::exception& e) {
        fmt::print(stderr, "phasetree: {}\n", e.what());
        return 1;
    }
    return 2;
}
