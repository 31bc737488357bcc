// What can be said of a render on the command line.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command/scene_file.hpp"
#include "phasetree/cells/cells.hpp"
#include "render/render.hpp"

namespace phasetree::tracer {

struct RenderOptions {
    std::shared_ptr<SceneFile> scene;
    std::vector<std::string> outputs;
    std::optional<int> samples_in_all;
    double time_seconds = 0;  // from the start of the command; 0 if it may take what it takes
    std::optional<float> noise;
    std::optional<std::string> share;  // of the samples, by their numbers
    std::optional<std::string> size;
    std::optional<std::string> crop;
    int threads = 0;
    BuildQuality quality = BuildQuality::medium;
    std::size_t most_bytes = 0;
    std::optional<std::uint32_t> seed;
    std::optional<float> exposure, detail;
    std::optional<std::string> display, view, stats, cells, planes;
    std::optional<std::string> checkpoint, resume;
    double checkpoint_seconds = 300;
    std::optional<std::string> frames;   // of a film, by their numbers
    std::optional<int> frame;            // the one of them that these options are for
    bool skips_existing = false;         // frames whose files are there
    bool may_start = false;              // where there is nothing to resume
    std::optional<std::string> denoise;  // how (denoising.hpp)
    bool quiet = false;
};

// Adds all options, whose values go there.
void add_render_options(CLI::App& command, RenderOptions& options);
void add_outputs(CLI::App& command, std::vector<std::string>& outputs, const std::string& by_default);
// Of how pictures are shown.
void add_display_options(CLI::App& command, std::optional<float>& exposure, std::optional<std::string>& display,
                         std::optional<std::string>& view);

// Sets what the options say of the scene.
void apply(const RenderOptions& options, Scene& scene);
// The pixels and the samples that are to be rendered. Throw OutputError.
PixelRange pixels_of(const RenderOptions& options, const Scene& scene);
SampleRange samples_of(const RenderOptions& options, const Scene& scene);

// A number of integers, as in "800x600"; `form` says what is expected.
std::vector<int> integers(const std::string& text, char separator, std::size_t count, const char* option,
                          const char* form);

}  // namespace phasetree::tracer
