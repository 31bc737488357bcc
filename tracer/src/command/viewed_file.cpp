#include "command/viewed_file.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "command/load.hpp"
#include "command/unplaced_report.hpp"
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
        // There is no such stack. If the scene refers to one, the reader reports the error.
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

view::ViewedScene read_viewed(const ViewedFile& file, const Document& in_file, const std::shared_ptr<KeptNodes>& kept,
                              view::WatchedFiles& files, const view::Reading& desired) {
    const view::NumberEdits& numbers = desired.numbers;
    kept->start();
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

// The current version of the document, read with the command-line options.
struct CurrentDocument {
    std::uint64_t text_version;
    Document document;
};

// Throws SceneError if the file cannot be read or is no valid JSON.
CurrentDocument current_document(const ViewedFile& file, studio::EditedDocument& edited, const view::Reading& desired) {
    const auto state = edited.state();
    if (state->unreadable) throw *state->unreadable;
    if (!state->document) throw state->error.value();
    return {state->text_version, state->document->at(desired.seconds ? *desired.seconds : file.scene.at.value_or(0))};
}

view::ViewedScene read_checked(const ViewedFile& file, studio::EditedDocument& edited,
                               const std::shared_ptr<KeptNodes>& kept, view::WatchedFiles& files,
                               const view::Reading& desired) {
    const auto [version, document] = current_document(file, edited, desired);
    try {
        view::ViewedScene scene = read_viewed(file, document, kept, files, desired);
        if (desired.numbers.empty()) edited.record_check(version, {});
        return scene;
    } catch (const SceneError& e) {
        // If the page replaced numbers, they may be what is wrong, so the text's check is not recorded.
        if (desired.numbers.empty()) edited.record_check(version, e);
        throw;
    }
}

}  // namespace

std::unique_ptr<studio::EditedDocument> ViewedFile::document(bool saves) const {
    const auto parse = [file = scene](std::string text) {
        const Document document = Document::from_text(std::move(text), file.name).at(file.at.value_or(0));
        return file.assets_within ? document.with_files_within(*file.assets_within) : document;
    };
    const auto check = [](const Document& document) { (void)load_scene(document); };
    return std::make_unique<studio::EditedDocument>(
        studio::EditedDocument::Options{.file = scene.name, .saves = saves, .parse = parse, .check = check});
}

view::ReadScene ViewedFile::reader(studio::EditedDocument& document) const {
    struct First {
        std::optional<view::ViewedScene> scene;
        view::WatchedFiles files;
        std::uint64_t text_version;
    };
    const auto first = std::make_shared<First>();
    const auto kept = std::make_shared<KeptNodes>();
    first->text_version = document.state()->text_version;
    try {
        first->scene = read_checked(*this, document, kept, first->files, {});
    } catch (const SceneError&) {
        // The session reports it, and the page can repair the scene.
    }
    return [file = *this, &document, first, kept](view::WatchedFiles& files, const view::Reading& desired) {
        std::optional<view::ViewedScene> known = std::exchange(first->scene, std::nullopt);
        const bool is_same =
            desired.numbers.empty() && !desired.seconds && document.state()->text_version == first->text_version;
        if (!known || !is_same) return read_checked(file, document, kept, files, desired);
        files = first->files;
        return std::move(*known);
    };
}

void write_camera(studio::EditedDocument& document, const std::string& camera) {
    document.edit("Write the camera", [&](const Document& text) { return with_camera(text, camera); });
}

void write_numbers(studio::EditedDocument& document, const view::NumberEdits& numbers) {
    document.edit("Write numbers", [&](const Document& text) { return view::with_numbers(text, numbers); });
}

}  // namespace phasetree::tracer
