#include "page/page.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "page/text.hpp"

namespace phasetree::tracer {

namespace {

std::string base64(std::span<const unsigned char> bytes) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t word = 0;
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < count ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[word >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

// Compressed in a format that browsers can unpack, and encoded as text.
std::string packed(std::string_view bytes) {
    uLongf size = compressBound(bytes.size());
    std::vector<unsigned char> result(size);
    if (compress2(result.data(), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 9) != Z_OK)
        throw std::runtime_error("the page's data could not be compressed");
    return base64(std::span(result).first(size));
}
std::string packed(const std::vector<float>& numbers) {
    std::string bytes;
    for (const float v : numbers)
        for (int i = 0; i < 4; ++i) bytes += static_cast<char>(std::bit_cast<std::uint32_t>(v) >> (8 * i) & 255);
    return packed(bytes);
}

// A JavaScript string literal that is safe inside HTML.
std::string in_script(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\' || c == '<' || c == '>' || c == '&' || code < 32)
            result += fmt::format("\\x{:02x}", code);
        else
            result += c;
    }
    return result + "\"";
}
std::string in_html(std::string_view text) {
    std::string result;
    for (const char c : text) result += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
    return result;
}
std::string list(const glm::vec3& v) {
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}
std::string css_color(const Look& look) {
    const std::array<int, 3> c = shown_color(look);
    return fmt::format("\"rgb({},{},{})\"", c[0], c[1], c[2]);
}

}  // namespace

PageView view_of(const AnyCameraParameters& camera) {
    PageView view{position_of(camera), look_at_of(camera)};
    if (const auto* lens = std::get_if<ThinLensParameters>(&camera)) view.fov = lens->vertical_fov_degrees;
    return view;
}

std::string make_page(const std::string& title, const GlslShader& shader, const Bounds& bounds,
                      const std::vector<Look>& looks, const PageView& view, float floor) {
    const std::string fragment =
        "#version 300 es\nprecision highp float;\nprecision highp int;\nuniform highp uvec2 page_hidden;\n"
        "int page_shown(int phase) {\n"
        "    uint bits = phase < 32 ? page_hidden.x : page_hidden.y;\n"
        "    return (bits >> uint(phase & 31) & 1u) != 0u ? 0 : phase;\n}\n"
        "#define PHASETREE_SHOWN(phase) page_shown(phase)\n" +
        fmt::format("#define PAGE_PHASES {}\n", looks.size()) + shader.text + page::shading;
    std::string names, colors, values;
    for (const Look& l : looks) {
        names += in_script(l.name) + ", ";
        colors += css_color(l) + ", ";
        const glm::vec3& c = l.kind == Look::clear ? l.absorption : l.color;
        values += fmt::format("{}, {}, {}, {}, 0, 0, 0, {}, ", c.x, c.y, c.z, static_cast<int>(l.kind), l.ior);
    }
    const std::string data = fmt::format(
        "const data = {{low: {}, high: {}, position: {}, look_at: {}, fov: {}, floor: {}, names: [{}], colors: [{}], "
        "looks: [{}],\nshader: \"{}\",\nnumbers: \"{}\"}};\n",
        list(bounds.low), list(bounds.high), list(view.position), list(view.look_at), view.fov, floor, names, colors,
        values, packed(fragment), packed(shader.numbers));
    return page::head + in_html(title) + page::body + data + page::script;
}

}  // namespace phasetree::tracer
