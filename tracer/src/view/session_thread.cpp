// The thread of a session, which follows the desired state: it reads the scene's file, edits the scene, and builds its
// cells. The pictures are rendered in session_pictures.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "phasetree/cells/file.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree/model/preparation_watch.hpp"
#include "scene/camera_text.hpp"
#include "scene/meshes_alone.hpp"
#include "view/session.hpp"

namespace phasetree::tracer::view {

namespace {

// While a slider is dragged, each change arrives before the picture of the last one is complete. Its coarse cells are
// completed anyway, unless they take longer than this.
constexpr std::chrono::milliseconds first_cells_deadline{1000};
// Likewise for reading the scene.
constexpr std::chrono::milliseconds reading_deadline{1000};

// The message that a terminal would show.
std::string error_text(std::exception_ptr failure) {
    try {
        std::rethrow_exception(failure);
    } catch (const SceneError& e) {
        return e.what();
    } catch (const std::bad_alloc&) {
        return "phasetree: out of memory";
    } catch (const std::exception& e) {
        return fmt::format("phasetree: {}", e.what());
    }
}

std::vector<ShownPhase> shown_phases(const Scene& scene) {
    const float depth = half_diagonal(scene.object);
    std::vector<ShownPhase> phases;
    for (std::size_t i = 1; i < scene.phases.names.size(); ++i)
        phases.push_back({scene.phases.names[i], false, optics_of(scene.materials[i], depth), {}});
    return phases;
}

void set_width(FilmSettings& film, int width) {
    constexpr double highest = 32768;  // the same limit as in scene files
    film.height =
        static_cast<int>(std::clamp(std::round(static_cast<double>(width) * film.height / film.width), 1.0, highest));
    film.width = width;
}

}  // namespace

void Session::work() {
    std::uint64_t followed = 0;
    while (true) {
        DesiredState desired;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] { return stopped_ || desired_.number() != followed; });
            if (stopped_) return;
            desired = desired_;
        }
        followed = desired.number();
        try {
            follow(desired);
        } catch (const BuildCancelled&) {
            // A newer change has arrived; handle it in the next iteration.
        } catch (const PreparationCancelled&) {  // likewise
        } catch (...) {
            fail(error_text(std::current_exception()));
        }
    }
}

void Session::follow(DesiredState desired) {
    if (const TextNumber text{desired.reading, desired.text}; text != last_read_) {
        last_read_ = text;
        read(desired);
    }
    if (!viewed_) return stop_by_error();
    const ObjectNumber object{last_read_well_, desired.object};
    if (object != built_for_) {
        // Set this first, so that a failed build is not repeated until another object is wanted.
        built_for_ = object;
        build(desired);
    }
    const PictureNumber picture{object, desired.view};
    if (!prepared_) return stop_by_error();
    if (picture == finished_for_) return;
    if (draw(desired)) finished_for_ = picture;
}

// If the scene cannot be read, the previous one stays.
void Session::read(DesiredState& desired) {
    show([](Shown& shown) { shown.doing = "Reading the scene"; });
    const Clock::time_point begun = Clock::now();
    WatchedFiles files;
    std::shared_ptr<const ViewedScene> viewed;
    std::string error;
    try {
        const PreparationWatch watch({.cancelled =
                                          [&] {
                                              const bool is_over = Clock::now() - begun > reading_deadline;
                                              return is_of_another_reading(desired) ||
                                                     (is_over && is_of_another_text(desired));
                                          },
                                      .progress = {}});
        ViewedScene scene = read_(files, desired.read_as);
        if (options_.samples) scene.scene.settings.samples = *options_.samples;
        if (options_.width) set_width(scene.scene.film, *options_.width);
        viewed = std::make_shared<const ViewedScene>(std::move(scene));
    } catch (const PreparationCancelled&) {
        throw;
    } catch (...) {
        error = error_text(std::current_exception());
    }
    {
        const std::lock_guard lock(mutex_);
        files_ = std::move(files);
        is_to_be_read_ = false;
        if (viewed && desired_.read_as.hidden == desired.read_as.hidden) desired_.read_as.hidden = viewed->hidden;
        // Someone who edits the camera in the file wants to see that camera, not where the mouse has turned it.
        const auto text = [](const Scene& scene) { return camera_text(scene.camera, scene.film.filter); };
        // A camera that was requested meanwhile is newer, and stays.
        if (viewed && viewed_ && text(viewed->scene) != text(viewed_->scene)) {
            if (desired_.view == desired.view) desired_.camera.reset();
            desired.camera.reset();
        }
    }
    if (!viewed) return fail(error);
    viewed_ = std::move(viewed);
    last_read_well_ = last_read_;
    show([&](Shown& shown) {
        shown.numbers_of_file = {viewed_, &viewed_->numbers};
        shown.numbers_version = desired.reading + desired.document;
        shown.seconds = viewed_->seconds;
        shown.keys = viewed_->keys;
    });
}

void Session::build(const DesiredState& desired) {
    show([](Shown& shown) { shown.doing = "Building cells"; });
    const Clock::time_point begun = Clock::now();
    const auto cancelled = [&] {
        const bool is_over = Clock::now() - begun > first_cells_deadline;
        return is_of_another_reading(desired) || (is_over && is_of_another_object(desired));
    };
    // Building cells first records the object's program, which polls this watch.
    const PreparationWatch watch({.cancelled = cancelled, .progress = {}});
    WorldOptions options{.quality = options_.quality,
                         .is_first_look = true,
                         .cancelled = cancelled,
                         .max_bytes = options_.max_bytes,
                         .surfaces = surfaces_};
    std::shared_ptr<Scene> scene;
    try {
        scene = std::make_shared<Scene>(edited(viewed_->scene, desired.edits));
        keep_cells(*scene, options);
        surfaces_->begin_scene();
        prepared_ = std::make_shared<const Prepared>(scene, options);
    } catch (const BuildCancelled&) {
        built_for_ = {};
        throw;
    } catch (const PreparationCancelled&) {
        built_for_ = {};
        throw;
    } catch (...) {
        prepared_.reset();  // it belongs to another scene than viewed_, and its picture would be wrong
        throw;
    }
    scene_ = scene;
    const InterfaceCells& object = prepared_->world().geometry().object();
    std::string warning = viewed_->warnings;
    if (!object.warning().empty()) warning += fmt::format("{}: warning: {}\n", options_.name, object.warning());
    const bool is_of_meshes = has_meshes_alone(viewed_->scene);
    if (object.size() == 0 && !is_of_meshes)
        warning += fmt::format("{}: warning: the object is empty, so no ray hits it\n", options_.name);
    if (!warning.empty()) options_.tell(warning);
    warning_ = warning;
    show([&](Shown& shown) {
        camera_in_file_ = camera_text(viewed_->scene.camera, viewed_->scene.film.filter);
        filter_in_file_ = viewed_->scene.film.filter;
        shown.error.clear();
        shown.scene = options_.name;
        shown.resolution = scene->film.resolution();
        shown.samples = scene->settings.samples;
        shown.phases = shown_phases(viewed_->scene);
        shown.layers = layers_of_film(scene_names_of(viewed_->scene));
        // Hiding a part must not move the point that the camera turns around.
        const Bounds bounds =
            is_of_meshes ? bounds_of(viewed_->scene.meshes) : phasetree::bounds(viewed_->scene.object);
        if (bounds.empty() || !bounds.finite()) return;
        shown.centre = bounds.centre();
        shown.radius = 0.5f * bounds.diagonal();
    });
}

// Keeps the existing cells if only materials or the camera differ.
void Session::keep_cells(const Scene& scene, WorldOptions& options) const {
    if (!prepared_) return;
    options.known_cells = prepared_->world().geometry().objects().front();
    WorldOptions better = options;
    better.is_first_look = false;
    if (are_cells_of(*options.known_cells, scene.object, cell_options(scene, better))) options = better;
}

void Session::fail(const std::string& error) {
    options_.tell(error + "\n");
    show([&](Shown& shown) { shown.error = error; });
    stop_by_error();
}

void Session::stop_by_error() {
    show([](Shown& shown) { shown.doing = "Stopped by an error"; });
}

}  // namespace phasetree::tracer::view
