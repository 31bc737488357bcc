// The interface between the page and the session: records changes of the desired state, and returns what is shown.
#include "view/session.hpp"

#include <algorithm>
#include <utility>

#include "phasetree/io/error.hpp"
#include "scene/camera_text.hpp"

namespace phasetree::tracer::view {

namespace {

// The page's controls must not jump back to earlier values.
void show_desired(const Edits& edits, const Reading& read_as, Shown& shown) {
    shown.cut = edits.cut;
    shown.numbers = read_as.numbers;
    shown.hidden_parts = read_as.hidden.pointers;
    for (ShownPhase& phase : shown.phases) {
        phase.is_hidden = std::ranges::find(edits.hidden, phase.name) != edits.hidden.end();
        const auto look = edits.looks.find(phase.name);
        phase.look = look == edits.looks.end() ? Look{} : look->second;
    }
}

}  // namespace

Session::Session(ReadScene read, SessionOptions options)
    : read_(std::move(read)), options_(std::move(options)), thread_([this] { work(); }) {}

Session::~Session() {
    stop();
    thread_.join();
}

void Session::stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    changed_.notify_all();
}

void Session::show(const std::function<void(Shown&)>& edit) {
    const std::lock_guard lock(mutex_);
    show_locked(edit);
}

void Session::show_locked(const std::function<void(Shown&)>& edit) {
    auto next = std::make_shared<Shown>(*shown_);
    edit(*next);
    show_desired(desired_.edits, desired_.read_as, *next);
    if (desired_.read_as.seconds) next->seconds = *desired_.read_as.seconds;
    next->layer = desired_.layer;
    next->camera_text = desired_.camera ? camera_text(*desired_.camera, filter_in_file_) : camera_in_file_;
    ++next->version;
    shown_ = std::move(next);
    changed_.notify_all();
}

std::shared_ptr<const Shown> Session::shown() const {
    const std::lock_guard lock(mutex_);
    return shown_;
}

std::shared_ptr<const Shown> Session::shown_after(std::uint64_t version, std::chrono::milliseconds timeout) const {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, timeout, [&] { return stopped_ || shown_->version > version; });
    return shown_;
}

void Session::write_camera() const {
    const std::string camera = shown()->camera_text;
    if (camera.empty()) throw ModelError("there is no picture yet");
    const std::lock_guard lock(writing_);
    options_.write_camera(camera);
}

void Session::write_numbers() {
    const std::lock_guard lock(writing_);
    const NumberEdits numbers = shown()->numbers;
    options_.write_numbers(numbers);
    // Other changes may have been requested meanwhile.
    Change change;
    change.numbers = shown()->numbers;
    for (const auto& [pointer, value] : numbers)
        if (const auto still = change.numbers->find(pointer); still != change.numbers->end() && still->second == value)
            change.numbers->erase(still);
    this->change(change);
}

std::uint64_t Session::change(const Change& change) {
    {
        const std::lock_guard lock(mutex_);
        if (change.exposure_ev) desired_.exposure_ev = change.exposure_ev;
        if (change.has_camera) desired_.camera = change.camera;
        if (change.layer) desired_.layer = *change.layer;
        if (change.has_camera || change.layer) ++desired_.view;
        if (change.hidden) desired_.edits.hidden = *change.hidden;
        if (change.looks) desired_.edits.looks = *change.looks;
        if (change.has_cut) desired_.edits.cut = change.cut;
        if (change.is_of_object()) ++desired_.object;
        if (change.numbers) desired_.read_as.numbers = *change.numbers;
        if (change.seconds) desired_.read_as.seconds = change.seconds;
        if (change.hidden_parts) desired_.read_as.hidden = {*change.hidden_parts, nullptr};
        if (change.is_of_text()) ++desired_.text;
        if (change.has_camera || change.layer || change.is_of_object() || change.is_of_text())
            desired_.since = Clock::now();
        announce_changes();
        // Set this before the thread can finish the work, or the page would be shown an outdated message.
        if (change.is_of_object()) show_locked([](Shown& shown) { shown.doing = "Building cells"; });
        if (change.is_of_text()) show_locked([](Shown& shown) { shown.doing = "Reading the scene"; });
        if (change.has_camera || change.layer) show_locked([](Shown& shown) { shown.doing = "Rendering"; });
    }
    if (change.exposure_ev) expose();
    return shown()->version;
}

void Session::text_changed() {
    const std::lock_guard lock(mutex_);
    ++desired_.text;
    ++desired_.document;
    desired_.since = Clock::now();
    announce_changes();
    show_locked([](Shown& shown) { shown.doing = "Reading the scene"; });
}

// Reads a file only after two checks with the same state, because some programs save in several steps.
void Session::look_at_files() {
    const std::lock_guard lock(mutex_);
    if (is_to_be_read_) return;
    const WatchedFiles now = files_.now();
    if (now == files_) {
        changed_files_.reset();
        return;
    }
    if (changed_files_ != now) {
        changed_files_ = now;
        return;
    }
    changed_files_.reset();
    is_to_be_read_ = true;
    ++desired_.reading;
    desired_.since = Clock::now();
    announce_changes();
}

void Session::announce_changes() {
    number_ = desired_.number();
    number_of_object_ = desired_.number_of_object();
    number_of_text_ = desired_.number_of_text();
    number_of_reading_ = desired_.reading;
    changed_.notify_all();
}

}  // namespace phasetree::tracer::view
