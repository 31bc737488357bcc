#include "film_file/header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace phasetree::tracer {

namespace {

constexpr std::size_t longest_text = 1 << 20, longest_list = 1 << 20;
constexpr int largest_side = 32768, max_samples = 1 << 24;

void write_text(ByteWriter& out, std::string_view text) {
    text = text.substr(0, longest_text);
    out.number(static_cast<std::uint32_t>(text.size()));
    out.append(std::as_bytes(std::span(text)));
}

std::string read_text(ByteReader& in) {
    const auto length = in.number<std::uint32_t>();
    if (length > longest_text) throw BytesError("it contains a string of invalid length");
    const std::span<const std::byte> bytes = in.take(length);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::size_t read_count(ByteReader& in, std::size_t most) {
    const auto count = in.number<std::uint32_t>();
    if (count > most) throw BytesError("it contains a list of invalid length");
    return count;
}

void write_int(ByteWriter& out, int value) {
    out.number(static_cast<std::uint32_t>(value));
}

int read_int(ByteReader& in, int low, int high) {
    const auto value = in.number<std::uint32_t>();
    if (value < static_cast<std::uint32_t>(low) || value > static_cast<std::uint32_t>(high))
        throw BytesError("it contains a number out of range");
    return static_cast<int>(value);
}

// Reads a range of pixels that is not empty and lies within another.
PixelRange read_range(ByteReader& in, const PixelRange& within) {
    PixelRange range;
    range.x0 = read_int(in, within.x0, within.x1 - 1);
    range.y0 = read_int(in, within.y0, within.y1 - 1);
    range.x1 = read_int(in, range.x0 + 1, within.x1);
    range.y1 = read_int(in, range.y0 + 1, within.y1);
    return range;
}

Planes::Choice read_planes(ByteReader& in) {
    Planes::Choice planes;
    const std::size_t count = read_count(in, longest_list);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string name = read_text(in);
        const auto found = std::ranges::find(Planes::names, name);
        if (found == Planes::names.end()) throw BytesError("it contains a plane that this version does not know");
        planes[static_cast<std::size_t>(found - Planes::names.begin())] = true;
    }
    return planes;
}

// Makes text from an untrusted file safe to print: bytes other than printable ASCII become "\x1b" and the like.
std::string printable(const std::string& text) {
    std::string safe;
    for (const char c : text.substr(0, 60)) {
        const auto byte = static_cast<unsigned char>(c);
        safe += byte >= 0x20 && byte < 0x7f ? std::string(1, c) : fmt::format("\\x{:02x}", byte);
    }
    return safe;
}

// The value of a setting in the file; empty if there is no such setting.
std::string setting(const FilmFileHeader& header, std::string_view name) {
    const auto found =
        std::ranges::find(header.settings, name, [](const auto& s) { return std::string_view(s.first); });
    return found == header.settings.end() ? "" : found->second;
}

// "phasetree 0.10.0+3f2a91c04d7e (commit 8f1d19c6a3b2)"
std::string build_and_commit(const FilmFileHeader& header) {
    const std::string commit = printable(setting(header, "commit"));
    return fmt::format("phasetree {}{}", header.build(), commit.empty() ? "" : fmt::format(" (commit {})", commit));
}

}  // namespace

std::string FilmFileHeader::build() const {
    return printable(setting(*this, "version"));
}

void FilmFileHeader::write(ByteWriter& out) const {
    write_int(out, static_cast<int>(settings.size()));
    for (const auto& [name, value] : settings) {
        write_text(out, name);
        write_text(out, value);
    }
    for (const int n : {film.width, film.height}) write_int(out, n);
    for (const PixelRange& r : {area, shown})
        for (const int n : {r.x0, r.y0, r.x1, r.y1}) write_int(out, n);
    write_int(out, static_cast<int>(film.planes.count()));
    for (std::size_t i = 0; i < Planes::size; ++i)
        if (film.planes[i]) write_text(out, Planes::names[i]);
    for (const auto* names : {&scene_names.phases, &scene_names.groups, &scene_names.objects}) {
        write_int(out, static_cast<int>(names->size()));
        for (const std::string& name : *names) write_text(out, name);
    }
    for (const int n : {samples.first, samples.last, samples_in_all}) write_int(out, n);
    write_text(out, scene);
    out.number(seed);
    out.number(exposure_ev);
    out.number(static_cast<std::uint8_t>(view ? 1 : 0));
    if (view) write_text(out, *view);
}

FilmFileHeader FilmFileHeader::read(ByteReader& in) {
    FilmFileHeader h;
    for (std::size_t left = read_count(in, longest_list); left > 0; --left) {
        std::string name = read_text(in);
        h.settings.emplace_back(std::move(name), read_text(in));
    }
    h.film.width = read_int(in, 1, largest_side);
    h.film.height = read_int(in, 1, largest_side);
    h.area = read_range(in, h.film.whole());
    h.shown = read_range(in, h.area);
    h.film.planes = read_planes(in);
    for (auto* names : {&h.scene_names.phases, &h.scene_names.groups, &h.scene_names.objects})
        for (std::size_t left = read_count(in, longest_list); left > 0; --left) names->push_back(read_text(in));
    h.samples.first = read_int(in, 0, max_samples - 1);
    h.samples.last = read_int(in, h.samples.first + 1, max_samples);
    h.samples_in_all = read_int(in, h.samples.last, max_samples);
    h.scene = read_text(in);
    h.seed = in.number<std::uint32_t>();
    h.exposure_ev = in.real();
    if (!std::isfinite(h.exposure_ev)) throw BytesError("it contains a number out of range");
    if (in.number<std::uint8_t>() != 0) h.view = read_text(in);
    return h;
}

std::string difference(const FilmFileHeader& wanted, const FilmFileHeader& found) {
    for (std::size_t i = 0; i < wanted.settings.size(); ++i) {
        if (i >= found.settings.size() || wanted.settings[i].first != found.settings[i].first)
            return "it was written by another version of phasetree";
        const auto& [name, value] = wanted.settings[i];
        const std::string& other = found.settings[i].second;
        if (value == other || name == "commit") continue;
        if (name == "scene") return "it belongs to another scene: the scene file, or a file that it names, has changed";
        if (name == "version")
            return fmt::format("it was rendered by {}, not by {}; render all samples of a picture with the same build",
                               build_and_commit(found), build_and_commit(wanted));
        return fmt::format("it has {} {}, not {}", printable(name), printable(other), printable(value));
    }
    const auto same_range = [](const PixelRange& a, const PixelRange& b) {
        return a.x0 == b.x0 && a.y0 == b.y0 && a.x1 == b.x1 && a.y1 == b.y1;
    };
    // The settings contain this too, unless the file is forged.
    if (wanted.film.planes != found.film.planes || wanted.film.width != found.film.width ||
        wanted.film.height != found.film.height || !same_range(wanted.area, found.area) ||
        !same_range(wanted.shown, found.shown) || wanted.scene_names != found.scene_names)
        return "it belongs to another picture";
    return "";
}

}  // namespace phasetree::tracer
