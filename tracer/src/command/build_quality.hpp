#pragma once

#include <CLI/CLI.hpp>
#include <map>

#include "phasetree/cells/cells.hpp"

namespace phasetree::tracer {

inline CLI::Option* add_build_quality(CLI::App& command, BuildQuality& quality) {
    const std::map<std::string, BuildQuality> names{
        {"low", BuildQuality::low}, {"medium", BuildQuality::medium}, {"high", BuildQuality::high}};
    return command
        .add_option("--build-quality", quality,
                    "low, medium (default) or high: how much is built before rays are traced; more makes them faster")
        ->transform(CLI::CheckedTransformer(names).description(""))
        ->option_text("NAME");
}

}  // namespace phasetree::tracer
