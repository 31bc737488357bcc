// A segmented scan as images, one for each layer of voxels: grey values of 8 or 16 bits are the voxels' numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <stdexcept>

#include "image/read_image.hpp"
#include "volume/formats.hpp"
#include "volume/label_numbers.hpp"

namespace phasetree::tracer {

namespace {

namespace fs = std::filesystem;

// A name in which a run of # stands for a number of at least as many digits.
struct Pattern {
    std::string before, behind;
    std::size_t digits;

    explicit Pattern(const std::string& name) {
        const std::size_t first = name.find('#');
        const std::size_t end = std::min(name.find_first_not_of('#', first), name.size());
        if (name.find('#', end) != std::string::npos)
            throw std::runtime_error("the # in its name must stand side by side, for one number");
        before = name.substr(0, first);
        behind = name.substr(end);
        digits = end - first;
    }
    std::string name_of(long number) const { return fmt::format("{}{:0{}}{}", before, number, digits, behind); }
    // The number in a name, or −1.
    long number_in(const std::string& name) const {
        if (!name.starts_with(before) || !name.ends_with(behind) ||
            name.size() < before.size() + behind.size() + digits)
            return -1;
        const std::string number = name.substr(before.size(), name.size() - before.size() - behind.size());
        const bool is_number = std::ranges::all_of(number, [](unsigned char c) { return std::isdigit(c) != 0; });
        if (!is_number || number.size() > 9) return -1;
        const long n = std::stol(number);
        return name_of(n) == name ? n : -1;
    }
};

// The files, from the lowest layer to the highest. A number that is left out between two is an error.
std::vector<fs::path> layers_of(const fs::path& path) {
    const std::string name = path.filename().string();
    if (name.find('#') == std::string::npos) return {path};
    const Pattern pattern(name);
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    std::map<long, fs::path> found;
    std::error_code problem;
    for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end; entry.increment(problem))
        if (const long n = pattern.number_in(entry->path().filename().string()); n >= 0) {
            found.emplace(n, entry->path());
            if (found.size() > static_cast<std::size_t>(VoxelGrid::most_along_axis))
                throw std::runtime_error(fmt::format("there are more than {} images", VoxelGrid::most_along_axis));
        }
    if (found.empty()) throw std::runtime_error("there is no file of such a name with digits in place of #");
    std::vector<fs::path> layers;
    long next = found.begin()->first;
    for (const auto& [n, file] : found) {
        if (n != next)
            throw std::runtime_error(fmt::format("there is \"{}\", but not \"{}\" before it", file.filename().string(),
                                                 pattern.name_of(next)));
        ++next;
        layers.push_back(file);
    }
    return layers;
}

void add_layer(const fs::path& file, bool is_first, LabelGrid& grid, LabelNumbers& numbers) {
    const std::string name = file.filename().string();
    float greatest = 255;
    std::array<int, 3>& size = grid.lattice.size;
    const auto begin = [&](const ImageHeader& header) {
        if (header.is_floating_point || (header.bits != 8 && header.bits != 16))
            throw std::runtime_error("labels are grey values of 8 or 16 bits");
        if (header.channels != 1)
            throw std::runtime_error(fmt::format("labels are grey values, but it has {} channels", header.channels));
        if (is_first) {
            size = {header.width, header.height, size[2]};
            checked_count(size);
        }
        if (header.width != size[0] || header.height != size[1])
            throw std::runtime_error(fmt::format("it is of {} × {} pixels, but the layers below it of {} × {}",
                                                 header.width, header.height, size[0], size[1]));
        greatest = header.bits == 8 ? 255.f : 65535.f;
        return 1;
    };
    const std::size_t first = grid.voxels.size();
    read_image(file, "layer", begin, [&](std::span<const float> values) {
        for (const float v : values)
            grid.voxels.push_back(numbers.index_of(static_cast<std::int32_t>(std::lround(v * greatest))));
    });
    // The first row is at the largest y; in the grid y rises.
    const auto columns = static_cast<std::ptrdiff_t>(size[0]);
    auto low = grid.voxels.begin() + static_cast<std::ptrdiff_t>(first), high = grid.voxels.end() - columns;
    for (; low < high; low += columns, high -= columns) std::swap_ranges(low, low + columns, high);
}

}  // namespace

LabelGrid labels_of_images(const fs::path& path) {
    const std::vector<fs::path> layers = layers_of(path);
    LabelGrid grid;
    grid.lattice.size[2] = static_cast<int>(layers.size());
    LabelNumbers numbers(grid);
    for (const fs::path& layer : layers) add_layer(layer, layer == layers.front(), grid, numbers);
    return grid;
}

}  // namespace phasetree::tracer
