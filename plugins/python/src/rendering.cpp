// Pictures: the one place that binds to the path tracer's render, film and output.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>

#include "arrays.hpp"
#include "command/load.hpp"
#include "module.hpp"
#include "output/encode.hpp"
#include "output/write.hpp"
#include "render/render.hpp"
#include "render/threads.hpp"

namespace py = pybind11;

namespace phasetree::python {

namespace {

using namespace phasetree::tracer;

struct Wishes {
    std::optional<std::array<int, 4>> crop;
    int threads = 0;
    bool is_quick = false;
    std::size_t most_bytes = 0;
};

PixelRange pixels_of(const Scene& scene, const Wishes& wishes) {
    const PixelRange whole = scene.film.whole();
    if (!wishes.crop) return whole;
    const auto [x0, y0, x1, y1] = *wishes.crop;
    if (x0 < 0 || y0 < 0 || x1 > whole.x1 || y1 > whole.y1 || x0 >= x1 || y0 >= y1)
        throw ModelError(fmt::format("the crop {}, {}, {}, {} is not a part of the {}x{} image", x0, y0, x1, y1,
                                     whole.x1, whole.y1));
    return {x0, y0, x1, y1};
}

py::array_t<float> as_array(const Image& image) {
    py::array_t<float> result({image.height, image.width, 3});
    std::copy_n(&image.pixels.data()->x, 3 * image.pixels.size(), result.mutable_data());
    return result;
}

py::dict planes_of(const Image& image) {
    py::dict planes;
    for (const Channel& channel : image.further) {
        py::array_t<float> values({image.height, image.width});
        std::copy(channel.values.begin(), channel.values.end(), values.mutable_data());
        planes[py::str(channel.name)] = values;
    }
    return planes;
}

Rendering rendered(const Scene& scene, const Wishes& wishes, const std::function<bool()>& cancelled,
                   const Progress& progress) {
    const AvailableThreads threads(wishes.threads);
    const World world(scene, WorldOptions{.quality = wishes.is_quick ? BuildQuality::low : BuildQuality::medium,
                                          .cancelled = cancelled,
                                          .progress = [&](float share) { progress("preparing", share); },
                                          .most_bytes = wishes.most_bytes});
    RenderJob job;
    job.pixels = pixels_of(scene, wishes);
    job.threads = threads.count();
    job.cancelled = cancelled;
    const double all = static_cast<double>(job.pixels.width()) * job.pixels.height() * scene.settings.samples;
    std::atomic<std::uint64_t> done = 0;
    job.advance = [&](std::uint64_t n) {
        progress("rendering", static_cast<float>(static_cast<double>(done += n) / all));
    };
    return render(world, scene, job);
}

// The scene is read from its text as a file is, with all of the command's checks.
py::dict render_text(const std::string& text, const std::string& name, const Wishes& wishes, const py::object& tell) {
    Rendering result;
    run_beside(tell, [&](const std::function<bool()>& cancelled, const Progress& progress) {
        const Document document = Document::from_text(text, name);
        result = rendered(load_scene(document), wishes, cancelled, progress);
    });
    py::dict d;
    d["pixels"] = as_array(result.image);
    d["planes"] = planes_of(result.image);
    d["samples"] = result.samples;
    d["seconds"] = result.seconds;
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
            throw std::invalid_argument("a plane must have a value for each pixel");
        image.further.push_back({name.cast<std::string>(), {array.data(), array.data() + array.size()}});
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

void save(const std::string& path, const Pixels& pixels, const py::dict& planes, float exposure,
          const std::optional<std::string>& view, const std::string& scene, int samples, std::uint64_t seed) {
    const Image image = image_of(pixels, planes);
    const py::gil_scoped_release unlocked;
    write_image(image, path, {scene, samples, seed}, DisplayTransform({}, view, exposure));
}

}  // namespace

void add_rendering(py::module_& module) {
    module.def(
        "render",
        [](const std::string& text, const std::string& name, std::optional<std::array<int, 4>> crop, int threads,
           bool is_quick, std::size_t most_bytes, const py::object& tell) {
            return render_text(text, name, {crop, threads, is_quick, most_bytes}, tell);
        },
        py::arg("text"), py::arg("name"), py::arg("crop"), py::arg("threads"), py::arg("is_quick"),
        py::arg("most_bytes"), py::arg("tell"));
    module.def("png", &png, py::arg("pixels").noconvert(), py::arg("exposure"), py::arg("view"));
    module.def("save_image", &save, py::arg("path"), py::arg("pixels").noconvert(), py::arg("planes"),
               py::arg("exposure"), py::arg("view"), py::arg("scene"), py::arg("samples"), py::arg("seed"));
}

}  // namespace phasetree::python
