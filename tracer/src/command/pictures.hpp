// Writing of results at the end of long renders: a failure to write one file does not affect the others.
#pragma once

#include <new>
#include <string>
#include <vector>

#include "command/option_error.hpp"
#include "command/streams.hpp"
#include "film/faults.hpp"
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
        all_is_well_ = false;
        return false;
    }
    bool all_is_well() const { return all_is_well_; }

  private:
    bool all_is_well_ = true;
};

// Checks that all outputs can be written before rendering starts. Throws OutputError and
// OptionError.
inline void check_outputs(const std::vector<std::string>& outputs) {
    for (const std::string& output : outputs) {
        if (is_film_file(output) && is_for_each_plane(output))
            throw OptionError("a .part has all planes in one file, so {plane} is not for it");
        is_film_file(output) ? check_file_writable(output) : check_writable(output);
    }
}

// Reports faults, which a valid scene never causes.
inline void say_faults(const FilmFaults& faults) {
    if (faults.not_finite > 0)
        say("phasetree: {} values of samples were not finite numbers and count as black; please report this scene\n",
            faults.not_finite);
    if (faults.too_large > 0)
        say("phasetree: {} values of samples were larger than 10^12 and are cut to that\n", faults.too_large);
}

}  // namespace phasetree::tracer
