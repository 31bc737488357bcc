#include "phasetree/measuring/slice.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <system_error>

#include "command/commands.hpp"
#include "command/errors.hpp"
#include "command/exit_codes.hpp"
#include "command/frames.hpp"
#include "command/load.hpp"
#include "command/looks.hpp"
#include "command/number_in.hpp"
#include "command/overwritten_files.hpp"
#include "command/quantity.hpp"
#include "command/slice_picture.hpp"
#include "command/streams.hpp"
#include "output/error.hpp"
#include "output/file.hpp"
#include "output/interrupt.hpp"
#include "output/late_progress.hpp"
#include "phasetree/measuring/measure.hpp"
#include "phasetree/trace/tracer.hpp"
#include "render/threads.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};
constexpr int most_slices = 100'000;
constexpr int default_size = 1000;  // in pixels

struct SliceCommand {
    std::array<std::optional<double>, 3> at;  // of planes perpendicular to x, y and z
    std::string axis = "z";
    std::optional<int> count;
    std::optional<double> from, to;
    std::optional<std::string> object;
    std::string output = "slice.svg";
    std::optional<std::string> unit;
    double tolerance = 0;
    std::optional<int> size;  // of PNG

    bool is_svg() const { return std::filesystem::path(output).extension() == ".svg"; }
};

// Checks the options against each other.
void check_slice_options(const SliceCommand& chosen) {
    const auto given = std::ranges::count_if(chosen.at, [](const auto& at) { return at.has_value(); });
    if (chosen.count && given > 0) throw UsageError("slice: choose one of --x, --y, --z, or --count with --axis");
    if (!chosen.count && given != 1)
        throw UsageError(given == 0 ? "slice: give the plane, as in --z 0.3, or a stack, as in --count 100"
                                    : "slice: choose one of --x, --y and --z");
    if (!chosen.count && (chosen.from || chosen.to)) throw UsageError("slice: --from and --to need --count");
    if (chosen.from.has_value() != chosen.to.has_value())
        throw UsageError("slice: give both --from and --to, or neither");
    if (chosen.from && !(*chosen.from < *chosen.to)) throw UsageError("slice: --from must be less than --to");
    const std::string extension = std::filesystem::path(chosen.output).extension().string();
    if (extension != ".svg" && extension != ".png")
        throw OutputNameError(
            fmt::format("cannot write \"{}\": {}; use .svg or .png", chosen.output,
                        extension.empty() ? "its name has no extension" : "unknown format \"" + extension + "\""));
    if (chosen.is_svg() && chosen.size) throw UsageError("slice: --size is for .png; an .svg scales to any size");
    if (chosen.count.value_or(1) > 1 && !name_of_frame(chosen.output, 0))
        throw UsageError(fmt::format("--output {}: each slice needs its own file; put #### in the name for its number",
                                     chosen.output));
}

// The planes, in ascending order: those of a stack are in the middles of layers of equal thickness, or from the first
// to the last position.
std::vector<SlicePlane> planes_to_cut(const SliceCommand& chosen, const Bounds& bounds) {
    for (int axis = 0; axis < 3; ++axis)
        if (const auto& at = chosen.at[static_cast<std::size_t>(axis)]) return {{axis, static_cast<float>(*at)}};
    const auto axis = static_cast<int>(std::ranges::find(axis_names, chosen.axis) - axis_names.begin());
    const int count = chosen.count.value_or(1);
    std::vector<SlicePlane> planes;
    for (int i = 0; i < count; ++i) {
        const double low = chosen.from.value_or(static_cast<double>(bounds.low[axis]));
        const double high = chosen.to.value_or(static_cast<double>(bounds.high[axis]));
        const double share = !chosen.from ? (i + 0.5) / count : count == 1 ? 0.5 : static_cast<double>(i) / (count - 1);
        planes.push_back({axis, static_cast<float>(low + share * (high - low))});
    }
    return planes;
}

std::string text_of(const SlicePlane& plane) {
    return fmt::format("{} = {}", axis_names[static_cast<std::size_t>(plane.axis)], plane.at);
}

std::vector<std::array<int, 3>> distinct_colors(const PhaseNames& names) {
    std::vector<std::array<int, 3>> colors;
    for (const Look& look : looks_without_materials(names)) colors.push_back(shown_color(look));
    colors.front() = {255, 255, 255};
    return colors;
}

// The object's own box, where it is clearly smaller than that of the tree, as after a cut.
Bounds box_of(const Phased& object, Bounds box) {
    constexpr float clearly_smaller = 0.05f;  // as a share of the side
    MeasureOptions options;
    options.tolerance = 0.02;
    options.max_boxes = std::size_t{1} << 16;
    options.cancelled = [] { return interrupted(); };
    const MeasureResult measured = measure(object, options);
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const MeasuredPhase& phase : measured.phases) {
            low = std::min(low, phase.box_low[k].low);
            high = std::max(high, phase.box_high[k].high);
        }
        const float margin = clearly_smaller * box.extent()[axis];
        if (low > static_cast<double>(box.low[axis] + margin)) box.low[axis] = static_cast<float>(low);
        if (high < static_cast<double>(box.high[axis] - margin)) box.high[axis] = static_cast<float>(high);
    }
    return box;
}

// Draws slices, one after the other.
class SliceDrawing {
  public:
    SliceDrawing(const SceneFile& file, const SliceCommand& chosen)
        : file_(file),
          chosen_(chosen),
          document_(read_document(file)),
          model_(read_scene_model(document_)),
          tree_(tree_of_model(document_, model_, chosen.object)),
          program_(record_tree(document_, tree_.object)),
          traceable_(made_of_tree(document_, [&] { return prepare_to_trace(tree_.object); })),
          frame_{tree_.phases,
                 phases(tree_.object),
                 distinct_colors(tree_.phases),
                 length_unit(chosen.unit, model_),
                 {},
                 {},
                 {}} {
        print_warning(file.shown(), traceable_.warning);
    }

    int run() {
        const InterruptGuard guard;
        // Pixels stand for places in the box that `info` prints.
        bounds_ = chosen_.is_svg() ? box_of(tree_.object, traceable_.bounds) : traceable_.bounds;
        const std::vector<SlicePlane> planes = planes_to_cut(chosen_, bounds_);
        const std::vector<std::string> files = files_of(planes.size());
        check_no_input(files);
        check_tolerance();
        check_meets(planes);
        LateProgress progress(ProgressOutput::standard_error(false), "slicing the object");
        try {
            for (std::size_t i = 0; i < planes.size(); ++i) {
                if (interrupted()) throw SlicingCancelled();
                const auto tell = [&](double share) {
                    progress.tell((static_cast<double>(i) + share) / static_cast<double>(planes.size()));
                };
                write_file(picture(planes[i], tell), files[i]);
                ++written_;
                tell(1);
            }
        } catch (const SlicingCancelled&) {
            say("phasetree: interrupted; {} of {} files written\n", written_, planes.size());
            return code_of_interruption(false);
        }
        return exit_code::success;
    }

  private:
    std::vector<std::string> files_of(std::size_t count) const {
        std::vector<std::string> files;
        for (std::size_t i = 0; i < count; ++i) {
            files.push_back(name_of_frame(chosen_.output, static_cast<int>(i)).value_or(chosen_.output));
            if (i == 0) check_file_writable(files.front());
        }
        return files;
    }
    // The files of a stack have different names, so they need only be compared with the inputs. Inputs exist, so an
    // output that does not exist yet is not one of them.
    void check_no_input(const std::vector<std::string>& files) const {
        std::error_code unknown;
        for (const std::string& one : files)
            if (std::filesystem::exists(one, unknown))
                check_overwrites(file_, document_, named_files_of("--output", std::span(&one, 1)));
    }
    void check_meets(const std::vector<SlicePlane>& planes) const {
        const Bounds& b = bounds_;
        const auto meets = [&](const SlicePlane& p) { return p.at >= b.low[p.axis] && p.at <= b.high[p.axis]; };
        if (std::ranges::any_of(planes, meets)) return;
        const int axis = planes.front().axis;
        throw UsageError(fmt::format(
            "slice: {} {} the object, which extends from {:.6g} to {:.6g}", text_of(planes.front()),
            planes.size() == 1 ? "does not meet" : "and the other planes do not meet", b.low[axis], b.high[axis]));
    }
    void check_tolerance() const {
        const glm::vec3 extent = bounds_.extent();
        const float longest = std::max({extent.x, extent.y, extent.z});
        if (chosen_.is_svg() && !(chosen_.tolerance < static_cast<double>(longest)))
            throw UsageError(fmt::format("--tolerance: must be less than the object's longest side, {:.6g}, but is {}",
                                         longest, chosen_.tolerance));
    }
    std::string picture(const SlicePlane& plane, const std::function<void(double)>& tell) {
        const auto cancelled = [] { return interrupted(); };
        frame_.plane = text_of(plane);
        frame_.low = plane.coordinates(bounds_.low);
        frame_.high = plane.coordinates(bounds_.high);
        if (!chosen_.is_svg())
            return slice_png(program_, plane, frame_, chosen_.size.value_or(default_size), cancelled, tell);
        SliceOptions options;
        options.tolerance = chosen_.tolerance;
        options.cancelled = cancelled;
        const Slice found = made_of_tree(document_, [&] { return slice(tree_.object, plane, options); });
        if (found.first_unexplained)
            say("{}: note: {}: at {} {} no outline was found, but a detail smaller than the tolerance cannot be "
                "excluded; the first is at {:.6g}, {:.6g}\n",
                file_.shown(), frame_.plane, found.unexplained, found.unexplained == 1 ? "place" : "places",
                found.first_unexplained->x, found.first_unexplained->y);
        return slice_svg(found, frame_);
    }

    const SceneFile& file_;
    const SliceCommand& chosen_;
    Document document_;
    SceneModel model_;
    SceneTree tree_;
    Program program_;
    TraceableObject traceable_;
    Bounds bounds_;  // what the pictures show: the object's own box, or that of the tree
    SliceFrame frame_;
    std::size_t written_ = 0;
};

int slice_scene(const SceneFile& file, const SliceCommand& chosen) {
    const AvailableThreads threads;
    check_slice_options(chosen);
    return SliceDrawing(file, chosen).run();
}

void add_slice_options(CLI::App& command, SliceCommand& options) {
    constexpr double far = 1e15;
    for (std::size_t axis = 0; axis < 3; ++axis)
        command
            .add_option("--" + std::string(axis_names[axis]), options.at[axis],
                        fmt::format("Cut perpendicular to the {} axis, at this coordinate", axis_names[axis]))
            ->check(number_in(-far, far))
            ->option_text("COORDINATE");
    command.add_option("--count", options.count, "Cut a stack of N slices, each into a file of its own")
        ->check(CLI::Range(1, most_slices))
        ->option_text("N");
    command.add_option("--axis", options.axis, "The axis of the stack: x, y or z (default: z)")
        ->check(CLI::IsMember({"x", "y", "z"}))
        ->option_text("AXIS");
    command
        .add_option(
            "--from", options.from,
            "The position of the stack's first slice; needs --to (default: slices lie in the middles of N equal "
            "layers of the object)")
        ->check(number_in(-far, far))
        ->option_text("A");
    command.add_option("--to", options.to, "The position of the stack's last slice; needs --from")
        ->check(number_in(-far, far))
        ->option_text("B");
    command
        .add_option(
            "-o,--output", options.output,
            "Output file, .svg or .png; #### in the name stands for the number of the slice (default: slice.svg)")
        ->option_text("FILE");
    command
        .add_option(
            "--tolerance", options.tolerance,
            "SVG: maximum distance of outlines from the true interfaces (default: a thousandth of the longest side)")
        ->check(number_in(1e-15, far))
        ->option_text("LENGTH");
    command.add_option("--size", options.size, "PNG: pixels along the longer side (default: 1000)")
        ->check(CLI::Range(1, 16'384))
        ->option_text("N");
    add_length_unit(command, options.unit, "SVG: ");
}

}  // namespace

void add_slice(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("slice", "Draw the phases in a plane, as outlines or labels");
    command->footer(
        "The picture shows the two other axes: from above for --z, from the front for --y, from the\n"
        "right for --x.\n"
        "\n"
        ".svg: outlines in the scene's coordinates, one path per phase, with areas and a scale bar.\n"
        "Phases in contact share their outlines, so there are no gaps. A point farther than the\n"
        "tolerance from every outline is guaranteed to be in the phase drawn there. Places where this\n"
        "cannot be proven are reported.\n"
        "\n"
        ".png: a palette of the phases, and for each pixel the index of the phase at its centre.\n"
        "\n"
        "With several objects, their union is cut; --object chooses one. The whole scene file is\n"
        "checked, but it may lack a camera and lights, and the files of lights, meshes, textures and\n"
        "media are not opened.");
    const auto file = add_scene_file(*command);
    auto options = std::make_shared<SliceCommand>();
    add_object(*command, options->object);
    add_slice_options(*command, *options);
    command->callback([=, &run] { run = [=] { return slice_scene(*file, *options); }; });
}

}  // namespace phasetree::tracer
