#include "scene/fingerprint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "phasetree_support/checksum.hpp"
#include "phasetree_support/reading.hpp"
#include "scene/image_parameters.hpp"
#include "scene/named_files.hpp"
#include "scene/phase_entry.hpp"

namespace phasetree::tracer {

namespace {

using support::Checksum;

void put(Checksum& sum, std::string_view text) {
    sum.put(text.data(), text.size());
}

void put_file(Checksum& sum, const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::array<char, 1 << 16> bytes;
    support::ReadingPlace place;
    std::uint64_t at = 0;
    while (file.read(bytes.data(), bytes.size()) || file.gcount() > 0) {
        put(sum, {bytes.data(), static_cast<std::size_t>(file.gcount())});
        place.reached(at += static_cast<std::uint64_t>(file.gcount()));
    }
    place.finished(at);
}

void put_string(Checksum& sum, const Document& document, Value value) {
    put(sum, value.string());
    for (const std::filesystem::path& path : named_files(document, value)) put_file(sum, path);
}

// Parts of a scene that have no effect on the samples of its pictures.
constexpr std::array<std::string_view, 3> parts_without_effect{"render", "unit", "expect"};

// The place of a value in the file. Properties that change no picture, such as a phase's density, are left out of the
// fingerprint. Films made before such a property was added to the scene are then still recognised.
enum class Place { elsewhere, objects, object, phases, phase };

Place place_in(Place outer, Value member) {
    switch (outer) {
        case Place::objects:
            return Place::object;
        case Place::object:
            return member.key() == "phases" ? Place::phases : Place::elsewhere;
        case Place::phases:
            return Place::phase;
        default:
            return Place::elsewhere;
    }
}

bool changes_no_picture(Place outer, Value member) {
    return outer == Place::phase && is_phase_parameter(member.key());
}

void put_value(Checksum& sum, const Document& document, Value value, Place place = Place::elsewhere) {
    const auto kind = static_cast<unsigned char>(value.kind());
    sum.put(&kind, 1);
    put(sum, value.key());
    switch (value.kind()) {
        case Kind::null:
            break;
        case Kind::boolean: {
            const unsigned char is_true = value.boolean();
            sum.put(&is_true, 1);
            break;
        }
        case Kind::number: {
            const double number = value.number() + 0.0;  // turns −0 into 0
            sum.put(&number, sizeof number);
            break;
        }
        case Kind::string:
            put_string(sum, document, value);
            break;
        case Kind::array:
        case Kind::object: {
            std::uint64_t size = 0;
            for (const Value member : value) size += changes_no_picture(place, member) ? 0 : 1;
            sum.put(&size, sizeof size);
            for (const Value member : value)
                if (!changes_no_picture(place, member)) put_value(sum, document, member, place_in(place, member));
        }
    }
}

}  // namespace

std::uint64_t fingerprint(const Document& document) {
    Checksum sum;
    each_document(document, [&](const Document& d) {
        const bool is_the_scene = &d == &document;
        if (!is_the_scene) return put_value(sum, d, d.root());
        for (const Value part : d.root()) {
            if (std::ranges::find(parts_without_effect, part.key()) != parts_without_effect.end()) continue;
            const Place place = part.key() == "phases"    ? Place::phases
                                : part.key() == "objects" ? Place::objects
                                                          : Place::elsewhere;
            put_value(sum, d, part, place);
        }
    });
    // At time 0 the fingerprint is the same as before scenes had a time.
    if (const double seconds = document.seconds(); seconds != 0) sum.put(&seconds, sizeof seconds);
    return sum.get();
}

std::vector<std::pair<std::string, std::string>> settings_of_samples(const RenderSettings& settings) {
    // Guiding and wavelengths are appended below, so that films made before they existed are still recognised.
    constexpr std::array<std::string_view, 8> others{
        "width", "height", "samples", "exposure", "view", "frames_per_second", "guiding", "spectral"};
    const ImageParameters values{settings};
    std::vector<std::pair<std::string, std::string>> all;
    ImageParameters::parameters([&](auto member, const Parameter& p) {
        if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(values.*member)>>)
            if (std::ranges::find(others, p.name) == others.end())
                all.emplace_back(p.name, fmt::format("{}", values.*member));
    });
    if (settings.shutter != glm::vec2(0))
        all.emplace_back("shutter", fmt::format("{},{}", settings.shutter.x, settings.shutter.y));
    if (settings.guiding) all.emplace_back("guiding", "true");
    if (settings.spectral) all.emplace_back("spectral", "true");
    // The noise is judged at this exposure.
    if (settings.noise > 0) all.emplace_back("exposure", fmt::format("{}", settings.exposure_ev));
    return all;
}

}  // namespace phasetree::tracer
