// The command-line options of a render.
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
    double time_seconds = 0;  // time limit, from the start of the command; 0 for none
    std::optional<float> noise;
    std::optional<std::string> share;  // the range of samples to render
    std::optional<std::string> size;
    std::optional<std::string> crop;
    int threads = 0;
    BuildQuality quality = BuildQuality::medium;
    std::size_t max_bytes = 0;
    std::optional<std::uint32_t> seed;
    std::optional<float> exposure, detail;
    std::optional<std::string> display, view, stats, cells, planes;
    std::optional<std::string> checkpoint, resume;
    double checkpoint_seconds = 300;
    std::optional<std::string> frames;   // the range of frames to render
    std::optional<int> frame;            // the current frame
    bool skips_existing = false;         // skip frames whose files exist
    bool may_start = false;              // start if there is nothing to resume
    std::optional<std::string> denoise;  // see denoising.hpp
    bool quiet = false;
};

// Adds all options, which store their values in `options`.
void add_render_options(CLI::App& command, RenderOptions& options);
void add_outputs(CLI::App& command, std::vector<std::string>& outputs, const std::string& by_default);
// Adds the options for displaying pictures.
void add_display_options(CLI::App& command, std::optional<float>& exposure, std::optional<std::string>& display,
                         std::optional<std::string>& view);

// Applies the options to the scene.
void apply(const RenderOptions& options, Scene& scene);
// The pixels and the samples to render. Throw UsageError.
PixelRange pixels_of(const RenderOptions& options, const Scene& scene);
SampleRange samples_of(const RenderOptions& options, const Scene& scene);

// Parses a number of integers, as in "800x600"; `form` describes the expected format.
std::vector<int> integers(const std::string& text, char separator, std::size_t count, const char* option,
                          const char* form);

}  // namespace phasetree::tracer
