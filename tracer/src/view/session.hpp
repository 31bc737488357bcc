// A Session shows one scene. The page says what it wishes to see (Wishes), and a thread changes what is shown (Shown)
// accordingly.
//
// The thread reads the scene, builds its cells, and takes pictures, coarse ones first. Every step is given up as soon
// as a later wish makes it useless, so a scene that would take forever is left by the next change. What goes wrong is
// shown over the last picture that there was, and the thread waits for the next wish.
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
    std::string name;  ///< of the scene, for people
    int threads = 0;
    BuildQuality quality = BuildQuality::medium;  ///< of the cells that the picture is refined with
    std::size_t most_bytes = 0;
    std::optional<int> samples;  ///< instead of the scene's
    std::optional<int> width;    ///< of the picture, likewise; the height follows
    /// Puts a camera into the scene's file. Throws SceneError and OutputError.
    std::function<void(const std::string& camera)> write_camera = [](const std::string&) {};
    /// Puts numbers into the scene's file. Throws likewise.
    std::function<void(const NumberEdits&)> write_numbers = [](const NumberEdits&) {};
    /// Is told errors and warnings, each with its line's end.
    std::function<void(std::string_view)> tell = [](std::string_view) {};
};

/// A change that the page asks for. A member without a value changes nothing.
struct Change {
    bool has_camera = false;                    ///< Whether the camera changes: to this one,
    std::optional<AnyCameraParameters> camera;  ///< or without a value back to the scene's.
    std::optional<std::vector<std::string>> hidden;
    std::optional<std::map<std::string, Look>> looks;  ///< all of them
    bool has_cut = false;                              ///< Whether the cut changes: to this one,
    std::optional<CutPlane> cut;                       ///< or without a value to none.
    std::optional<NumberEdits> numbers;                ///< all of them
    std::optional<double> seconds;                     ///< the time at which the scene is read
    std::optional<std::string> layer;                  ///< to be shown; empty for the picture itself
    std::optional<float> exposure_ev;

    bool is_of_object() const { return hidden || looks || has_cut; }
    bool is_of_text() const { return numbers || seconds; }
};

class Session {
  public:
    /// Begins at once.
    Session(ReadScene read, SessionOptions options);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Returns the version of what is shown just after the change was taken down: shown_after() of it waits for what
    /// comes of the change.
    std::uint64_t change(const Change& change);
    /// To be called periodically: reads the scene again if a file of it has been saved.
    void look_at_files();

    /// Puts the camera that is shown into the scene's file, one call after the other. Throws as
    /// SessionOptions::write_camera does, and ModelError while none is shown.
    void write_camera() const;
    /// Puts the numbers that are wished into the scene's file, where they then are; no more of them are wished. Throws
    /// as SessionOptions::write_numbers does.
    void write_numbers();

    std::shared_ptr<const Shown> shown() const;
    /// What is shown once its version is more than `version`, or when the time is over, or after stop() at once.
    std::shared_ptr<const Shown> shown_after(std::uint64_t version, std::chrono::milliseconds most) const;
    /// Ends all waiting and working, for good.
    void stop();

  private:
    using Clock = std::chrono::steady_clock;

    // What is wished. Each number grows with a wish of its kind.
    struct Wishes {
        std::uint64_t reading = 1, text = 0, object = 0, view = 0;
        Edits edits;
        Reading read_as;
        std::optional<AnyCameraParameters> camera;
        std::string layer;
        std::optional<float> exposure_ev;  // needs no new picture and so has no number
        Clock::time_point since = Clock::now();

        std::uint64_t number() const { return reading + text + object + view; }
        std::uint64_t number_of_object() const { return reading + text + object; }
    };

    // Which text of the file.
    struct TextNumber {
        std::uint64_t reading = 0, text = 0;
        bool operator==(const TextNumber&) const = default;
    };
    // Which scene, and which wish of how it is edited.
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
    void follow(Wishes wishes);
    void read(Wishes& wishes);
    void build(const Wishes& wishes);
    void keep_cells(const Scene& scene, WorldOptions& options) const;
    bool draw(const Wishes& wishes);
    bool draw_coarser(const Wishes& wishes, int scale);
    bool draw_whole(const Wishes& wishes, int samples);
    std::string warning_of_camera() const;
    void show_picture(const Wishes& wishes, Image image, int scale, int samples);
    void expose();
    void fail(const std::string& error);
    void stop_by_error();
    bool is_stale(const Wishes& wishes) const { return stopped_ || number_ != wishes.number(); }
    bool is_of_another_object(const Wishes& wishes) const {
        return stopped_ || number_of_object_ != wishes.number_of_object();
    }
    bool is_of_another_reading(const Wishes& wishes) const { return stopped_ || number_of_reading_ != wishes.reading; }
    bool is_first_of(const Wishes& wishes) const { return drawn_for_ != wishes.number(); }
    bool is_given_up(const Wishes& wishes, bool is_first) const;
    // To be called under the lock when the wishes have changed.
    void announce_wishes();

    // Changes what is shown, by `edit`, under the lock.
    void show(const std::function<void(Shown&)>& edit);
    // The same, for who holds the lock.
    void show_locked(const std::function<void(Shown&)>& edit);

    const ReadScene read_;
    const SessionOptions options_;

    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;  // It is notified of new wishes, of what is newly shown, and of the end.
    mutable std::mutex writing_;               // while the scene's file is written
    Wishes wishes_;
    std::shared_ptr<const Shown> shown_ = std::make_shared<Shown>();
    std::string camera_in_file_;  // empty until there is an object to look at
    PixelFilter filter_in_file_;
    WatchedFiles files_;
    std::optional<WatchedFiles> changed_files_;  // These are the files as they were when a change was last seen.
    bool is_to_be_read_ = true;
    std::atomic<std::uint64_t> number_{1}, number_of_object_{1}, number_of_reading_{1};
    std::atomic<bool> stopped_{false};

    // The thread's own.
    std::shared_ptr<const ViewedScene> viewed_;
    std::shared_ptr<Scene> scene_;  // as it is edited
    std::shared_ptr<const Prepared> prepared_;
    std::shared_ptr<SharedSurfaces> surfaces_ = std::make_shared<SharedSurfaces>();  // Their tables take long.
    TextNumber last_read_, last_read_well_;
    std::string warning_;                      // The object's.
    ObjectNumber built_for_;                   // The last object whose build was tried, with success or without.
    PictureNumber finished_for_;               // The last picture that has all samples.
    std::atomic<std::uint64_t> drawn_for_{0};  // The number of the wishes whose first picture has been shown.
    Clock::time_point drawing_since_;
    Ladder ladder_;

    std::thread thread_;  // last, because it uses all the others
};

}  // namespace phasetree::tracer::view
