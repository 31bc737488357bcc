#include <fmt/format.h>
#include <hb-ot.h>
#include <hb.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/vec2.hpp>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "text/pen.hpp"
#include "text/read_text.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::uintmax_t most_bytes_of_font = std::uintmax_t{64} << 20;
constexpr std::size_t most_bytes_of_text = 10'000;
// HarfBuzz computes in integers, so coordinates are scaled: outlines of a variable font lie between the points of its
// grid.
constexpr int parts_of_unit = 16;
constexpr float farthest_of_letter = 1000;  // in ems; no letter is that large

template <auto destroy>
struct Destroy {
    template <class T>
    void operator()(T* p) const {
        destroy(p);
    }
};
using Blob = std::unique_ptr<hb_blob_t, Destroy<hb_blob_destroy>>;
using Face = std::unique_ptr<hb_face_t, Destroy<hb_face_destroy>>;
using Font = std::unique_ptr<hb_font_t, Destroy<hb_font_destroy>>;
using Buffer = std::unique_ptr<hb_buffer_t, Destroy<hb_buffer_destroy>>;
using DrawFunctions = std::unique_ptr<hb_draw_funcs_t, Destroy<hb_draw_funcs_destroy>>;

std::string content_of(const std::filesystem::path& path) {
    if (!std::filesystem::exists(path)) throw std::runtime_error("no such file");
    if (!std::filesystem::is_regular_file(path)) throw std::runtime_error("it is not a regular file");
    if (std::filesystem::file_size(path) > most_bytes_of_font) throw std::runtime_error("it is larger than 64 MB");
    std::ifstream in(path, std::ios::binary);
    std::string content{std::istreambuf_iterator<char>(in), {}};
    if (!in.is_open() || in.bad()) throw std::runtime_error("it cannot be read");
    return content;
}

// The functions that HarfBuzz calls for each point of a letter, with the pen as user data.
DrawFunctions functions_of_pen() {
    DrawFunctions functions(hb_draw_funcs_create());
    hb_draw_funcs_set_move_to_func(
        functions.get(),
        [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, float x, float y, void*) {
            static_cast<Pen*>(data)->move_to({x, y});
        },
        nullptr, nullptr);
    hb_draw_funcs_set_line_to_func(
        functions.get(),
        [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, float x, float y, void*) {
            static_cast<Pen*>(data)->line_to({x, y});
        },
        nullptr, nullptr);
    hb_draw_funcs_set_quadratic_to_func(
        functions.get(),
        [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, float cx, float cy, float x, float y, void*) {
            static_cast<Pen*>(data)->quadratic_to({cx, cy}, {x, y});
        },
        nullptr, nullptr);
    hb_draw_funcs_set_cubic_to_func(
        functions.get(),
        [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, float ax, float ay, float bx, float by, float x, float y,
           void*) {
            static_cast<Pen*>(data)->cubic_to({ax, ay}, {bx, by}, {x, y});
        },
        nullptr, nullptr);
    hb_draw_funcs_set_close_path_func(
        functions.get(),
        [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, void*) { static_cast<Pen*>(data)->close(); }, nullptr,
        nullptr);
    return functions;
}

// The UTF-8 bytes of the letter that begins at `start`.
std::string letter_at(std::string_view text, std::size_t start) {
    std::size_t end = start + 1;
    while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) ++end;
    return std::string(text.substr(start, end - start));
}

class Typesetter {
  public:
    explicit Typesetter(const std::string& content)
        : blob_(hb_blob_create(content.data(), static_cast<unsigned>(content.size()), HB_MEMORY_MODE_READONLY, nullptr,
                               nullptr)),
          face_(hb_face_create(blob_.get(), 0)),
          font_(hb_font_create(face_.get())),
          draw_(functions_of_pen()) {
        if (hb_face_get_glyph_count(face_.get()) == 0)
            throw std::runtime_error("it is not a TrueType or OpenType font (.ttf, .otf)");
        const int scale = static_cast<int>(hb_face_get_upem(face_.get())) * parts_of_unit;
        hb_font_set_scale(font_.get(), scale, scale);
        ems_ = 1.0f / static_cast<float>(scale);
    }

    TextOutlines::Line line(std::string_view text) const {
        TextOutlines::Line line;
        if (text.empty()) return line;
        const Buffer buffer(hb_buffer_create());
        const int bytes = static_cast<int>(text.size());
        hb_buffer_add_utf8(buffer.get(), text.data(), bytes, 0, bytes);
        // Sets no language, because that of the process would make the same text look different elsewhere.
        hb_buffer_set_language(buffer.get(), hb_language_from_string("und", -1));
        hb_buffer_guess_segment_properties(buffer.get());
        hb_shape(font_.get(), buffer.get(), nullptr, 0);
        unsigned count = 0;
        const hb_glyph_info_t* const infos = hb_buffer_get_glyph_infos(buffer.get(), &count);
        const hb_glyph_position_t* const positions = hb_buffer_get_glyph_positions(buffer.get(), &count);
        for (unsigned i = 0; i < count; ++i) {
            if (infos[i].codepoint == 0)
                throw std::runtime_error(fmt::format("it has no glyph for \"{}\"", letter_at(text, infos[i].cluster)));
            add(infos[i].codepoint, positions[i], line);
        }
        return line;
    }

  private:
    void add(hb_codepoint_t glyph, const hb_glyph_position_t& position, TextOutlines::Line& line) const {
        Pen pen(ems_, {ems_ * static_cast<float>(position.x_offset), ems_ * static_cast<float>(position.y_offset)});
#if HB_VERSION_ATLEAST(7, 0, 0)
        hb_font_draw_glyph(font_.get(), glyph, draw_.get(), &pen);
#else
        hb_font_get_glyph_shape(font_.get(), glyph, draw_.get(), &pen);
#endif
        pen.close();
        for (const TextOutlines::Contour& contour : pen.contours)
            for (const glm::vec2& p : contour)
                if (!(std::abs(p.x) < farthest_of_letter && std::abs(p.y) < farthest_of_letter))
                    throw std::runtime_error("one of its glyphs is larger than 1000 em");
        if (!pen.contours.empty()) line.letters.push_back({line.width, line.places, std::move(pen.contours)});
        line.width += ems_ * static_cast<float>(position.x_advance);
        // Accents do not occupy a place of their own.
        if (position.x_advance != 0) ++line.places;
    }

    Blob blob_;
    Face face_;
    Font font_;
    DrawFunctions draw_;
    float ems_ = 1;
};

}  // namespace

TextOutlines read_text(const std::filesystem::path& font, const std::string& text) {
    try {
        if (text.size() > most_bytes_of_text) throw std::runtime_error("the text is longer than 10,000 bytes");
        const std::string content = content_of(font);
        const Typesetter typesetter(content);
        TextOutlines outlines;
        const std::string_view all(text);
        for (std::size_t start = 0; start <= all.size();) {
            const std::size_t end = std::min(all.find('\n', start), all.size());
            std::string_view line = all.substr(start, end - start);
            if (line.ends_with('\r')) line.remove_suffix(1);  // for files whose lines end with \r\n
            outlines.lines.push_back(typesetter.line(line));
            start = end + 1;
        }
        return outlines;
    } catch (const std::runtime_error& e) {
        throw std::runtime_error(fmt::format("cannot use the font \"{}\": {}", font.string(), e.what()));
    }
}

bool can_read_fonts() {
    return true;
}

std::string harfbuzz_version() {
    return hb_version_string();
}

}  // namespace phasetree::tracer
