// Writes the manual page of the phasetree command, its commands and options from their definitions and the rest from a
// template. In it, the lines .\" the commands and .\" the exit codes stand for these:
//
//   phasetree-manual TEMPLATE.1.in PAGE.1
#include "command/commands.hpp"
#include "command/exit_codes.hpp"

#include <CLI/CLI.hpp>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "roff.hpp"

namespace {

using phasetree::manual::roff;
using phasetree::manual::roff_code;

constexpr std::string_view commands_mark = R"(.\" the commands)", exit_codes_mark = R"(.\" the exit codes)";

std::string bold(const std::string& text) {
    return "\\fB" + roff_code(text) + "\\fR";
}
std::string italic(const std::string& text) {
    return "\\fI" + roff_code(text) + "\\fR";
}

std::string positional_name(const CLI::Option& option) {
    std::string name = option.get_name(true);
    for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return name;
}

std::vector<std::string> names_of(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames()) names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
    return names;
}

// What an option's value is called, and what is said of it behind a colon: "INT:INT in [1 - 1024]".
struct Value {
    std::string name;
    std::string limits;
};

Value value_of(const CLI::Option& option) {
    if (option.get_type_size() == 0) return {};
    if (!option.get_option_text().empty()) return {option.get_option_text(), {}};
    static const std::regex range(R"(.* in \[(.*) - (.*)\])");
    const std::string type = option.get_type_name();
    const std::size_t colon = type.find(':');
    if (colon == std::string::npos) return {type, {}};
    const std::string limits = type.substr(colon + 1);
    return {type.substr(0, colon), std::regex_replace(limits, range, "$1 to $2")};
}

std::string sentence(const std::string& text) {
    return text.empty() || text.back() == '.' ? text : text + ".";
}

void write_option(std::ostream& out, const CLI::Option& option) {
    const Value value = value_of(option);
    out << ".TP\n";
    std::string head;
    for (const std::string& name : names_of(option)) head += (head.empty() ? "" : ", ") + bold(name);
    if (option.get_positional()) head = italic(positional_name(option));
    if (!option.get_positional() && !value.name.empty()) head += " " + italic(value.name);
    out << head << "\n" << roff(sentence(option.get_description()));
    if (!value.limits.empty()) out << " " << roff(sentence("From " + value.limits));
    if (option.get_items_expected_max() > 1) out << " May be repeated.";
    for (const CLI::Option* needed : option.get_needs()) out << " Only with " << bold(needed->get_name()) << ".";
    for (const CLI::Option* excluded : option.get_excludes()) out << " Not with " << bold(excluded->get_name()) << ".";
    out << "\n";
}

std::vector<const CLI::Option*> options_of(const CLI::App& command, bool positional) {
    return command.get_options([&](const CLI::Option* option) {
        return option->get_positional() == positional && !option->get_group().empty() &&
               option != command.get_help_ptr();
    });
}

void write_command(std::ostream& out, const CLI::App& command) {
    const auto options = options_of(command, false);
    out << ".SS \"phasetree " << roff_code(command.get_name());
    if (!options.empty()) out << " [OPTION]...";
    for (const CLI::Option* positional : options_of(command, true)) {
        const std::string name = positional_name(*positional);
        out << (positional->get_required() ? " " + name : " [" + name + "]");
    }
    std::string description = command.get_description();
    for (std::size_t at = 0; (at = description.find('\n', at)) != std::string::npos;) description.replace(at, 1, " ");
    out << "\"\n" << roff(sentence(description)) << "\n";
    for (const CLI::Option* positional : options_of(command, true)) write_option(out, *positional);
    for (const CLI::Option* option : options) write_option(out, *option);
}

void write_exit_codes(std::ostream& out) {
    for (const phasetree::tracer::ExitCode& e : phasetree::tracer::exit_codes)
        out << ".TP\n" << bold(std::to_string(e.code)) << "\n" << roff(sentence(std::string(e.meaning))) << "\n";
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: %s TEMPLATE.1.in PAGE.1\n", argv[0]);
        return 2;
    }
    CLI::App app("", "phasetree");
    phasetree::tracer::Run run;
    phasetree::tracer::add_commands(app, run);
    std::ifstream in(argv[1]);
    std::ofstream out(argv[2]);
    bool has_commands = false, has_exit_codes = false;
    for (std::string line; std::getline(in, line);) {
        if (line == exit_codes_mark) {
            has_exit_codes = true;
            write_exit_codes(out);
            continue;
        }
        if (line != commands_mark) {
            out << line << "\n";
            continue;
        }
        has_commands = true;
        for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
            write_command(out, *command);
    }
    out.close();
    if (!in.eof() || !has_commands || !has_exit_codes || !out) {
        std::fprintf(stderr, "%s cannot be written from %s\n", argv[2], argv[1]);
        return 1;
    }
    return 0;
}
