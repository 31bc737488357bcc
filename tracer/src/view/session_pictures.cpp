// Renders the pictures of a session: coarse ones with the first cells, then the whole one with better cells, pass by
// pass.
#include <fmt/format.h>

#include <utility>

#include "film/film.hpp"
#include "output/quantise.hpp"
#include "phasetree/model/preparation_watch.hpp"
#include "view/session.hpp"

namespace phasetree::tracer::view {

namespace {

// While the camera is rotated or a slider is dragged, each change arrives before the picture of the last one is
// complete. A first coarse picture is completed anyway, unless it takes longer than this.
constexpr std::chrono::milliseconds first_picture_deadline{250};
// Pictures that follow each other faster than this are not all shown.
constexpr std::chrono::milliseconds between_pictures{100};

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

// The planes of a film for showing this layer: its own, and those that `render` keeps by default.
Planes::Choice planes_with(const Scene& scene, const std::string& layer) {
    Planes::Choice planes = Planes::by_default();
    for (const FilmLayer& known : layers_of_film(scene_names_of(scene)))
        if (known.name == layer) planes[known.plane] = true;
    return planes;
}

}  // namespace

// Returns whether the picture has all its samples.
bool Session::draw(const DesiredState& desired) {
    const Scene& file = viewed_->scene;
    drawing_since_ = Clock::now();
    scene_->camera = desired.camera.value_or(file.camera);
    scene_->film.planes = planes_with(file, desired.layer);
    show([&](Shown& shown) {
        // Errors of an earlier picture are obsolete; an unreadable file is not.
        if (last_read_well_ == last_read_) shown.error.clear();
        shown.warning = warning_ + warning_of_camera();
        shown.doing = "Rendering";
    });
    const double elapsed = std::chrono::duration<double>(drawing_since_ - desired.since).count();
    for (const int scale : ladder_.scales(file.film.resolution(), elapsed))
        if (scale > 1 && !draw_coarser(desired, scale)) return false;
    if (prepared_->is_first_look()) {
        // If the scene is fast, the ladder had no coarser pictures, and nothing has been shown yet. Show something
        // before better cells are built.
        if (is_first_of(desired) && !draw_whole(desired, 1)) return false;
        show([](Shown& shown) { shown.doing = "Building better cells"; });
        surfaces_->begin_scene();
        const auto cancelled = [&] { return is_stale(desired); };
        const PreparationWatch watch({.cancelled = cancelled, .progress = {}});
        prepared_ = std::make_shared<const Prepared>(scene_, WorldOptions{.quality = options_.quality,
                                                                          .cancelled = cancelled,
                                                                          .max_bytes = options_.max_bytes,
                                                                          .surfaces = surfaces_});
    }
    if (!draw_whole(desired, file.settings.samples)) return false;
    show([&](Shown& shown) {
        if (!is_stale(desired)) shown.doing = "Ready";
    });
    return true;
}

// Returns a warning if the camera is inside an opaque phase, where it sees nothing.
std::string Session::warning_of_camera() const {
    const Phase phase = prepared_->world().geometry().label(position_of(scene_->camera));
    if (is_clear(scene_->materials[phase.index])) return {};
    return fmt::format("{}: warning: the camera is inside the phase \"{}\", which is opaque\n", options_.name,
                       scene_->phases[phase]);
}

// Whether to abandon a picture in favour of a later change.
bool Session::is_given_up(const DesiredState& desired, bool is_first) const {
    const bool is_over = !is_first || Clock::now() - drawing_since_ > first_picture_deadline;
    return is_of_another_reading(desired) || (is_over && is_stale(desired));
}

// Returns whether the picture was completed and is still wanted.
bool Session::draw_coarser(const DesiredState& desired, int scale) {
    const glm::ivec2 size = coarser(viewed_->scene.film.resolution(), scale);
    scene_->film.width = size.x;
    scene_->film.height = size.y;
    scene_->settings.samples = 1;
    // Photons and guiding would take longer than the whole coarse picture, because they would start learning from
    // scratch.
    scene_->settings.caustics = scene_->settings.guiding = false;
    const bool is_first = is_first_of(desired);
    RenderJob job;
    job.pixels = scene_->film.whole();
    job.threads = options_.threads;
    job.cancelled = [&, is_first] { return is_given_up(desired, is_first); };
    Rendering rendering = render(prepared_->world(), *scene_, job);
    if (rendering.cancelled) return false;
    ladder_.learn(rendering.image.pixels.size(), rendering.seconds);
    show_picture(desired, std::move(rendering.image), scale, 1);
    return !is_stale(desired);
}

bool Session::draw_whole(const DesiredState& desired, int samples) {
    scene_->film.width = viewed_->scene.film.width;
    scene_->film.height = viewed_->scene.film.height;
    scene_->settings.samples = samples;
    scene_->settings.caustics = viewed_->scene.settings.caustics;
    scene_->settings.guiding = viewed_->scene.settings.guiding;
    RenderJob job;
    job.pixels = scene_->film.whole();
    job.threads = options_.threads;
    job.cancelled = [&] { return is_given_up(desired, is_first_of(desired)); };
    Clock::time_point last;
    job.passed = [&](const Film& film, int done) {
        if (done < samples && Clock::now() - last < between_pictures) return;
        show_picture(desired, film.image(), 1, done);
        show([&](Shown& shown) { shown.doing = fmt::format("{} of {} samples", done, shown.samples); });
        last = Clock::now();
    };
    Rendering rendering = render(prepared_->world(), *scene_, job);
    if (rendering.cancelled || is_stale(desired)) return false;
    // If pixels stop by their noise, it is not known in advance which pass is the last.
    if (scene_->settings.noise > 0) show_picture(desired, std::move(rendering.image), 1, samples);
    return true;
}

void Session::show_picture(const DesiredState& desired, Image image, int scale, int samples) {
    auto picture = std::make_shared<Picture>();
    picture->linear = std::move(image);
    picture->scale = scale;
    picture->samples = samples;
    picture->camera = scene_->camera;
    picture->layer = desired.layer;
    picture->viewed = viewed_;
    picture->prepared = prepared_;
    picture->exposure_ev = viewed_->scene.settings.exposure_ev;
    {
        const std::lock_guard lock(mutex_);
        picture->centre = shown_->centre;
        picture->radius = shown_->radius;
        picture->exposure_ev = desired_.exposure_ev.value_or(picture->exposure_ev);
    }
    picture->pixels = on_display(*picture);
    const bool is_first = drawn_for_.exchange(desired.number()) != desired.number();
    const double seconds = std::chrono::duration<double>(Clock::now() - desired.since).count();
    show([&](Shown& shown) {
        picture->number = shown.picture ? shown.picture->number + 1 : 1;
        shown.picture = picture;
        shown.exposure_ev = picture->exposure_ev;
        if (is_first) shown.seconds_to_picture = seconds;
    });
    expose();
}

// Shows the last picture with the current exposure, if it differs. The picture or the exposure may change meanwhile, so
// this is repeated until both agree.
void Session::expose() {
    while (true) {
        std::optional<float> desired;
        std::shared_ptr<const Picture> last;
        {
            const std::lock_guard lock(mutex_);
            desired = desired_.exposure_ev;
            last = shown_->picture;
        }
        if (!desired || !last || last->exposure_ev == *desired) return;
        auto picture = std::make_shared<Picture>(*last);
        picture->exposure_ev = *desired;
        picture->pixels = on_display(*picture);
        show([&](Shown& shown) {
            if (shown.picture != last) return;
            ++picture->number;
            shown.picture = picture;
            shown.exposure_ev = *desired;
        });
    }
}

}  // namespace phasetree::tracer::view
