// Writing of results at the end of long renders: a failure to write one file does not affect the others.
#pragma once

#include <fmt/format.h>

#include <new>
#include <span>
#include <string>
#include <vector>

#include "command/errors.hpp"
#include "command/streams.hpp"
#include "film/faults.hpp"
#include "film/film.hpp"
#include "film_file/write.hpp"
#include "output/file.hpp"
#include "output/write.hpp"

namespace phasetree::tracer {

// Calls a function that writes a file, and reports failures.
class Writing {
  public:
    template <class Write>
    bool operator()(Write&& write) {
        try {
            write();
            return true;
        } catch (const std::bad_alloc&) {
            say("phasetree: out of memory\n");
        } catch (const std::exception& e) {
            say("phasetree: {}\n", e.what());
        }
        has_succeeded_ = false;
        return false;
    }
    bool has_succeeded() const { return has_succeeded_; }

  private:
    bool has_succeeded_ = true;
};

// The layers of a picture with these planes, each of which "{plane}" writes to a file of its own.
inline std::vector<std::string> layers_of_picture(const FilmSettings& film, const SceneNames& scene_names,
                                                  bool is_denoised) {
    Image pixel = FilmTile({0, 0, 1, 1}, film.planes, scene_names).image(film);
    if (is_denoised) pixel.extra_channels.push_back({"noisy.R", {0.0f}});
    return layer_names(pixel);
}

// Checks before rendering starts that all outputs can be written, with the files of these layers. Throws OutputError.
inline void check_outputs(const std::vector<std::string>& outputs, std::span<const std::string> layers = {}) {
    for (const std::string& output : outputs) {
        if (is_film_file(output) && is_for_each_plane(output))
            throw OutputNameError(
                fmt::format("cannot write \"{}\": {{plane}} requires an .exr file; a .part holds all planes", output));
        is_film_file(output) ? check_file_writable(output) : check_writable(output, layers);
    }
}

// Reports invalid samples, which a valid scene never produces.
inline void say_faults(const FilmFaults& faults) {
    if (faults.not_finite > 0)
        say("phasetree: {} sample values were not finite and count as black; this is a bug; please report it with the "
            "scene\n",
            faults.not_finite);
    if (faults.too_large > 0) say("phasetree: {} sample values above 10^12 were clamped\n", faults.too_large);
}

}  // namespace phasetree::tracer
