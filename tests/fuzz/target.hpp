// The ways in which input enters the program, each with a function that processes an input.
//
// A new target needs a file in targets/, named after the target, and a line in list.cpp. Its inputs are found by
// libFuzzer (tests/run.sh --fuzz); the smallest set of them that covers the same code lies in corpus/NAME.tar.gz and is
// replayed, with mutations, by the ordinary tests.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace phasetree::fuzz {

using Bytes = std::span<const std::uint8_t>;

inline std::string_view text_of(Bytes bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// What an input is made of, and so how one becomes another.
enum class Inputs { json, lines, bytes };

struct Target {
    std::string_view name;
    Inputs inputs;
    std::size_t longest;     // bytes of an input
    std::size_t replayed;    // mutations that the ordinary tests make: some seconds of them
    std::string_view seeds;  // a folder of the repository whose files are inputs, too; may be empty
    // Does with the input what a user could, with budgets that keep it to milliseconds, and returns, whatever the input
    // is. It catches the errors that are documented; anything else that is thrown is a finding, as a crash is.
    void (*run)(Bytes);
};

std::span<const Target> targets();
// std::invalid_argument for a name that is not among them.
const Target& target(std::string_view name);

// Reports a finding that is not a crash: ends the process with the guarantee that was violated.
[[noreturn]] void broken(const char* promise);
inline void promised(bool holds, const char* promise) {
    if (!holds) broken(promise);
}

void run_balls(Bytes);
void run_calls(Bytes);
void run_color_config(Bytes);
void run_font(Bytes);
void run_gltf(Bytes);
void run_image(Bytes);
void run_lines(Bytes);
void run_mesh(Bytes);
void run_obj(Bytes);
void run_part(Bytes);
void run_scene(Bytes);
void run_settings(Bytes);
void run_volume(Bytes);
void run_weights(Bytes);

}  // namespace phasetree::fuzz
