#pragma once

#include <CLI/CLI.hpp>
#include <map>

#include "phasetree/cells/cells.hpp"

namespace phasetree::tracer {

inline CLI::Option* add_build_quality(CLI::App& command, BuildQuality& quality) {
    const std::map<std::string, BuildQuality> names{{"low", BuildQuality::low}, {"medium", BuildQuality::medium}};
    return command
        .add_option("--build-quality", quality,
                    "low, for a quick look, or medium (default): how much is built before rays are traced")
        ->transform(CLI::CheckedTransformer(names).description(""))
        ->option_text("NAME");
}

}  // namespace phasetree::tracer
