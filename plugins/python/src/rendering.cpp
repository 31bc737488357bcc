// Rendering: the only file that binds the path tracer's render, film and output.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <chrono>

#include "arrays.hpp"
#include "command/load.hpp"
#include "command/render_options.hpp"
#include "denoise/apply.hpp"
#include "film/chosen_planes.hpp"
#include "module.hpp"
#include "output/encode.hpp"
#include "output/write.hpp"
#include "render/render.hpp"
#include "render/threads.hpp"

namespace py = pybind11;

namespace phasetree::python {

namespace {

using namespace phasetree::tracer;

using Clock = std::chrono::steady_clock;

struct RenderRequest {
    std::optional<std::array<int, 4>> crop;
    int threads = 0;
    bool is_quick = false;
    std::size_t max_bytes = 0;
    std::vector<std::string> planes;
    std::optional<std::string> denoise;
    double seconds_at = 0;    // the time at which the scene is read
    double time_seconds = 0;  // time limit; 0 for none
    std::optional<int> samples;
};

struct Rendered {
    Rendering rendering;
    std::optional<std::string> is_noisy_because;
};

PixelRange pixels_of(const Scene& scene, const RenderRequest& request) {
    const PixelRange whole = scene.film.whole();
    if (!request.crop) return whole;
    const auto [x0, y0, x1, y1] = *request.crop;
    if (x0 < 0 || y0 < 0 || x1 > whole.x1 || y1 > whole.y1 || x0 >= x1 || y0 >= y1)
        throw ModelError(
            fmt::format("crop {}, {}, {}, {}: the region must not be empty and must lie within the {}x{} picture", x0,
                        y0, x1, y1, whole.x1, whole.y1));
    return {x0, y0, x1, y1};
}

py::array_t<float> as_array(const Image& image) {
    py::array_t<float> result({image.height, image.width, 3});
    std::copy_n(&image.pixels.data()->x, 3 * image.pixels.size(), result.mutable_data());
    return result;
}

py::dict planes_of(const Image& image) {
    py::dict planes;
    for (const Channel& channel : image.extra_channels) {
        py::array_t<float> values({image.height, image.width});
        std::copy(channel.values.begin(), channel.values.end(), values.mutable_data());
        planes[py::str(channel.name)] = values;
    }
    return planes;
}

// The metadata in the header of a picture's file.
py::dict attributes_of(const Image& image) {
    py::dict attributes;
    for (const auto& [name, text] : image.attributes) attributes[py::str(name)] = text;
    return attributes;
}

py::object crop_of(const Image& image) {
    if (!image.crop) return py::none();
    const Crop& c = *image.crop;
    return py::make_tuple(c.x0, c.y0, c.display_width, c.display_height);
}

// Applies the request as the command applies its options. Throws ModelError if it is impossible.
void apply(const RenderRequest& request, Scene& scene) {
    RenderOptions options;
    options.time_seconds = request.time_seconds;
    options.samples_in_all = request.samples;
    apply(options, scene);
    try {
        scene.film.planes = chosen_planes(request.planes);
        if (!request.denoise) return;
        (void)denoiser_named(*request.denoise);
        check_samples_to_denoise(scene.settings.samples);
    } catch (const std::invalid_argument& e) {
        throw ModelError(fmt::format("planes: {}", e.what()));
    } catch (const DenoiseError& e) {
        throw ModelError(fmt::format("denoise: {}", e.what()));
    }
}

Rendering sampled(const Scene& scene, const RenderRequest& request, const std::optional<Clock::time_point>& deadline,
                  const std::function<bool()>& cancelled, const Progress& progress) {
    const AvailableThreads threads(request.threads);
    const World world(scene, WorldOptions{.quality = request.is_quick ? BuildQuality::low : BuildQuality::medium,
                                          .cancelled = cancelled,
                                          .progress = [&](float share) { progress("preparing", share); },
                                          .max_bytes = request.max_bytes});
    RenderJob job;
    job.pixels = pixels_of(scene, request);
    job.threads = threads.count();
    job.deadline = deadline;
    job.cancelled = cancelled;
    const double all = static_cast<double>(job.pixels.width()) * job.pixels.height() * scene.settings.samples;
    std::atomic<std::uint64_t> done = 0;
    job.learned = [&](double share) { progress("learning where light comes from", static_cast<float>(share)); };
    job.advance = [&](std::uint64_t n) {
        const double of_samples = static_cast<double>(done += n) / all;
        const std::chrono::duration<double> left = deadline ? *deadline - Clock::now() : Clock::duration();
        const double of_time = deadline ? std::clamp(1 - left.count() / request.time_seconds, 0.0, 1.0) : 0.0;
        progress("rendering", static_cast<float>(std::max(of_samples, of_time)));
    };
    return render(world, scene, job);
}

Rendered rendered(Scene scene, const RenderRequest& request, const std::optional<Clock::time_point>& deadline,
                  const std::function<bool()>& cancelled, const Progress& progress) {
    apply(request, scene);
    const Planes::Choice wanted = film_settings(scene).planes;
    if (request.denoise) scene.film.planes |= denoising_planes();
    Rendered result{sampled(scene, request, deadline, cancelled, progress), std::nullopt};
    if (!request.denoise || cancelled()) return result;
    try {
        DenoiseJob job;
        job.by = denoiser_named(*request.denoise);
        job.threads = result.rendering.threads;
        job.progress = [&](double share) { progress("denoising", static_cast<float>(share)); };
        job.cancelled = cancelled;
        denoise_in_place(result.rendering.image, job);
    } catch (const DenoiseError& e) {  // the picture is still usable
        result.is_noisy_because = e.what();
    }
    leave_out(result.rendering.image, film_settings(scene).planes, wanted, scene_names_of(scene));
    return result;
}

// Reads the scene from its text, with all of the command's checks for a file, and renders it.
py::dict render_text(const std::string& text, const std::string& name, const RenderRequest& request,
                     const py::object& tell) {
    std::optional<Clock::time_point> deadline;
    if (request.time_seconds > 0)
        deadline = Clock::now() +
                   std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(request.time_seconds));
    Rendered result;
    run_beside(tell, [&](const std::function<bool()>& cancelled, const Progress& progress) {
        const Document document = Document::from_text(text, name).at(request.seconds_at);
        result = rendered(load_scene(document), request, deadline, cancelled, progress);
    });
    const Image& image = result.rendering.image;
    py::dict d;
    d["pixels"] = as_array(image);
    d["planes"] = planes_of(image);
    d["attributes"] = attributes_of(image);
    d["crop"] = crop_of(image);
    d["samples"] = result.rendering.samples;
    d["seconds"] = result.rendering.seconds;
    d["is_noisy_because"] = result.is_noisy_because;
    return d;
}

Image image_of(const py::array_t<float>& pixels, const py::dict& planes) {
    if (pixels.ndim() != 3 || pixels.shape(2) != 3) throw std::invalid_argument("pixels must have the shape (H, W, 3)");
    Image image;
    image.height = static_cast<int>(pixels.shape(0));
    image.width = static_cast<int>(pixels.shape(1));
    image.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    std::copy_n(pixels.data(), 3 * image.pixels.size(), &image.pixels.data()->x);
    for (const auto& [name, values] : planes) {
        const auto array = py::cast<py::array_t<float, py::array::c_style | py::array::forcecast>>(values);
        if (static_cast<std::size_t>(array.size()) != image.pixels.size())
            throw std::invalid_argument("a plane must have one value per pixel");
        image.extra_channels.push_back({name.cast<std::string>(), {array.data(), array.data() + array.size()}});
    }
    return image;
}

using Pixels = py::array_t<float, py::array::c_style>;

py::bytes png(const Pixels& pixels, float exposure, const std::optional<std::string>& view) {
    const Image image = image_of(pixels, {});
    std::vector<unsigned char> bytes;
    {
        const py::gil_scoped_release unlocked;
        bytes = encode(image, Format::png, {}, DisplayTransform({}, view, exposure));
    }
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void save(const std::string& path, const Pixels& pixels, const py::dict& planes,
          const std::vector<std::pair<std::string, std::string>>& attributes,
          const std::optional<std::array<int, 4>>& crop, float exposure, const std::optional<std::string>& view,
          const Metadata& metadata) {
    Image image = image_of(pixels, planes);
    image.attributes = attributes;
    if (crop) {
        const auto [x0, y0, width, height] = *crop;
        if (x0 < 0 || y0 < 0 || x0 > width - image.width || y0 > height - image.height)
            throw std::invalid_argument("crop must be x0, y0, and the size of the picture that contains the pixels");
        image.crop = Crop{x0, y0, width, height};
    }
    const py::gil_scoped_release unlocked;
    std::optional<DisplayTransform> display;
    if (needs_display(path)) display.emplace(std::nullopt, view, exposure);
    write_image(image, path, metadata, display);
}

}  // namespace

void add_rendering(py::module_& module) {
    py::class_<RenderRequest>(module, "RenderRequest")
        .def(py::init())
        .def_readwrite("crop", &RenderRequest::crop)
        .def_readwrite("threads", &RenderRequest::threads)
        .def_readwrite("is_quick", &RenderRequest::is_quick)
        .def_readwrite("max_bytes", &RenderRequest::max_bytes)
        .def_readwrite("planes", &RenderRequest::planes)
        .def_readwrite("denoise", &RenderRequest::denoise)
        .def_readwrite("seconds_at", &RenderRequest::seconds_at)
        .def_readwrite("time_seconds", &RenderRequest::time_seconds)
        .def_readwrite("samples", &RenderRequest::samples);
    module.def("render", &render_text, py::arg("text"), py::arg("name"), py::arg("request"), py::arg("tell"));
    module.def("png", &png, py::arg("pixels").noconvert(), py::arg("exposure"), py::arg("view"));
    module.def(
        "save_image",
        [](const std::string& path, const Pixels& pixels, const py::dict& planes,
           const std::vector<std::pair<std::string, std::string>>& attributes,
           const std::optional<std::array<int, 4>>& crop, float exposure, const std::optional<std::string>& view,
           const std::string& scene, int samples, std::uint64_t seed) {
            save(path, pixels, planes, attributes, crop, exposure, view, {scene, samples, seed});
        },
        py::arg("path"), py::arg("pixels").noconvert(), py::arg("planes"), py::arg("attributes"), py::arg("crop"),
        py::arg("exposure"), py::arg("view"), py::arg("scene"), py::arg("samples"), py::arg("seed"));
}

}  // namespace phasetree::python
