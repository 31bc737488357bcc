#include "film_file/merge.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>

namespace phasetree::tracer {

namespace {

std::string text_of(const SampleRange& r) {
    return fmt::format("{}:{}", r.first, r.last);
}

}  // namespace

Parts::Parts(const std::vector<std::filesystem::path>& paths, bool may_have_gaps) {
    for (const std::filesystem::path& path : paths) files_.emplace_back(path);
    for (const FilmFile& file : files_) {
        file.check_picture(files_.front().header());
        if (file.header().samples_in_all != files_.front().header().samples_in_all)
            throw file.error(fmt::format("it belongs to a render with {} samples per pixel, but \"{}\" to one with {}",
                                         file.header().samples_in_all, files_.front().path().string(),
                                         files_.front().header().samples_in_all));
    }
    std::ranges::stable_sort(files_, {}, [](const FilmFile& f) { return f.header().samples.first; });
    check_ranges(may_have_gaps);
    header_ = files_.front().header();
    header_.samples.last = files_.back().header().samples.last;
}

void Parts::check_ranges(bool may_have_gaps) {
    for (std::size_t i = 0; i < files_.size(); ++i) {
        const FilmFile& file = files_[i];
        const SampleRange& range = file.header().samples;
        if (!file.is_finished()) {
            are_joined_ = false;
            if (!may_have_gaps)
                throw file.error(fmt::format("it is unfinished: it has {} of {} samples per pixel",
                                             file.samples() / file.header().area.size(), range.size()));
        }
        if (i == 0) continue;
        const FilmFile& before = files_[i - 1];
        const int end = before.header().samples.last;
        if (range.first < end)
            throw file.error(fmt::format("its samples {} are also in \"{}\", which has {}", text_of(range),
                                         before.path().string(), text_of(before.header().samples)));
        if (range.first > end) {
            are_joined_ = false;
            if (!may_have_gaps)
                throw file.error(fmt::format("samples {} are missing between \"{}\" and it",
                                             text_of({end, range.first}), before.path().string()));
        }
    }
}

std::string Parts::missing() const {
    std::vector<std::string> ranges;
    if (header_.samples.first > 0) ranges.push_back(text_of({0, header_.samples.first}));
    if (header_.samples.last < header_.samples_in_all)
        ranges.push_back(text_of({header_.samples.last, header_.samples_in_all}));
    return ranges.empty() ? "" : fmt::format("samples {} are missing", fmt::join(ranges, " and "));
}

void Parts::join(const std::function<void(const FilmTile&)>& take, const std::function<bool()>& stopped) const {
    // Join one band per thread at a time; they are passed on in order.
    const int at_once = tbb::this_task_arena::max_concurrency();
    for (int first = 0; first < header_.bands() && !stopped(); first += at_once) {
        const int last = std::min(first + at_once, header_.bands());
        std::vector<std::optional<FilmTile>> bands(static_cast<std::size_t>(last - first));
        tbb::parallel_for(first, last, [&](int i) {
            FilmTile band(header_.band(i), header_.film.planes, header_.scene_names);
            for (const FilmFile& file : files_) {
                if (stopped()) return;
                band.join(file.band(i));
            }
            bands[static_cast<std::size_t>(i - first)] = std::move(band);
        });
        for (const std::optional<FilmTile>& band : bands)
            if (band) take(*band);
    }
}

}  // namespace phasetree::tracer
