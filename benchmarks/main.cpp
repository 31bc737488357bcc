// phasetree-bench: measures the project's claims about speed. See README.md in this folder.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <optional>
#include <thread>

#include "command/subcommand.hpp"
#include "commands/commands.hpp"
#include "output/file.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/version.hpp"

namespace phasetree::bench {

namespace {

struct Command {
    std::string name, what;
    Report (*run)(const Settings&);
};

const std::vector<Command>& commands() {
    static const std::vector<Command> all{
        {"table1", "seven objects with phases and without (Table 1)", table1},
        {"scaling", "the tentacle with 30 to 30,000 bumps", scaling},
        {"quality", "objects built with low and with medium quality", quality},
        {"mesh", "fields compared with the triangles that would replace them", mesh},
        {"triangles", "closed meshes as fields, compared with the same triangles", triangles},
        {"volumes", "voxel grids as fields, compared with triangles of the same surface", volumes},
        {"naive", "interface cells compared with the paper's method", naive},
        {"phases", "the same geometry with 1 to 32 phases (Figure 20)", phases},
        {"simd", "instruction sets and threads", simd},
        {"host", "costs of a host: decoding hits, reading cells, points", host},
        {"light", "noise per second of pictures, for each technique alone and compared with another build", light},
        {"carve", "carved bounds compared with boxes (Figure 23)", carve},
        {"march", "steps along one ray from phase to phase (Figure 21)", march},
        {"proxies", "what proxies save, when walking the tree and through cells", proxies},
    };
    return all;
}

// These take minutes and gigabytes, so "all" does not include them.
const Command resolutions{"resolution", "a field compared with its triangles at 64³ to 1024³", resolution};
const Command copies{"instances", "one to a million instances of an object, as a field and as triangles", instances};
const Command crowds{"lamps", "choosing one of many lamps: by a tree, and by evaluating each", lamps};
const Command lists{"balls", "lists of ten thousand to ten million balls", balls};

// Not a measurement, so "all" does not include it: hashes that must stay the same if a change should not affect
// results.
const Command fingerprints{
    "fingerprint", "hashes of all results for every scene, to the last bit, for comparing two builds", fingerprint};

nlohmann::ordered_json machine() {
    std::string processor;
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; processor.empty() && std::getline(info, line);)
        if (line.starts_with("model name")) processor = line.substr(line.find(':') + 2);
    double load = 0;
    std::ifstream("/proc/loadavg") >> load;
    return {{"processor", processor},
            {"cores", std::thread::hardware_concurrency()},
            {"load", load},
            {"simd", simd_target()},
            {"version", std::string(build_id())}};
}

// "640x480"
void set_size(Settings& settings, const std::string& text) {
    int width = 0, height = 0;
    char x = 0, rest = 0;
    if (std::sscanf(text.c_str(), "%d%c%d%c", &width, &x, &height, &rest) != 3 || x != 'x' || width < 1 || height < 1 ||
        width > 16384 || height > 16384)
        throw CLI::ValidationError("--size", "must be WIDTHxHEIGHT, from 1x1 to 16384x16384, but is \"" + text + "\"");
    settings.width = width;
    settings.height = height;
}

int run(const std::vector<Command>& chosen, const Settings& settings, const std::optional<std::string>& file) {
    if (file) tracer::check_file_writable(*file);  // before an hour of measuring, not after it
    nlohmann::ordered_json json;
    json["machine"] = machine();
    json["settings"] = {{"quick", settings.quick}, {"threads", settings.threads},
                        {"width", settings.width}, {"height", settings.height},
                        {"seed", settings.seed},   {"rounds", settings.timing().rounds}};
    fmt::print("{}, {} cores, load {:.1f}, {}\n", json["machine"]["processor"].get<std::string>(),
               json["machine"]["cores"].get<int>(), json["machine"]["load"].get<double>(), simd_target());
    fmt::print("times: {}, median of {} alternating rounds\n",
               settings.threads == 1 ? "processor time of one thread" : "wall clock", settings.timing().rounds);
    bool sound = true;
    for (const Command& command : chosen) {
        const double start = seconds(Clock::wall);
        const Report report = command.run(settings);
        json[report.name()] = report.json();
        json[report.name()]["seconds"] = seconds(Clock::wall) - start;
        sound = sound && report.sound();
    }
    if (file) tracer::write_file(json.dump(2) + "\n", *file);
    if (!sound) fmt::print(stderr, "phasetree-bench: a check failed, see above\n");
    return sound ? 0 : 1;
}

}  // namespace

}  // namespace phasetree::bench

int main(int argc, char** argv) {
    using namespace phasetree;
    using namespace phasetree::bench;
    CLI::App app("Measures phasetree's claims about speed.", "phasetree-bench");
    Settings settings;
    std::optional<std::string> size, file;
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    app.add_flag("--quick", settings.quick, "Fewer rays and rounds: everything within a minute");
    app.add_option("--threads", settings.threads,
                   "Number of threads that trace; with more than one, times are wall-clock times")
        ->check(CLI::Range(1, 1024));
    app.add_option("--size", size, "Size of the images of one ray per pixel, WIDTHxHEIGHT");
    app.add_option("--seed", settings.seed, "Seed of the random rays");
    app.add_option("--scenes", settings.scenes, "For light and fingerprint: scenes of the gallery, separated by commas")
        ->delimiter(',');
    app.add_option("--samples", settings.samples, "For light: samples per pixel")->check(CLI::Range(1, 65536));
    app.add_option("--against", settings.against, "For light: the phasetree command of another build")
        ->check(CLI::ExistingFile);
    app.add_option("--json", file, "Also write the numbers to this file");
    app.require_subcommand(1);
    app.fallthrough();
    std::vector<Command> chosen;
    for (const Command& command : commands())
        app.add_subcommand(command.name, command.what)->callback([&] { chosen.push_back(command); });
    app.add_subcommand(fingerprints.name, fingerprints.what)->callback([&] { chosen.push_back(fingerprints); });
    app.add_subcommand(lists.name, lists.what)->callback([&] { chosen.push_back(lists); });
    app.add_subcommand(crowds.name, crowds.what)->callback([&] { chosen.push_back(crowds); });
    app.add_subcommand(copies.name, copies.what)->callback([&] { chosen.push_back(copies); });
    app.add_subcommand(resolutions.name, resolutions.what)->callback([&] { chosen.push_back(resolutions); });
    app.add_subcommand("all", "all of these except instances, balls, lamps, resolution and fingerprint")->callback([&] {
        chosen = commands();
    });
    try {
        app.parse(argc, argv);
        if (settings.quick) settings.width = settings.height = 128;
        if (size) set_size(settings, *size);
    } catch (const CLI::ParseError& e) {
        return tracer::report_parse_error(app, e);
    }
    if (static_cast<unsigned>(settings.threads) > cores)
        fmt::print("warning: {} threads share {} cores, so they will wait for each other\n", settings.threads, cores);
    try {
        return run(chosen, settings, file);
    } catch (const std::exception& e) {
        fmt::print(stderr, "phasetree-bench: {}\n", e.what());
        return 1;
    }
}
