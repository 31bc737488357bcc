#include "command/viewed_file.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <utility>

#include "command/load.hpp"
#include "command/unplaced_report.hpp"
#include "image/kept_images.hpp"
#include "phasetree/io/kept_nodes.hpp"
#include "phasetree/io/keys.hpp"
#include "phasetree/model/poll_preparation.hpp"
#include "scene/camera_text.hpp"
#include "studio/hidden_parts.hpp"
#include "volume/read_volume.hpp"

namespace phasetree::tracer {

// Keeps display transforms for later pictures, because reading OpenColorIO's configuration takes milliseconds.
class KeptDisplays {
  public:
    // The display and the view of the command line.
    KeptDisplays(std::optional<std::string> display, std::optional<std::string> view)
        : display_(std::move(display)), view_(std::move(view)) {}

    DisplayTransform get(const Document& document, const RenderSettings& settings, float exposure_ev) {
        const std::lock_guard lock(mutex_);
        const char* configuration = std::getenv("OCIO");
        std::error_code error;  // such as that there is none
        const Key key{settings.view, std::filesystem::last_write_time(configuration ? configuration : "", error)};
        if (key != key_ || displays_.size() >= most) displays_.clear();
        key_ = key;
        const auto known = displays_.find(exposure_ev);
        if (known != displays_.end()) return known->second;
        const DisplayTransform made = display_of(document, settings, display_, view_, exposure_ev);
        return displays_.emplace(exposure_ev, made).first->second;
    }

  private:
    static constexpr std::size_t most = 16;
    using Key = std::pair<std::optional<std::string>, std::filesystem::file_time_type>;

    const std::optional<std::string> display_, view_;
    std::mutex mutex_;
    Key key_;
    std::map<float, DisplayTransform> displays_;  // by exposure
};

// What one reading keeps for the next.
struct KeptForReading {
    std::shared_ptr<KeptDisplays> displays;
    std::shared_ptr<KeptNodes> nodes = std::make_shared<KeptNodes>();
    KeptImages images{};
    studio::Vocabulary vocabulary{};
};

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

Document with_text(const SceneFile& scene, const Document& document, std::string text) {
    const Document edited = Document::from_text(std::move(text), document.name()).at(document.seconds());
    return scene.assets_within ? edited.with_files_within(*scene.assets_within) : edited;
}

Document with_edits(const SceneFile& scene, const Document& document, const view::NumberEdits& numbers) {
    return numbers.empty() ? document : with_text(scene, document, view::with_numbers(document, numbers));
}

Document without(const SceneFile& scene, const Document& document, const std::vector<std::string>& hidden,
                 const studio::Vocabulary& vocabulary) {
    return hidden.empty() ? document : with_text(scene, document, studio::text_without(document, vocabulary, hidden));
}

// Objects in files of their own may have keys that the scene file does not know about. The time can still be set with
// --at.
std::optional<view::TimeSpan> span_of_keys(const Document& document) {
    const std::vector<double> times = times_of_keys(document.root());
    if (times.empty()) return std::nullopt;
    const auto [first, last] = std::ranges::minmax(times);
    return first < last ? std::optional(view::TimeSpan{first, last}) : std::nullopt;
}

// The desired hidden parts, as pointers into the text of the file. The request may refer to an earlier text.
view::HiddenParts hidden_in(const ViewedFile& file, const Document& in_file, const view::HiddenParts& desired) {
    if (desired.pointers.empty()) return {};
    view::HiddenParts hidden{desired.pointers, std::make_shared<const std::string>(in_file.text())};
    if (!desired.text || *desired.text == *hidden.text) return hidden;
    try {
        const Document before = Document::from_text(*desired.text, file.scene.name);
        hidden.pointers = studio::pointers_after(before, in_file, desired.pointers);
    } catch (const SceneError&) {
        hidden.pointers.clear();
    }
    return hidden;
}

view::ViewedScene read_viewed(const ViewedFile& file, const Document& in_file, KeptForReading& kept,
                              view::WatchedFiles& files, const view::Reading& desired) {
    const view::NumberEdits& numbers = desired.numbers;
    const std::shared_ptr<KeptDisplays> displays = kept.displays;
    kept.nodes->start();
    const KeptImages::Use use(kept.images);
    view::HiddenParts hidden = hidden_in(file, in_file, desired.hidden);
    const Document document =
        without(file.scene, with_edits(file.scene, in_file, numbers), hidden.pointers, kept.vocabulary)
            .with_kept_nodes(kept.nodes);
    add_named_files(document, document.root(), files);
    NodePlaces places;
    Scene scene = load_scene(document, &places);
    kept.nodes->finish();
    std::string warnings;
    for (const std::string& warning : warnings_of_unplaced_groups(document, scene.placed)) warnings += warning + "\n";
    make_one_tree(document, scene);
    scene.camera_moments.clear();  // The page moves the camera, and shows the moment when the shutter opens.
    // Report an unknown name now.
    (void)displays->get(document, scene.settings, scene.settings.exposure_ev);
    const RenderSettings settings = scene.settings;
    return {std::move(scene),
            [=](float exposure_ev) { return displays->get(document, settings, exposure_ev); },
            in_file,
            numbers,
            view::numbers_of(in_file),
            std::move(places),
            std::move(warnings),
            document.seconds(),
            span_of_keys(document),
            std::move(hidden)};
}

// Waits for a mutex. Throws PreparationCancelled.
std::unique_lock<std::timed_mutex> locked(std::timed_mutex& mutex) {
    std::unique_lock lock(mutex, std::defer_lock);
    while (!lock.try_lock_for(std::chrono::milliseconds(20))) poll_preparation();
    return lock;
}

}  // namespace

// One reading at a time, because they share the nodes made from files. The last scene read by check() is kept for the
// session, which reads the same text next if the step is made.
class SceneReadings {
  public:
    explicit SceneReadings(std::shared_ptr<KeptDisplays> displays) : kept_{.displays = std::move(displays)} {}

    void check(const ViewedFile& file, const Document& document) {
        const std::unique_lock lock = locked(mutex_);
        Checked checked{document.text(), {}, {}};
        checked.scene = read_viewed(file, document, kept_, checked.files, {});
        checked_ = std::move(checked);
    }
    view::ViewedScene read(const ViewedFile& file, const Document& document, view::WatchedFiles& files,
                           const view::Reading& desired) {
        const std::unique_lock lock = locked(mutex_);
        const bool is_as_checked = desired.numbers.empty() && !desired.seconds && desired.hidden.pointers.empty();
        if (auto known = std::exchange(checked_, std::nullopt);
            known && is_as_checked && known->text == document.text()) {
            files = std::move(known->files);
            return std::move(*known->scene);
        }
        return read_viewed(file, document, kept_, files, desired);
    }

  private:
    struct Checked {
        std::string text;
        std::optional<view::ViewedScene> scene;
        view::WatchedFiles files;
    };
    std::timed_mutex mutex_;
    KeptForReading kept_;
    std::optional<Checked> checked_;
};

std::shared_ptr<SceneReadings> ViewedFile::new_readings() const {
    return std::make_shared<SceneReadings>(std::make_shared<KeptDisplays>(display, view));
}

std::unique_ptr<studio::EditedDocument> ViewedFile::document(bool saves) const {
    const auto parse = [file = scene](std::string text) {
        const Document document = Document::from_text(std::move(text), file.name).at(file.at.value_or(0));
        return file.assets_within ? document.with_files_within(*file.assets_within) : document;
    };
    const auto check = [file = *this](const Document& document) { file.readings->check(file, document); };
    return std::make_unique<studio::EditedDocument>(
        studio::EditedDocument::Options{.file = scene.name, .saves = saves, .parse = parse, .check = check});
}

namespace {

void check_text(const ViewedFile& file, studio::EditedDocument& document, const studio::DocumentState& state) {
    try {
        file.readings->check(file, *state.document);
        document.record_check(state.text_version, {});
    } catch (const SceneError& e) {
        document.record_check(state.text_version, e);
    }
}

}  // namespace

view::ReadScene ViewedFile::reader(studio::EditedDocument& document) const {
    const auto read = [file = *this, &document](view::WatchedFiles& files, const view::Reading& desired) {
        const auto state = document.state();
        if (state->unreadable) throw *state->unreadable;
        if (!state->document) throw state->error.value();
        // If the page replaced numbers or hid parts, an error may come from these, so it is not recorded for the text.
        const bool is_of_text = desired.numbers.empty() && desired.hidden.pointers.empty();
        if (!desired.hidden.pointers.empty() && !state->is_checked) check_text(file, document, *state);
        try {
            const Document text = desired.seconds ? state->document->at(*desired.seconds) : *state->document;
            view::ViewedScene scene = file.readings->read(file, text, files, desired);
            if (is_of_text) document.record_check(state->text_version, {});
            return scene;
        } catch (const SceneError& e) {
            if (is_of_text) document.record_check(state->text_version, e);
            throw;
        }
    };
    // The session reports errors, and the page can repair the scene.
    if (const auto state = document.state(); state->document) check_text(*this, document, *state);
    return read;
}

void write_camera(studio::EditedDocument& document, const std::string& camera) {
    document.edit("Write the camera", [&](const Document& text) { return with_camera(text, camera); });
}

void write_numbers(studio::EditedDocument& document, const view::NumberEdits& numbers) {
    document.edit("Write numbers", [&](const Document& text) { return view::with_numbers(text, numbers); });
}

}  // namespace phasetree::tracer
