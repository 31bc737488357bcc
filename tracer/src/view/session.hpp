// A Session shows one scene. The page changes the desired state (DesiredState), and a thread updates what is shown
// (Shown).
//
// The thread reads the scene, builds its cells, and renders pictures, coarse ones first. It abandons a step as soon as
// a later change makes it useless. So a change also stops work on a scene that would never finish. Errors are shown
// over the last available picture, and the thread waits for the next change.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "render/render.hpp"
#include "view/ladder.hpp"
#include "view/shown.hpp"
#include "view/viewed_scene.hpp"

namespace phasetree::tracer::view {

struct SessionOptions {
    std::string name;  ///< of the scene, for display
    int threads = 0;
    BuildQuality quality = BuildQuality::medium;  ///< of the cells used to refine the picture
    std::size_t max_bytes = 0;
    std::optional<int> samples;  ///< instead of the scene's
    std::optional<int> width;    ///< width of the picture, instead of the scene's; the height is scaled
    /// Writes a camera to the scene's file. Throws SceneError and OutputError.
    std::function<void(const std::string& camera)> write_camera = [](const std::string&) {};
    /// Writes numbers to the scene's file. Throws SceneError and OutputError.
    std::function<void(const NumberEdits&)> write_numbers = [](const NumberEdits&) {};
    /// Receives errors and warnings, each with a line ending.
    std::function<void(std::string_view)> tell = [](std::string_view) {};
};

/// A change requested by the page. Members without a value change nothing.
struct Change {
    bool has_camera = false;                    ///< whether to change the camera
    std::optional<AnyCameraParameters> camera;  ///< the new camera; without a value, the scene's own
    std::optional<std::vector<std::string>> hidden;
    std::optional<std::map<std::string, Look>> looks;      ///< replaces all of them
    bool has_cut = false;                                  ///< whether to change the cut
    std::optional<CutPlane> cut;                           ///< the new cut; without a value, none
    std::optional<NumberEdits> numbers;                    ///< replaces all of them
    std::optional<double> seconds;                         ///< the time at which the scene is read
    std::optional<std::vector<std::string>> hidden_parts;  ///< replaces all of them
    std::optional<std::string> layer;                      ///< the layer to show; empty for the picture itself
    std::optional<float> exposure_ev;

    bool is_of_object() const { return hidden || looks || has_cut; }
    bool is_of_text() const { return numbers || seconds || hidden_parts; }
};

class Session {
  public:
    /// Starts the thread.
    Session(ReadScene read, SessionOptions options);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Records a change, and returns the version of what is shown just afterwards. Pass it to shown_after() to wait for
    /// the result of the change.
    std::uint64_t change(const Change& change);
    /// Reads the scene again if one of its files has been saved. Call this periodically.
    void look_at_files();
    /// Reads the scene again, because the text that ReadScene reads has changed.
    void text_changed();

    /// Writes the shown camera to the scene's file. Calls are serialised. Throws as SessionOptions::write_camera does,
    /// and ModelError if no camera is shown yet.
    void write_camera() const;
    /// Writes the edited numbers to the scene's file, after which they are no longer edits. Throws as
    /// SessionOptions::write_numbers does.
    void write_numbers();

    std::shared_ptr<const Shown> shown() const;
    /// Waits until the version of what is shown exceeds `version`, until the timeout, or until stop(), and returns
    /// what is shown.
    std::shared_ptr<const Shown> shown_after(std::uint64_t version, std::chrono::milliseconds timeout) const;
    /// Ends all waiting and working permanently.
    void stop();

  private:
    using Clock = std::chrono::steady_clock;

    // What the page requests. Each number counts the requests of its kind and only increases: `reading` those to read
    // the files, `text`, `object` and `view` those to change them. `document` counts the changes of the text other than
    // replaced numbers.
    struct DesiredState {
        std::uint64_t reading = 1, text = 0, object = 0, view = 0, document = 0;
        Edits edits;
        Reading read_as;
        std::optional<AnyCameraParameters> camera;
        std::string layer;
        std::optional<float> exposure_ev;  // needs no new picture, and so has no number
        Clock::time_point since = Clock::now();

        std::uint64_t number() const { return reading + text + object + view; }
        std::uint64_t number_of_object() const { return reading + text + object; }
        std::uint64_t number_of_text() const { return reading + text; }
    };

    // Identifies a version of the scene's text: which reading of the file, with which replaced numbers.
    struct TextNumber {
        std::uint64_t reading = 0, text = 0;
        bool operator==(const TextNumber&) const = default;
    };
    // Identifies the scene and its edits.
    struct ObjectNumber {
        TextNumber text;
        std::uint64_t object = 0;
        bool operator==(const ObjectNumber&) const = default;
    };
    struct PictureNumber {
        ObjectNumber object;
        std::uint64_t view = 0;
        bool operator==(const PictureNumber&) const = default;
    };

    void work();
    void follow(DesiredState desired);
    void read(DesiredState& desired);
    void build(const DesiredState& desired);
    void keep_cells(const Scene& scene, WorldOptions& options) const;
    bool draw(const DesiredState& desired);
    bool draw_coarser(const DesiredState& desired, int scale);
    bool draw_whole(const DesiredState& desired, int samples);
    std::string warning_of_camera() const;
    void show_picture(const DesiredState& desired, Image image, int scale, int samples);
    void expose();
    void fail(const std::string& error);
    void stop_by_error();
    bool is_stale(const DesiredState& desired) const { return stopped_ || number_ != desired.number(); }
    bool is_of_another_object(const DesiredState& desired) const {
        return stopped_ || number_of_object_ != desired.number_of_object();
    }
    bool is_of_another_text(const DesiredState& desired) const {
        return stopped_ || number_of_text_ != desired.number_of_text();
    }
    bool is_of_another_reading(const DesiredState& desired) const {
        return stopped_ || number_of_reading_ != desired.reading;
    }
    bool is_first_of(const DesiredState& desired) const { return drawn_for_ != desired.number(); }
    bool is_given_up(const DesiredState& desired, bool is_first) const;
    // Call this with the lock held after changing `desired_`.
    void announce_changes();

    // Applies `edit` to what is shown, under the lock.
    void show(const std::function<void(Shown&)>& edit);
    // As show(), with the lock already held.
    void show_locked(const std::function<void(Shown&)>& edit);

    const ReadScene read_;
    const SessionOptions options_;

    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;  // notified when `desired_` or `shown_` changes, and at the end
    mutable std::mutex writing_;               // held while the scene's file is written
    DesiredState desired_;
    std::shared_ptr<const Shown> shown_ = std::make_shared<Shown>();
    std::string camera_in_file_;  // empty until there is an object to look at
    PixelFilter filter_in_file_;
    WatchedFiles files_;
    std::optional<WatchedFiles> changed_files_;  // the files' state when a change was last seen
    bool is_to_be_read_ = true;
    std::atomic<std::uint64_t> number_{1}, number_of_object_{1}, number_of_text_{1}, number_of_reading_{1};
    std::atomic<bool> stopped_{false};

    // Used only by the thread.
    std::shared_ptr<const ViewedScene> viewed_;
    std::shared_ptr<Scene> scene_;  // after edits
    std::shared_ptr<const Prepared> prepared_;
    std::shared_ptr<SharedSurfaces> surfaces_ = std::make_shared<SharedSurfaces>();  // expensive tables
    TextNumber last_read_, last_read_well_;
    std::string warning_;                      // of the object
    ObjectNumber built_for_;                   // the last object whose build was attempted, successfully or not
    PictureNumber finished_for_;               // the last picture with all samples
    std::atomic<std::uint64_t> drawn_for_{0};  // number of the state whose first picture has been shown
    Clock::time_point drawing_since_;
    Ladder ladder_;

    std::thread thread_;  // last, because it uses all other members
};

}  // namespace phasetree::tracer::view
