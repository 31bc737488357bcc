#include "command/export_labels.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "command/errors.hpp"
#include "command/exit_codes.hpp"
#include "command/load.hpp"
#include "command/looks.hpp"
#include "command/overwritten_files.hpp"
#include "command/streams.hpp"
#include "output/error.hpp"
#include "output/file.hpp"
#include "output/interrupt.hpp"
#include "output/late_progress.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/trace/tracer.hpp"
#include "render/threads.hpp"
#include "scene/read_parts.hpp"
#include "volume/label_volume.hpp"
#include "volume/read_volume.hpp"

namespace phasetree::tracer {

namespace {

constexpr double voxels_along_longest_side = 256;
constexpr std::size_t default_max_bytes = std::size_t{2} << 30;

bool is_openvdb(const LabelExport& wanted) {
    return std::filesystem::path(wanted.output).extension() == ".vdb";
}

// A grid whose voxels cover the bounds, without its labels. Throws UsageError if it takes too much memory.
LabelVolume grid_around(const Bounds& bounds, const LabelExport& wanted) {
    const glm::dvec3 low(bounds.low), extent = glm::dvec3(bounds.high) - low;
    const double longest = std::max({extent.x, extent.y, extent.z});
    LabelVolume volume;
    volume.spacing = wanted.spacing > 0 ? static_cast<double>(wanted.spacing) : longest / voxels_along_longest_side;
    // Labels, their compressed form, and the tree of an OpenVDB grid, which has 32 bits per voxel.
    const double bytes_per_voxel = is_openvdb(wanted) ? 10 : 2;
    double bytes = bytes_per_voxel;
    for (int i = 0; i < 3; ++i) {
        const double count = std::max(1.0, std::ceil(extent[i] / volume.spacing - 1e-6));
        bytes *= count;
        volume.size[static_cast<std::size_t>(i)] = static_cast<std::size_t>(std::min(count, 1e9));
        volume.origin[i] = low[i] + 0.5 * extent[i] - 0.5 * (count - 1) * volume.spacing;
    }
    const std::size_t limit = wanted.max_bytes > 0 ? wanted.max_bytes : default_max_bytes;
    if (!(bytes <= static_cast<double>(limit)))
        throw UsageError(fmt::format(
            "--spacing: {} × {} × {} voxels of {:.4g} need {:.3g} GB of memory, but the limit is {:.3g} GB; "
            "use a larger --spacing or --max-memory",
            volume.size[0], volume.size[1], volume.size[2], volume.spacing, bytes / 0x1p30,
            static_cast<double>(limit) / 0x1p30));
    return volume;
}

// Coordinates are rounded once.
float coordinate(const LabelVolume& volume, int axis, std::size_t i) {
    return static_cast<float>(volume.origin[axis] + static_cast<double>(i) * volume.spacing);
}

void set_labels(LabelVolume& volume, const Program& program, LateProgress& progress) {
    const Evaluator evaluator(program);
    const auto [width, height, depth] = volume.size;
    volume.labels.resize(volume.count());
    std::mutex one_at_a_time;
    std::size_t done = 0;
    tbb::parallel_for(std::size_t{0}, height * depth,
                      [&, width = width, height = height, rows = height * depth](std::size_t row) {
                          if (interrupted()) throw LabelsCancelled();
                          const FlushSubnormals flush;
                          BatchOfFloats x, y, z;
                          y.lane.fill(coordinate(volume, 1, row % height));
                          z.lane.fill(coordinate(volume, 2, row / height));
                          for (std::size_t first = 0; first < width; first += batch_size) {
                              for (std::size_t i = 0; i < batch_size; ++i) x[i] = coordinate(volume, 0, first + i);
                              Samples samples;
                              evaluator.sample(x, y, z, samples, Evaluator::thread_workspace());
                              for (std::size_t i = 0; i < std::min(batch_size, width - first); ++i)
                                  volume.labels[row * width + first + i] = static_cast<std::uint8_t>(samples.label[i]);
                          }
                          const std::lock_guard lock(one_at_a_time);
                          progress.tell(static_cast<float>(++done) / static_cast<float>(rows));
                      });
}

// The file's unit describes the lengths as written. After scaling, the scene's unit would be wrong, so it is omitted.
std::string unit_of(const LabelExport& wanted, const SceneModel& model) {
    return model.unit && !wanted.scale ? std::string(model.unit->name) : "";
}

}  // namespace

bool is_label_extension(std::string_view extension) {
    return extension == ".nrrd" || extension == ".vdb";
}

int export_labels(const SceneFile& file, const LabelExport& wanted) {
    const AvailableThreads threads;
    if (is_openvdb(wanted) && !can_read_openvdb())
        throw UsageError(fmt::format(
            "cannot write \"{}\": this phasetree was built without OpenVDB; write .nrrd, or install libopenvdb-dev and "
            "rebuild",
            wanted.output));
    check_file_writable(wanted.output);
    const Document document = read_document(file);
    check_overwrites(file, document, named_files_of("--output", std::span(&wanted.output, 1)));
    const SceneModel model = read_scene_model(document);
    const SceneTree tree = tree_of_model(document, model, wanted.object);
    const Program program = record_tree(document, tree.object);
    const TraceableObject traceable = made_of_tree(document, [&] { return prepare_to_trace(tree.object); });
    print_warning(file.shown(), traceable.warning);
    LabelVolume volume = grid_around(traceable.bounds, wanted);
    for (const Look& look : looks_of(tree.phases, read_materials(document), traceable.bounds))
        volume.phases.push_back({look.name, shown_color(look)});
    const InterruptGuard guard;
    try {
        const auto cancelled = [] { return interrupted(); };
        LateProgress progress(ProgressOutput::standard_error(false), "labelling voxels");
        set_labels(volume, program, progress);
        const auto scale = static_cast<double>(wanted.scale.value_or(1));
        volume.origin *= scale;
        volume.spacing *= scale;
        volume.scale = scale;
        volume.unit = unit_of(wanted, model);
        write_file(is_openvdb(wanted) ? labels_as_openvdb(volume, cancelled) : labels_as_nrrd(volume, cancelled),
                   wanted.output);
    } catch (const LabelsCancelled&) {
        say("phasetree: interrupted; no file was written\n");
        return code_of_interruption(false);
    }
    return exit_code::success;
}

}  // namespace phasetree::tracer
