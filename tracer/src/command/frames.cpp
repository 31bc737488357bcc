#include "command/frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "command/errors.hpp"
#include "command/streams.hpp"
#include "output/layers.hpp"
#include "phasetree/io/read_kind.hpp"
#include "scene/image_parameters.hpp"

namespace phasetree::tracer {

namespace {

// Exclusive upper bound on frame numbers: seven digits.
constexpr int most_frames = 10'000'000;

struct FrameRange {
    int first, last;
};

FrameRange range_of_frames(const std::string& text) {
    const std::vector<int> ends = integers(text, ':', 2, "--frames", "FIRST:LAST, where LAST is excluded");
    const FrameRange range{ends[0], ends[1]};
    if (range.first < 0 || range.first >= range.last || range.last > most_frames)
        throw UsageError(
            fmt::format("--frames {}: the range must not be empty and must lie within 0:{}", text, most_frames));
    return range;
}

// The options for one frame: the name of each output contains its number.
RenderOptions options_of_frame(const RenderOptions& options, int frame, bool is_alone) {
    RenderOptions one = options;
    one.frames.reset();
    one.frame = frame;
    const auto put_number = [&](std::string& name, const char* option) {
        if (const auto numbered = name_of_frame(name, frame))
            name = *numbered;
        else if (!is_alone)
            throw UsageError(fmt::format(
                "{} {}: each frame needs its own file; put #### in the name for the frame number", option, name));
    };
    for (std::string& output : one.outputs) put_number(output, "--output");
    if (one.stats) put_number(*one.stats, "--stats");
    if (one.checkpoint) put_number(*one.checkpoint, "--checkpoint");
    if (one.resume) put_number(*one.resume, "--resume");
    return one;
}

// With one file per plane, the file of the picture is written last.
bool are_all_there(const RenderOptions& options) {
    return std::ranges::all_of(options.outputs, [](const std::string& output) {
        std::error_code problem;
        return std::filesystem::is_regular_file(file_of_plane(output, layer_of_picture), problem);
    });
}

}  // namespace

double seconds_of_frame(const Document& document, int frame) {
    double rate = ImageParameters().frames_per_second;
    if (const auto render = document.root().find("render"))
        rate = read_kind<ImageParameters>(document, *render, "\"render\"",
                                          [](const ImageParameters& image) { return image.frames_per_second; });
    return frame / rate;
}

std::optional<std::string> name_of_frame(const std::string& name, int frame) {
    const std::size_t last = name.rfind('#');
    if (last == std::string::npos) return std::nullopt;
    std::size_t first = last;
    while (first > 0 && name[first - 1] == '#') --first;
    return fmt::format("{}{:0{}}{}", name.substr(0, first), frame, last - first + 1, name.substr(last + 1));
}

int render_frames(const RenderOptions& options, const std::function<int(const RenderOptions&)>& render) {
    const FrameRange range = range_of_frames(*options.frames);
    const int count = range.last - range.first;
    if (options.scene->at) throw UsageError("--frames and --at cannot be combined: each frame has its own time");
    if (options.outputs.empty())
        throw UsageError("--frames needs -o with #### for the frame number, as in -o name.####.exr");
    if (count > 1 && options.scene->is_standard_input())
        throw UsageError("--frames: the scene of several frames must be a file, not standard input");
    (void)options_of_frame(options, range.first, count == 1);
    int skipped = 0;
    for (int frame = range.first; frame < range.last; ++frame) {
        const RenderOptions one = options_of_frame(options, frame, count == 1);
        if (options.skips_existing && are_all_there(one)) {
            ++skipped;
            continue;
        }
        if (!options.quiet && count > 1) say("frame {} ({} of {})\n", frame, frame - range.first + 1, count);
        try {
            if (const int code = render(one); code != 0) {
                say("phasetree: stopped at frame {}\n", frame);
                return code;
            }
        } catch (...) {
            say("frame {}: ", frame);
            throw;
        }
    }
    if (skipped > 0 && !options.quiet) say("skipped {} of {} frames, whose files exist\n", skipped, count);
    return 0;
}

}  // namespace phasetree::tracer
