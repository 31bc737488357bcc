#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "command/slice_picture.hpp"
#include "phasetree_support/power_of_ten.hpp"

namespace phasetree::tracer {

namespace {

// In pixels.
constexpr double longest_drawn_side = 760, page_margin = 20, legend_row = 22, least_page_width = 320, line_width = 0.6;

// Text between tags. XML 1.0 allows no control characters.
std::string xml_text(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '"')
            result += "&quot;";
        else
            result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
    }
    return result;
}

std::string hex_color(const std::array<int, 3>& color) {
    return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

// The loops of a phase as the data of a path, in the scene's coordinates.
std::string path_data(const Slice& slice, Phase phase) {
    std::string data;
    for (const Slice::Loop& loop : slice.loops) {
        if (loop.phase != phase) continue;
        char command = 'M';
        for (const std::uint32_t vertex : loop.vertices) {
            const glm::vec2& p = slice.vertices[vertex];
            data += fmt::format("{}{} {}", command, p.x, p.y);
            command = 'L';
        }
        data += 'Z';
    }
    return data;
}

// The length of the scale bar: 1, 2 or 5 times a power of ten, at most a third of the picture.
double length_of_bar(double longest) {
    const double power = std::pow(10.0, support::exponent_of_ten(longest / 3));
    double length = power;
    for (const double factor : {2.0, 5.0})
        if (factor * power <= longest / 3) length = factor * power;
    return length;
}

// A length in metres, in the unit that suits it.
std::string metric_text(double metres) {
    if (metres < 1e-3) return fmt::format("{:.6g} µm", 1e6 * metres);
    if (metres < 1e-2) return fmt::format("{:.6g} mm", 1e3 * metres);
    if (metres < 1) return fmt::format("{:.6g} cm", 1e2 * metres);
    return fmt::format("{:.6g} m", metres);
}

std::string bar_text(double length, const LengthUnit& unit) {
    return unit.name == "in" ? fmt::format("{:.6g} in", length) : metric_text(length * unit.metres);
}

// The phases of a slice but the vacuum, in ascending order.
std::vector<Phase> shown_phases(const Slice& slice) {
    std::vector<Phase> shown;
    for (const Slice::Loop& loop : slice.loops)
        if (loop.phase != phasetree::vacuum && (shown.empty() || shown.back() != loop.phase))
            shown.push_back(loop.phase);
    return shown;
}

}  // namespace

std::string slice_svg(const Slice& slice, const SliceFrame& frame) {
    const double u = frame.low.x, v = frame.low.y, width = frame.high.x - u, height = frame.high.y - v;
    const double longest = std::max(width, height), scale = longest_drawn_side / longest;
    const std::vector<Phase> shown = shown_phases(slice);
    const double page_width = std::max(scale * width + 2 * page_margin, least_page_width);
    const double below = page_margin + scale * height + page_margin;
    const PhaseSet listed{frame.phases.bits & ~PhaseSet::of(phasetree::vacuum).bits};
    const double page_height = below + legend_row * (std::popcount(listed.bits) + 1) + page_margin;
    std::string svg = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
        "{1:.0f}\" "
        "font-family=\"sans-serif\" font-size=\"13\">\n"
        "<title>{2}</title>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
        page_width, page_height, xml_text(frame.plane));
    // Scene coordinates, with the second axis upwards. Line widths are in scene units, too, because not every program
    // supports vector-effect="non-scaling-stroke".
    svg += fmt::format(
        "<g transform=\"matrix({} 0 0 {} {} {})\" fill-rule=\"evenodd\" stroke=\"#303030\" stroke-width=\"{:.6g}\" "
        "stroke-linejoin=\"round\">\n",
        scale, -scale, page_margin - scale * u, page_margin + scale * (v + height), line_width / scale);
    for (const Phase phase : shown)
        svg += fmt::format("<path data-phase=\"{}\" fill=\"{}\" d=\"{}\"/>\n", xml_text(frame.names[phase]),
                           hex_color(frame.colors[phase.index]), path_data(slice, phase));
    svg += "</g>\n";
    const double bar = length_of_bar(longest);
    double y = below + 0.5 * legend_row;
    svg += fmt::format(
        "<path d=\"M{0:.2f} {1:.2f}v-6v3h{2:.2f}v-3v6\" fill=\"none\" stroke=\"#000000\"/>\n"
        "<text x=\"{3:.2f}\" y=\"{1:.2f}\">{4}, {5}</text>\n",
        page_margin, y, scale * bar, page_margin + scale * bar + 8, bar_text(bar, frame.lengths),
        xml_text(frame.plane));
    for (const Phase phase : shown) {
        y += legend_row;
        svg += fmt::format(
            "<rect x=\"{:.0f}\" y=\"{:.2f}\" width=\"14\" height=\"14\" fill=\"{}\" stroke=\"#303030\" "
            "stroke-width=\"{}\"/>\n<text x=\"{:.0f}\" y=\"{:.2f}\">{}, {:.6g} {}²</text>\n",
            page_margin, y - 12, hex_color(frame.colors[phase.index]), line_width, page_margin + 22, y,
            xml_text(frame.names[phase]), slice.area(phase), frame.lengths.name);
    }
    return svg + "</svg>\n";
}

}  // namespace phasetree::tracer
