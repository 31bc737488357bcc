// Fonts, read as for the node `text`. A font is either rejected, or a text can be set in it and has distances.
#include <cmath>
#include <memory>
#include <stdexcept>

#include "fuzz/input_file.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/profiles/text.hpp"
#include "text/read_text.hpp"

namespace phasetree::fuzz {

void run_font(Bytes input) {
    static InputFile file("letters.ttf");
    const std::filesystem::path& path = file.write(input);
    try {
        Text text{.text = "IO X\nB"};
        text.file.content = std::make_shared<const TextOutlines>(tracer::read_text(path, text.text));
        const Field field(std::move(text));
        promised(bounds(field).low.x <= bounds(field).high.x, "a text has bounds");
        for (const glm::vec3 p : {glm::vec3(0), glm::vec3(0.1f, 0.35f, 0), glm::vec3(0.4f, -1, 2), glm::vec3(1e6f)})
            promised(std::isfinite(distance(field, p)), "a text has a distance everywhere");
    } catch (const std::runtime_error&) {
        // Also ModelError.
    }
}

}  // namespace phasetree::fuzz
