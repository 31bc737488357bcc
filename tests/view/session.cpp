// A session whose scenes and displays stop and fail on demand: nothing that happens meanwhile is lost.
#include "view/session.hpp"

#include <unistd.h>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/phased/set.hpp"

namespace test_session {

using namespace phasetree;
using namespace phasetree::tracer;
using namespace phasetree::tracer::view;

namespace {

constexpr std::chrono::seconds long_enough{60};

// Waits until `holds()`; whether it does in the end.
template <class Condition>
bool comes(Condition&& holds) {
    const auto end = std::chrono::steady_clock::now() + long_enough;
    while (!holds()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

Scene scene_with_camera(const std::string& position) {
    return read_scene(Document::from_text(fmt::format(
        R"({{"version": 1, "phases": {{"wood": {{"diffuse": {{"color": [0.5, 0.3, 0.1]}}}}}},
             "tree": {{"set": {{"phase": "wood", "of": {{"sphere": {{"radius": 0.5}}}}}}}},
             "lights": [{{"gradient": {{"zenith": [1, 1, 1], "horizon": [1, 1, 1], "ground": [1, 1, 1]}}}}],
             "camera": {{"position": {}, "look_at": [0, 0, 0]}},
             "render": {{"width": 24, "height": 16, "samples": 2}}}})",
        position)));
}

Change camera_at(const std::string& position) {
    Change change;
    change.has_camera = true;
    change.camera = scene_with_camera(position).camera;
    return change;
}

Change exposure_of(float stops) {
    Change change;
    change.exposure_ev = stops;
    return change;
}

// A file that is watched, and what is read when it has changed.
class Bench {
  public:
    Bench() { save(); }
    ~Bench() {
        release();
        session_.reset();
        std::filesystem::remove(file_);
    }
    Session& begin() {
        options_.name = "scene";
        options_.threads = 1;
        session_.emplace([this](WatchedFiles& files, const Reading& wished) { return read(files, wished); }, options_);
        return *session_;
    }
    void save() { std::ofstream(file_, std::ios::app) << "."; }
    // Lets the session see what was saved, until it reads.
    bool is_seen() {
        const int before = readings;
        return comes([&] {
            session_->look_at_files();
            return readings > before;
        });
    }
    bool is_ready() {
        return comes([&] { return session_->shown()->doing == "Ready"; });
    }
    void release() { holds_reading = false; }

    std::string position = "[0, -3, 0]";
    std::function<Scene(const std::string&)> scene_with = scene_with_camera;
    bool is_endless = false;  // so that it cannot be built
    std::function<void(float)> before_display = [](float) {};
    std::function<void(const std::string&)>& write() { return options_.write_camera; }
    std::atomic<int> readings{0};
    std::atomic<bool> holds_reading{false};

  private:
    ViewedScene read(WatchedFiles& files, const Reading& wished) {
        files.add(file_);
        ++readings;
        Scene scene = scene_with(position);
        if (is_endless) scene.object = Set{.phase = Phase{1}, .of = Plane{}};
        (void)comes([&] { return !holds_reading; });
        ViewedScene viewed{std::move(scene), [this](float exposure_ev) {
                               before_display(exposure_ev);
                               return DisplayTransform(std::nullopt, std::nullopt, exposure_ev);
                           }};
        viewed.seconds = wished.seconds.value_or(0.5);
        viewed.keys = TimeSpan{-1, 3};
        return viewed;
    }

    std::filesystem::path file_ =
        std::filesystem::temp_directory_path() / fmt::format("phasetree-session-{}", ::getpid());
    SessionOptions options_;
    std::optional<Session> session_;
};

}  // namespace

TEST_CASE("of two exposures that are wished at once the later is shown") {
    Bench bench;
    Session& session = bench.begin();
    REQUIRE(bench.is_ready());
    std::atomic<bool> is_second_begun{false};
    bench.before_display = [&](float ev) {
        if (ev == 1) (void)comes([&] { return is_second_begun.load(); });
        // Both have begun with the same picture; the first is shown while the second is still computed.
        // The first may go on to the second at once, so what is waited for is that anything else is shown.
        if (ev == 2 && !is_second_begun.exchange(true)) (void)comes([&] { return session.shown()->exposure_ev >= 1; });
    };
    std::thread first([&] { session.change(exposure_of(1)); });
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    session.change(exposure_of(2));
    first.join();
    CHECK(session.shown()->exposure_ev == 2);
    CHECK(session.shown()->picture->exposure_ev == 2);
}

TEST_CASE("after a build that failed the camera turns no picture of the old object") {
    Bench bench;
    Session& session = bench.begin();
    REQUIRE(bench.is_ready());
    bench.is_endless = true;
    bench.save();
    REQUIRE(bench.is_seen());
    REQUIRE(comes([&] { return !session.shown()->error.empty(); }));
    const std::uint64_t number = session.shown()->picture->number;
    session.change(camera_at("[3, 0, 0]"));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    CHECK(session.shown()->picture->number == number);
    CHECK(!session.shown()->error.empty());
    CHECK(session.shown()->doing == "Stopped by an error");

    bench.is_endless = false;
    bench.save();
    REQUIRE(bench.is_seen());
    REQUIRE(bench.is_ready());
    CHECK(session.shown()->error.empty());
    CHECK(session.shown()->picture->number > number);
}

TEST_CASE("an error of one picture is over with the next") {
    Bench bench;
    std::atomic<bool> fails{true};
    bench.before_display = [&](float) {
        if (fails.exchange(false)) throw std::runtime_error("the display is gone");
    };
    Session& session = bench.begin();
    REQUIRE(comes([&] { return !session.shown()->error.empty(); }));
    CHECK(session.shown()->error == "phasetree: the display is gone");
    session.change(camera_at("[3, 0, 0]"));
    REQUIRE(bench.is_ready());
    CHECK(session.shown()->error.empty());
}

TEST_CASE("the scene is read at the time that is wished, and again at that when it is saved") {
    Bench bench;
    Session& session = bench.begin();
    REQUIRE(bench.is_ready());
    CHECK(session.shown()->seconds == 0.5);
    REQUIRE(session.shown()->keys);
    CHECK(session.shown()->keys->first == -1);
    CHECK(session.shown()->keys->last == 3);
    const int before = bench.readings;
    const std::uint64_t number = session.shown()->picture->number;
    Change change;
    change.seconds = 2.25;
    session.change(change);
    CHECK(session.shown()->seconds == 2.25);
    REQUIRE(bench.is_ready());
    CHECK(bench.readings == before + 1);
    CHECK(session.shown()->picture->number > number);
    bench.save();
    REQUIRE(bench.is_seen());
    REQUIRE(bench.is_ready());
    CHECK(session.shown()->seconds == 2.25);
}

TEST_CASE("a camera that is wished while a file with another is read stays") {
    Bench bench;
    Session& session = bench.begin();
    REQUIRE(bench.is_ready());
    session.change(camera_at("[1, -3, 0]"));
    REQUIRE(bench.is_ready());
    bench.position = "[0, -4, 0]";
    bench.holds_reading = true;
    bench.save();
    REQUIRE(bench.is_seen());
    session.change(camera_at("[3, 0, 0]"));
    bench.release();
    const auto is_there = [&](const char* position) {
        return comes([&] {
            const auto shown = session.shown();
            return shown->doing == "Ready" && shown->camera_text.find(position) != std::string::npos;
        });
    };
    CHECK(is_there("[3, 0, 0]"));

    // One that was wished before gives way to that of the file.
    bench.position = "[0, -5, 0]";
    bench.save();
    REQUIRE(bench.is_seen());
    CHECK(is_there("[0, -5, 0]"));
}

TEST_CASE("what changes nothing of the object keeps its cells, and the picture is right all the same") {
    Bench bench;
    Session& session = bench.begin();
    REQUIRE(bench.is_ready());
    const auto cells = [&] { return session.shown()->picture->prepared->world().geometry().objects().front().get(); };
    const InterfaceCells* const first = cells();
    const auto pixels = session.shown()->picture->pixels;

    Change change;
    change.looks = {{"wood", {.color = glm::vec3(0.1f, 0.2f, 0.8f)}}};
    session.change(change);
    REQUIRE(bench.is_ready());
    CHECK(cells() == first);
    CHECK_FALSE(session.shown()->picture->prepared->is_first_look());
    CHECK(session.shown()->picture->pixels != pixels);
    bench.position = "[0, -4, 0]";
    bench.save();
    REQUIRE(bench.is_seen());
    REQUIRE(bench.is_ready());
    CHECK(cells() == first);

    // What is clear has rays within, so other cells are needed; a cut makes another object.
    change.looks = {{"wood", {.is_clear = true}}};
    session.change(change);
    REQUIRE(bench.is_ready());
    const InterfaceCells* const clear = cells();
    CHECK(clear != first);
    change.looks.reset();
    change.has_cut = true;
    change.cut = CutPlane{{0, 0, 1}, 0.125f};
    session.change(change);
    REQUIRE(bench.is_ready());
    CHECK(cells() != clear);
}

TEST_CASE("cells that are known are taken for the object that they are of and for no other") {
    const Scene scene = scene_with_camera("[0, -3, 0]");
    const World first(scene);
    const auto& known = first.geometry().objects().front();
    CHECK(World(scene, {.known_cells = known}).geometry().objects().front() == known);
    CHECK(World(scene, {.quality = BuildQuality::low, .known_cells = known}).geometry().objects().front() != known);
    CHECK(World(scene, {.is_first_look = true, .known_cells = known}).geometry().objects().front() != known);
    Scene clear = scene;
    clear.materials[1] = Clear{.ior = 1.5f};
    CHECK(World(clear, {.known_cells = known}).geometry().objects().front() != known);
}

TEST_CASE("the whole picture is the one that is rendered, photons and all, though coarser ones go without") {
    Bench bench;
    // Of more pixels than the first picture has.
    bench.scene_with = [](const std::string& position) {
        return read_scene(Document::from_text(fmt::format(
            R"({{"version": 1, "phases": {{"glass": {{"clear": {{"ior": 1.5}}}},
                                           "floor": {{"diffuse": {{"color": [0.8, 0.8, 0.8]}}}}}},
                 "tree": {{"over": {{"of": [
                     {{"set": {{"phase": "glass", "of": {{"sphere": {{"radius": 0.5}}}}}}}},
                     {{"translate": {{"by": [0, 0, -0.9], "of":
                         {{"set": {{"phase": "floor", "of": {{"box": {{"size": [4, 4, 0.2]}}}}}}}}}}}}]}}}},
                 "lights": [{{"sun": {{"direction": [0.3, 0.2, 1], "irradiance": [9, 9, 9]}}}}],
                 "camera": {{"position": {}, "look_at": [0, 0, -0.5]}},
                 "render": {{"width": 120, "height": 80, "samples": 1, "caustics": true}}}})",
            position)));
    };
    Session& session = bench.begin();
    REQUIRE(bench.is_ready());
    const Image shown = session.shown()->picture->linear;
    const auto rendered = [&](bool has_photons) {
        Scene scene = bench.scene_with(bench.position);
        scene.settings.caustics = has_photons;
        RenderJob job;
        job.pixels = scene.film.whole();
        return render(World(scene), scene, job).image.pixels;
    };
    CHECK(shown.pixels == rendered(true));
    CHECK(shown.pixels != rendered(false));
}

TEST_CASE("a camera that is wished is told at once and by whatever is shown from then on") {
    Bench bench;
    Session& session = bench.begin();
    REQUIRE(bench.is_ready());
    std::atomic<bool> is_held{false}, is_released{false};
    bench.before_display = [&](float) {
        is_held = true;
        (void)comes([&] { return is_released.load(); });
    };
    session.change(camera_at("[1, -3, 0]"));
    // Another change arrives before its picture is shown, so the picture is reported with the newer one.
    REQUIRE(comes([&] { return is_held.load(); }));
    const std::uint64_t version = session.change(camera_at("[2, -3, 0]"));
    CHECK(session.shown()->version == version);
    CHECK(session.shown()->camera_text.find("[2, -3, 0]") != std::string::npos);
    CHECK(session.shown()->doing == "Rendering");
    is_released = true;
    const std::uint64_t before = session.shown()->picture->number;
    REQUIRE(comes([&] { return session.shown()->picture->number > before; }));
    CHECK(session.shown()->camera_text.find("[2, -3, 0]") != std::string::npos);
    Change back;
    back.has_camera = true;
    session.change(back);
    CHECK(session.shown()->camera_text.find("[0, -3, 0]") != std::string::npos);
    REQUIRE(bench.is_ready());
}

TEST_CASE("a camera is not written before there is one") {
    Bench bench;
    std::string written = "nothing";
    bench.write() = [&](const std::string& camera) { written = camera; };
    bench.holds_reading = true;
    Session& session = bench.begin();
    CHECK_THROWS_AS(session.write_camera(), ModelError);
    CHECK(written == "nothing");
    bench.release();
    REQUIRE(bench.is_ready());
    session.write_camera();
    CHECK(written.find("[0, -3, 0]") != std::string::npos);
}

}  // namespace test_session
