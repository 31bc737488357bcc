#include "command/film_header.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "command/reading.hpp"
#include "phasetree/building/options.hpp"
#include "phasetree/version.hpp"
#include "scene/fingerprint.hpp"

namespace phasetree::tracer {

namespace {

// All settings that the picture depends on, under user-visible names. The properties of the object's cells come last.
std::vector<std::pair<std::string, std::string>> settings_of(const RenderOptions& options, const Document& document,
                                                             const Scene& scene, const PixelRange& pixels) {
    const Planes::Choice chosen = film_settings(scene).planes;
    std::vector<std::string_view> planes;
    for (std::size_t i = 0; i < Planes::size; ++i)
        if (chosen[i]) planes.push_back(Planes::names[i]);
    std::vector<std::pair<std::string, std::string>> settings{
        {"version", build_id()},
        {"commit", source_commit()},
        {"Embree", fmt::format("{}", PHASETREE_EMBREE_MAJOR)},
        {"scene", fmt::format("{:016x}", fingerprint_showing(document, options.quiet))},
        {"size", fmt::format("{}x{}", scene.film.width, scene.film.height)},
        {"crop", fmt::format("{},{},{},{}", pixels.x0, pixels.y0, pixels.x1, pixels.y1)},
        {"planes", fmt::format("{}", fmt::join(planes, ","))},
        {"detail", options.detail ? fmt::format("{} pixels", *options.detail) : "the finest"},
        {"build quality", options.quality == BuildQuality::low ? "low" : "medium"}};
    for (auto& setting : settings_of_samples(scene.settings)) settings.push_back(std::move(setting));
    return settings;
}

}  // namespace

FilmFileHeader header_of(const RenderOptions& options, const Document& document, const Scene& scene,
                         const RenderJob& job) {
    FilmFileHeader h;
    h.settings = settings_of(options, document, scene, job.pixels);
    h.film = film_settings(scene);
    h.scene_names = scene_names_of(scene);
    h.area = film_area(scene, job);
    h.shown = job.pixels;
    h.samples = *job.samples;
    h.samples_in_all = scene.settings.samples;
    h.scene = std::filesystem::path(options.scene->shown()).filename().string();
    h.seed = scene.settings.seed;
    h.exposure_ev = scene.settings.exposure_ev;
    h.view = scene.settings.view;
    return h;
}

void add_cells(FilmFileHeader& header, const RenderOptions& options, const CellStatistics& cells) {
    const std::size_t most = options.max_bytes > 0 ? options.max_bytes : default_cell_bytes();
    header.settings.emplace_back(
        "cells", cells.is_coarser ? fmt::format("limited to {} bytes", most) : "without a memory limit");
}

}  // namespace phasetree::tracer
