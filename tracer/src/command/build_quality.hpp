#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "phasetree/cells/cells.hpp"

namespace phasetree::tracer {

inline CLI::Option* add_build_quality(CLI::App& command, BuildQuality& quality) {
    const auto choose = [&quality](const std::string& name) {
        if (name != "low" && name != "medium")
            throw CLI::ValidationError("--build-quality", "must be low or medium, but is \"" + name + "\"");
        quality = name == "low" ? BuildQuality::low : BuildQuality::medium;
    };
    return command
        .add_option_function<std::string>(
            "--build-quality", choose,
            "low prepares the object faster, for previews; medium, the default, traces rays faster")
        ->option_text("NAME");
}

}  // namespace phasetree::tracer
