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

// Compressed as browsers unpack it, and as text.
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

// A text in JavaScript, which also stands in HTML.
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
    // Of what is clear, how a tenth of a unit of it would look.
    const glm::vec3 c = look.kind == Look::clear ? glm::exp(-0.3f * look.absorption) : look.color;
    const auto byte = [](float v) { return static_cast<int>(255 * std::pow(std::clamp(v, 0.f, 1.f), 1 / 2.2f)); };
    return fmt::format("\"rgb({},{},{})\"", byte(c.x), byte(c.y), byte(c.z));
}

// The mean of a texture over places all through the bounds.
glm::vec3 mean(const Texture& texture, const Bounds& b) {
    constexpr int along = 5;
    glm::vec3 sum(0);
    for (int i = 0; i < along * along * along; ++i) {
        const glm::vec3 at(static_cast<float>(i % along), static_cast<float>(i / along % along),
                           static_cast<float>(i / along / along));
        sum += color_at(texture, b.low + (at + 0.37f) / static_cast<float>(along) * (b.high - b.low));
    }
    return sum / static_cast<float>(along * along * along);
}

// What a deep, matt-lit layer of a medium that scatters sends back: van de Hulst's fit to the half-space with the
// similarity s = √((1 − α)/(1 − αg)), of which α is the albedo (Multiple Light Scattering 2, 1980).
glm::vec3 reflectance(const ScatteringCoefficients& medium) {
    const glm::vec3 albedo = medium.scattering / glm::max(medium.extinction(), glm::vec3(1e-6f));
    const glm::vec3 s =
        glm::sqrt((1.f - albedo) / glm::max(1.f - albedo * medium.phase_function.g(), glm::vec3(1e-6f)));
    return (1.f - s) * (1.f - 0.139f * s) / (1.f + 1.17f * s);
}

// What metal reflects head-on.
glm::vec3 reflectance(const Conductor& c) {
    const glm::vec3 k2 = c.k * c.k, less = c.eta - 1.f, more = c.eta + 1.f;
    return (less * less + k2) / (more * more + k2);
}

// However strong a light is, its colour should be seen.
void show_light(const glm::vec3& light, Look& look) {
    look.kind = Look::glowing;
    look.color = light * std::min(1.f, 3.f / std::max({light.x, light.y, light.z, 1e-6f}));
}

// What is in a clear phase: a flame glows, and what scatters looks like a diffuse surface, but for what is so thin that
// most light passes half of the object.
void show(const Medium& interior, float half_size, Look& look) {
    constexpr float thin = 0.5f;
    look.absorption = extinction(interior);
    std::visit(
        [&](const auto& medium) {
            if constexpr (requires { medium.coefficients(); }) {
                const ScatteringCoefficients& c = medium.coefficients();
                const float scattered = std::max({c.scattering.x, c.scattering.y, c.scattering.z}) * half_size;
                if (shines(interior) && !c.scatters()) {
                    const glm::vec3 emission = light_of(c.emission, c.emission_spectrum, nullptr);
                    show_light(emission / glm::max(c.extinction(), glm::vec3(1e-6f)), look);
                } else if (scattered > thin) {
                    look.kind = Look::diffuse;
                    look.color = reflectance(c);
                }
            }
        },
        interior);
}

}  // namespace

Look look_of(const std::string& name, const Material& material, const Bounds& bounds) {
    Look look{name};
    std::visit(
        [&]<class Kind>(const Kind& m) {
            if constexpr (requires { m.interior; }) {
                look.ior = m.ior;
                show(m.interior, 0.5f * bounds.diagonal(), look);
            } else if constexpr (requires { m.eta; }) {
                look.kind = Look::metal;
                look.color = reflectance(m);
            } else if constexpr (requires { m.light; }) {
                show_light(m.radiance * light_of(mean(m.light, bounds), m.spectrum, nullptr), look);
            } else {
                look.kind = requires {
                    m.ior;
                }
                ? Look::coated : Look::diffuse;
                look.color = mean(m.color, bounds);
            }
        },
        material);
    return look;
}

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
