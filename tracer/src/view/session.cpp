#include "view/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "output/quantise.hpp"
#include "phasetree/cells/file.hpp"
#include "phasetree/io/error.hpp"
#include "scene/camera_text.hpp"

namespace phasetree::tracer::view {

namespace {

// While the camera is turned, or a slider is drawn, each wish comes before the picture of the last is there. A first
// coarse picture is finished all the same, until so long after it was begun, and so are its cells.
constexpr std::chrono::milliseconds first_picture_deadline{250};
constexpr std::chrono::milliseconds first_cells_deadline{1000};
// The first picture of an object is taken with cells that are not divided further: they are there at once, also where a
// tree is so slow that good ones take seconds, and a picture of few pixels has few rays.
constexpr int divisions_of_first_cells = 5;
// Pictures that follow each other faster than this are not shown one by one.
constexpr std::chrono::milliseconds between_pictures{100};

// What a terminal would show.
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

std::vector<std::uint8_t> on_display(const Picture& picture) {
    const DisplayTransform display = picture.viewed->display(picture.exposure_ev);
    std::vector<glm::vec3> pixels;
    if (picture.layer.empty()) {
        pixels = picture.linear.pixels;
        display.apply(pixels);
    } else {
        pixels = layer_on_display(picture.linear, picture.layer, display, picture.centre, picture.radius);
    }
    return quantise8(pixels, picture.linear.width, 0, 0);
}

// The film of a picture of which this layer is shown; the others are those that `render` keeps by itself.
Planes::Choice planes_with(const Scene& scene, const std::string& layer) {
    Planes::Choice planes = Planes::by_default();
    for (const FilmLayer& known : layers_of_film(subjects_of(scene)))
        if (known.name == layer) planes[known.plane] = true;
    return planes;
}

std::vector<ShownPhase> shown_phases(const Scene& scene) {
    const float depth = half_diagonal(scene.object);
    std::vector<ShownPhase> phases;
    for (std::size_t i = 1; i < scene.phases.names.size(); ++i)
        phases.push_back({scene.phases.names[i], false, optics_of(scene.materials[i], depth), {}});
    return phases;
}

// What the page's controls say must not go back to what was wished before.
void show_wishes(const Edits& edits, const NumberEdits& numbers, Shown& shown) {
    shown.cut = edits.cut;
    shown.numbers = numbers;
    for (ShownPhase& phase : shown.phases) {
        phase.is_hidden = std::ranges::find(edits.hidden, phase.name) != edits.hidden.end();
        const auto look = edits.looks.find(phase.name);
        phase.look = look == edits.looks.end() ? Look{} : look->second;
    }
}

void set_width(FilmSettings& film, int width) {
    constexpr double highest = 32768;  // Scene files have the same limit.
    film.height =
        static_cast<int>(std::clamp(std::round(static_cast<double>(width) * film.height / film.width), 1.0, highest));
    film.width = width;
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

template <class Edit>
void Session::show(Edit&& edit) {
    const std::lock_guard lock(mutex_);
    show_locked(edit);
}

template <class Edit>
void Session::show_locked(Edit&& edit) {
    auto next = std::make_shared<Shown>(*shown_);
    edit(*next);
    show_wishes(wishes_.edits, wishes_.numbers, *next);
    next->layer = wishes_.layer;
    next->camera_text = wishes_.camera ? camera_text(*wishes_.camera, filter_in_file_) : camera_in_file_;
    ++next->version;
    shown_ = std::move(next);
    changed_.notify_all();
}

std::shared_ptr<const Shown> Session::shown() const {
    const std::lock_guard lock(mutex_);
    return shown_;
}

std::shared_ptr<const Shown> Session::shown_after(std::uint64_t version, std::chrono::milliseconds most) const {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, most, [&] { return stopped_ || shown_->version > version; });
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
    // Others may have been wished for meanwhile.
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
        if (change.exposure_ev) wishes_.exposure_ev = change.exposure_ev;
        if (change.has_camera) wishes_.camera = change.camera;
        if (change.layer) wishes_.layer = *change.layer;
        if (change.has_camera || change.layer) ++wishes_.view;
        if (change.hidden) wishes_.edits.hidden = *change.hidden;
        if (change.looks) wishes_.edits.looks = *change.looks;
        if (change.has_cut) wishes_.edits.cut = change.cut;
        if (change.is_of_object()) ++wishes_.object;
        if (change.numbers) wishes_.numbers = *change.numbers;
        if (change.numbers) ++wishes_.text;
        if (change.has_camera || change.layer || change.is_of_object() || change.numbers) wishes_.since = Clock::now();
        announce_wishes();
        // Before the thread can have done it, or the page would be told of what is over.
        if (change.is_of_object()) show_locked([](Shown& shown) { shown.doing = "Building cells"; });
        if (change.numbers) show_locked([](Shown& shown) { shown.doing = "Reading the scene"; });
        if (change.has_camera || change.layer) show_locked([](Shown& shown) { shown.doing = "Taking the picture"; });
    }
    if (change.exposure_ev) expose();
    return shown()->version;
}

// A file is read when it has been the same at two looks, because some programs save in several steps.
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
    ++wishes_.reading;
    wishes_.since = Clock::now();
    announce_wishes();
}

void Session::announce_wishes() {
    number_ = wishes_.number();
    number_of_object_ = wishes_.number_of_object();
    number_of_reading_ = wishes_.reading;
    changed_.notify_all();
}

void Session::work() {
    std::uint64_t followed = 0;
    while (true) {
        Wishes wishes;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] { return stopped_ || wishes_.number() != followed; });
            if (stopped_) return;
            wishes = wishes_;
        }
        followed = wishes.number();
        try {
            follow(wishes);
        } catch (const BuildCancelled&) {
            // Another wish has come, which the next turn follows.
        } catch (...) {
            fail(error_text(std::current_exception()));
        }
    }
}

void Session::follow(Wishes wishes) {
    if (const TextNumber text{wishes.reading, wishes.text}; text != last_read_) {
        last_read_ = text;
        read(wishes);
    }
    if (!viewed_) return stop_by_error();
    const ObjectNumber object{last_read_well_, wishes.object};
    if (object != built_for_) {
        // Set first: what cannot be built is not tried again before another object is wished for.
        built_for_ = object;
        build(wishes);
    }
    const PictureNumber picture{object, wishes.view};
    if (!prepared_) return stop_by_error();
    if (picture == finished_for_) return;
    if (draw(wishes)) finished_for_ = picture;
}

// Where the scene cannot be read, the last one stays.
void Session::read(Wishes& wishes) {
    show([](Shown& shown) { shown.doing = "Reading the scene"; });
    WatchedFiles files;
    std::shared_ptr<const ViewedScene> viewed;
    std::string error;
    try {
        ViewedScene scene = read_(files, wishes.numbers);
        if (options_.samples) scene.scene.settings.samples = *options_.samples;
        if (options_.width) set_width(scene.scene.film, *options_.width);
        viewed = std::make_shared<const ViewedScene>(std::move(scene));
    } catch (...) {
        error = error_text(std::current_exception());
    }
    {
        const std::lock_guard lock(mutex_);
        files_ = std::move(files);
        is_to_be_read_ = false;
        // Who edits the camera in the file wants to see that, and not where the mouse has turned it.
        const auto text = [](const Scene& scene) { return camera_text(scene.camera, scene.film.filter); };
        // A camera that has been wished for meanwhile came later and stays.
        if (viewed && viewed_ && text(viewed->scene) != text(viewed_->scene)) {
            if (wishes_.view == wishes.view) wishes_.camera.reset();
            wishes.camera.reset();
        }
    }
    if (!viewed) return fail(error);
    viewed_ = std::move(viewed);
    last_read_well_ = last_read_;
    show([&](Shown& shown) {
        shown.numbers_of_file = {viewed_, &viewed_->numbers};
        shown.numbers_version = wishes.reading;
    });
}

void Session::build(const Wishes& wishes) {
    show([](Shown& shown) { shown.doing = "Building cells"; });
    const Clock::time_point begun = Clock::now();
    WorldOptions options{.quality = BuildQuality::low,
                         .deepest = divisions_of_first_cells,
                         .cancelled =
                             [&] {
                                 const bool is_over = Clock::now() - begun > first_cells_deadline;
                                 return is_of_another_reading(wishes) || (is_over && is_of_another_object(wishes));
                             },
                         .most_bytes = options_.most_bytes,
                         .surfaces = surfaces_};
    std::shared_ptr<Scene> scene;
    try {
        scene = std::make_shared<Scene>(edited(viewed_->scene, wishes.edits));
        keep_cells(*scene, options);
        surfaces_->begin_scene();
        prepared_ = std::make_shared<const Prepared>(scene, options);
    } catch (const BuildCancelled&) {
        built_for_ = {};
        throw;
    } catch (...) {
        prepared_.reset();  // It is of another scene than viewed_, and its picture would be wrong.
        throw;
    }
    scene_ = scene;
    const InterfaceCells& object = prepared_->world().geometry().object();
    std::string warning = object.warning();
    if (!warning.empty()) warning = fmt::format("{}: warning: {}\n", options_.name, warning);
    if (object.size() == 0)
        warning += fmt::format("{}: warning: the object is empty, so no ray meets it\n", options_.name);
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
        shown.layers = layers_of_film(subjects_of(viewed_->scene));
        // Hiding a part must not move what the camera turns around.
        const Bounds bounds = phasetree::bounds(viewed_->scene.object);
        if (bounds.empty() || !bounds.finite()) return;
        shown.centre = bounds.centre();
        shown.radius = 0.5f * bounds.diagonal();
    });
}

// What shows the same object, of other materials or from elsewhere, keeps the cells that there are.
void Session::keep_cells(const Scene& scene, WorldOptions& options) const {
    if (!prepared_) return;
    options.known_cells = prepared_->world().geometry().objects().front();
    WorldOptions better = options;
    better.quality = options_.quality;
    better.deepest.reset();
    if (are_cells_of(*options.known_cells, scene.object, cell_options(scene, better))) options = better;
}

// Returns whether the picture has all its samples.
bool Session::draw(const Wishes& wishes) {
    const Scene& file = viewed_->scene;
    drawing_since_ = Clock::now();
    scene_->camera = wishes.camera.value_or(file.camera);
    scene_->film.planes = planes_with(file, wishes.layer);
    show([&](Shown& shown) {
        // What went wrong with an earlier picture is over; that the file cannot be read is not.
        if (last_read_well_ == last_read_) shown.error.clear();
        shown.warning = warning_ + warning_of_camera();
        shown.doing = "Taking the picture";
    });
    for (const int scale : ladder_.scales(file.film.resolution()))
        if (scale > 1 && !draw_coarser(wishes, scale)) return false;
    if (prepared_->quality() != options_.quality) {
        // Where the whole picture is quick there is no coarser one, and something is to be seen before better cells
        // are.
        if (is_first_of(wishes) && !draw_whole(wishes, 1)) return false;
        show([](Shown& shown) { shown.doing = "Building better cells"; });
        surfaces_->begin_scene();
        prepared_ = std::make_shared<const Prepared>(scene_, WorldOptions{.quality = options_.quality,
                                                                          .cancelled = [&] { return is_stale(wishes); },
                                                                          .most_bytes = options_.most_bytes,
                                                                          .surfaces = surfaces_});
    }
    if (!draw_whole(wishes, file.settings.samples)) return false;
    show([&](Shown& shown) {
        if (!is_stale(wishes)) shown.doing = "Ready";
    });
    return true;
}

// Warns if the camera is inside an opaque phase, where it sees nothing.
std::string Session::warning_of_camera() const {
    const Phase phase = prepared_->world().geometry().label(position_of(scene_->camera));
    if (is_clear(scene_->materials[phase.index])) return {};
    return fmt::format("{}: warning: the camera is inside \"{}\", which is opaque\n", options_.name,
                       scene_->phases[phase]);
}

// Whether a picture is to be left unfinished, for later wishes.
bool Session::is_given_up(const Wishes& wishes, bool is_first) const {
    const bool is_over = !is_first || Clock::now() - drawing_since_ > first_picture_deadline;
    return is_of_another_reading(wishes) || (is_over && is_stale(wishes));
}

// Returns whether the picture was finished and is still wished for.
bool Session::draw_coarser(const Wishes& wishes, int scale) {
    const glm::ivec2 size = coarser(viewed_->scene.film.resolution(), scale);
    scene_->film.width = size.x;
    scene_->film.height = size.y;
    scene_->settings.samples = 1;
    const bool is_first = is_first_of(wishes);
    RenderJob job;
    job.pixels = scene_->film.whole();
    job.threads = options_.threads;
    job.cancelled = [&, is_first] { return is_given_up(wishes, is_first); };
    Rendering rendering = render(prepared_->world(), *scene_, job);
    if (rendering.cancelled) return false;
    ladder_.learn(rendering.image.pixels.size(), rendering.seconds);
    show_picture(wishes, std::move(rendering.image), scale, 1);
    return !is_stale(wishes);
}

bool Session::draw_whole(const Wishes& wishes, int samples) {
    scene_->film.width = viewed_->scene.film.width;
    scene_->film.height = viewed_->scene.film.height;
    scene_->settings.samples = samples;
    RenderJob job;
    job.pixels = scene_->film.whole();
    job.threads = options_.threads;
    job.cancelled = [&] { return is_given_up(wishes, is_first_of(wishes)); };
    Clock::time_point last;
    job.passed = [&](const Film& film, int done) {
        if (done < samples && Clock::now() - last < between_pictures) return;
        show_picture(wishes, film.image(), 1, done);
        show([&](Shown& shown) { shown.doing = fmt::format("{} of {} samples", done, shown.samples); });
        last = Clock::now();
    };
    Rendering rendering = render(prepared_->world(), *scene_, job);
    if (rendering.cancelled || is_stale(wishes)) return false;
    // Where pixels stop by their noise nobody knows before which pass is the last.
    if (scene_->settings.noise > 0) show_picture(wishes, std::move(rendering.image), 1, samples);
    return true;
}

void Session::show_picture(const Wishes& wishes, Image image, int scale, int samples) {
    auto picture = std::make_shared<Picture>();
    picture->linear = std::move(image);
    picture->scale = scale;
    picture->samples = samples;
    picture->camera = scene_->camera;
    picture->layer = wishes.layer;
    picture->viewed = viewed_;
    picture->prepared = prepared_;
    picture->exposure_ev = viewed_->scene.settings.exposure_ev;
    {
        const std::lock_guard lock(mutex_);
        picture->centre = shown_->centre;
        picture->radius = shown_->radius;
        picture->exposure_ev = wishes_.exposure_ev.value_or(picture->exposure_ev);
    }
    picture->pixels = on_display(*picture);
    const bool is_first = drawn_for_.exchange(wishes.number()) != wishes.number();
    const double seconds = std::chrono::duration<double>(Clock::now() - wishes.since).count();
    show([&](Shown& shown) {
        picture->number = shown.picture ? shown.picture->number + 1 : 1;
        shown.picture = picture;
        shown.exposure_ev = picture->exposure_ev;
        if (is_first) shown.seconds_to_picture = seconds;
    });
    expose();
}

// Shows the last picture with the exposure that is wished, if it has another. Meanwhile another picture may come, or
// another wish, so this is repeated until both agree.
void Session::expose() {
    while (true) {
        std::optional<float> wished;
        std::shared_ptr<const Picture> last;
        {
            const std::lock_guard lock(mutex_);
            wished = wishes_.exposure_ev;
            last = shown_->picture;
        }
        if (!wished || !last || last->exposure_ev == *wished) return;
        auto picture = std::make_shared<Picture>(*last);
        picture->exposure_ev = *wished;
        picture->pixels = on_display(*picture);
        show([&](Shown& shown) {
            if (shown.picture != last) return;
            ++picture->number;
            shown.picture = picture;
            shown.exposure_ev = *wished;
        });
    }
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
