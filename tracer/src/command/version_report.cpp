#include "command/version_report.hpp"

#include <fmt/format.h>
#include <tbb/version.h>

#include "denoise/open_image_denoise.hpp"
#include "embree_core/embree.hpp"
#include "gltf/draco.hpp"
#include "gltf/meshopt.hpp"
#include "output/display.hpp"
#include "output/encode.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/version.hpp"
#include "text/read_text.hpp"
#include "view/server.hpp"
#include "volume/read_volume.hpp"

namespace phasetree::tracer {

namespace {

std::string_view processor() {
#if defined(__x86_64__)
    return "x86-64";
#elif defined(__aarch64__)
    return "arm64";
#else
    return "other";
#endif
}

}  // namespace

std::string version_report() {
    const std::string commit = source_commit();
    std::string report = fmt::format("phasetree {}", build_id());
    const auto line = [&](std::string_view name, std::string_view value, std::string_view otherwise = "no") {
        report += fmt::format("\n{}: {}", name, value.empty() ? otherwise : value);
    };
    line("commit", commit, "unknown");
    line("compiler", compiler());
    line("processor", processor());
    line("simd", simd_target());
    line("embree", RTC_VERSION_STRING);
    line("tbb", TBB_runtime_version());
    line("openimageio", openimageio_version());
    line("opencolorio", opencolorio_version());
    line("openvdb", openvdb_version());
    line("harfbuzz", harfbuzz_version());
    line("draco", gltf::has_draco() ? "yes" : "");
    line("meshoptimizer", gltf::has_meshopt() ? "yes" : "");
    line("open-image-denoise", open_image_denoise_version());
    line("live-view", view::server_library());
    return report;
}

}  // namespace phasetree::tracer
