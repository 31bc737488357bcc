#include "command/viewed_file.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "command/load.hpp"
#include "command/unplaced_report.hpp"
#include "output/file.hpp"
#include "phasetree/io/kept_nodes.hpp"
#include "phasetree/io/keys.hpp"
#include "scene/camera_text.hpp"
#include "volume/read_volume.hpp"

namespace phasetree::tracer {

namespace {

// Adds a file that the scene may name. Only the readers know which strings are file names, so every string with a dot
// that names a readable file is watched. This costs only a periodic check. For an image stack the folder is watched
// too, because images may be added and removed.
void add_file(const std::filesystem::path& path, view::WatchedFiles& files) {
    files.add(path);
    if (path.filename().string().find('#') == std::string::npos) return;
    files.add(path.has_parent_path() ? path.parent_path() : ".");
    try {
        for (const std::filesystem::path& layer : layers_of_stack(path)) files.add(layer);
    } catch (const std::runtime_error&) {
        // No such stack. The reader reports it if there should be one.
    }
}

void add_named_files(const Document& document, Value value, view::WatchedFiles& files) {
    if (value.is_string() && value.string().find('.') != std::string_view::npos && value.string().size() < 1024) {
        try {
            add_file(document.file(value), files);
        } catch (const SceneError&) {
            // Outside the folder that files must be in. The reader reports it if it is a file.
        }
    }
    for (const Value child : value) add_named_files(document, child, files);
}

Document with_edits(const SceneFile& scene, const Document& document, const view::NumberEdits& numbers) {
    if (numbers.empty()) return document;
    const Document edited =
        Document::from_text(view::with_numbers(document, numbers), document.name()).at(document.seconds());
    return scene.assets_within ? edited.with_files_within(*scene.assets_within) : edited;
}

// Objects in files of their own may have keys that the scene file does not know about. The time can still be set with
// --at.
std::optional<view::TimeSpan> span_of_keys(const Document& document) {
    const std::vector<double> times = times_of_keys(document.root());
    if (times.empty()) return std::nullopt;
    const auto [first, last] = std::ranges::minmax(times);
    return first < last ? std::optional(view::TimeSpan{first, last}) : std::nullopt;
}

view::ViewedScene read_viewed(const ViewedFile& file, const std::shared_ptr<KeptNodes>& kept, view::WatchedFiles& files,
                              const view::Reading& desired) {
    const view::NumberEdits& numbers = desired.numbers;
    files.add(file.scene.name);
    kept->start();
    SceneFile at_time = file.scene;
    if (desired.seconds) at_time.at = desired.seconds;
    const Document in_file = read_document(at_time);
    const Document document = with_edits(file.scene, in_file, numbers).with_kept_nodes(kept);
    add_named_files(document, document.root(), files);
    NodePlaces places;
    Scene scene = load_scene(document, &places);
    kept->finish();
    std::string warnings;
    for (const std::string& warning : warnings_of_unplaced_groups(document, scene.placed)) warnings += warning + "\n";
    make_one_tree(document, scene);
    scene.camera_moments.clear();  // The page moves the camera, and shows the moment when the shutter opens.
    // Report an unknown name now.
    (void)display_of(document, scene.settings, file.display, file.view, {});
    const RenderSettings settings = scene.settings;
    return {std::move(scene),
            [=, display = file.display, view = file.view](float exposure_ev) {
                return display_of(document, settings, display, view, exposure_ev);
            },
            in_file,
            numbers,
            view::numbers_of(in_file),
            std::move(places),
            std::move(warnings),
            document.seconds(),
            span_of_keys(document)};
}

// Keeps the file's permissions.
void write_text(const std::filesystem::path& file, const std::string& text) {
    const std::filesystem::perms permissions = std::filesystem::status(file).permissions();
    write_file(text, file);
    std::filesystem::permissions(file, permissions);
}

}  // namespace

view::ReadScene ViewedFile::reader() const {
    struct First {
        std::optional<view::ViewedScene> scene;
        view::WatchedFiles files;
    };
    const auto first = std::make_shared<First>();
    const auto kept = std::make_shared<KeptNodes>();
    first->scene = read_viewed(*this, kept, first->files, {});
    return [file = *this, first, kept](view::WatchedFiles& files, const view::Reading& desired) {
        std::optional<view::ViewedScene> known = std::exchange(first->scene, std::nullopt);
        if (!known || !desired.numbers.empty() || desired.seconds) return read_viewed(file, kept, files, desired);
        files = first->files;
        return std::move(*known);
    };
}

void ViewedFile::write_camera(const std::string& camera) const {
    write_text(scene.name, with_camera(read_document(scene), camera));
}

void ViewedFile::write_numbers(const view::NumberEdits& numbers) const {
    write_text(scene.name, view::with_numbers(read_document(scene), numbers));
}

}  // namespace phasetree::tracer
