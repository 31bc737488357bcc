#include "film/film.hpp"

#include <algorithm>
#include <cstddef>

namespace phasetree::tracer {

void FilmTile::join(const FilmTile& other) {
    const PixelRange& part = other.area_;
    for (int y = part.y0; y < part.y1; ++y) {
        faults_[static_cast<std::size_t>(y - area_.y0)] += other.faults_[static_cast<std::size_t>(y - part.y0)];
        for (int x = part.x0; x < part.x1; ++x) {
            const std::size_t pixel = area_.index(x, y), theirs = part.index(x, y);
            if (other.samples_[theirs] == 0) continue;
            sums_.join(pixel, other.sums_, theirs);
            samples_[pixel] += other.samples_[theirs];
        }
    }
}

Image FilmTile::image(const FilmSettings& settings) const {
    Image image = black_image(settings, area_, sums_.channels());
    write_into(image, area_);
    return image;
}

void FilmTile::write_into(Image& image, const PixelRange& area) const {
    if (image.attributes.empty()) image.attributes = sums_.attributes();
    for (int y = area_.y0; y < area_.y1; ++y)
        for (int x = area_.x0; x < area_.x1; ++x) {
            const std::size_t pixel = area_.index(x, y);
            if (samples_[pixel] > 0) sums_.resolve(pixel, samples_[pixel], image, area.index(x, y));
        }
}

std::uint64_t FilmTile::write_row(int y, ByteWriter& out) const {
    const FilmFaults& faults = faults_[static_cast<std::size_t>(y - area_.y0)];
    out.number(faults.not_finite);
    out.number(faults.too_large);
    std::uint64_t count = 0;
    for (int x = area_.x0; x < area_.x1; ++x) {
        const std::size_t pixel = area_.index(x, y);
        out.number(samples_[pixel]);
        count += samples_[pixel];
        sums_.write(pixel, out);
    }
    return count;
}

std::uint64_t FilmTile::read_row(int y, ByteReader& in) {
    FilmFaults& faults = faults_[static_cast<std::size_t>(y - area_.y0)];
    faults.not_finite = in.number<std::uint64_t>();
    faults.too_large = in.number<std::uint64_t>();
    std::uint64_t count = 0;
    for (int x = area_.x0; x < area_.x1; ++x) {
        const std::size_t pixel = area_.index(x, y);
        samples_[pixel] = in.number<std::uint32_t>();
        count += samples_[pixel];
        sums_.read(pixel, in);
    }
    return count;
}

Image black_image(const FilmSettings& settings, const PixelRange& area, const std::vector<std::string>& channels) {
    Image image;
    image.width = area.width();
    image.height = area.height();
    image.pixels.resize(area.size());
    for (std::size_t i = 3; i < channels.size(); ++i)
        image.extra_channels.push_back({channels[i], std::vector<float>(area.size())});
    if (area.width() != settings.width || area.height() != settings.height)
        image.crop = Crop{area.x0, area.y0, settings.width, settings.height};
    return image;
}

glm::dvec2 Film::sample_position(int x, int y, const glm::vec2& u) const {
    const glm::vec2 offset = settings_.filter.sample(u);
    return {x + 0.5 + static_cast<double>(offset.x), y + 0.5 + static_cast<double>(offset.y)};
}

}  // namespace phasetree::tracer
