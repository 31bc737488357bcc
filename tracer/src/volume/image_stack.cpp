// Reads voxels from a stack of images, one per layer. Labels of a segmented scan are grey integers, or the indices of a
// PNG file with a palette. Other voxels are quantities: integers are scaled to 0 … 1, and floats are used as they are.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <stdexcept>

#include "image/read_image.hpp"
#include "phasetree_support/folder.hpp"
#include "volume/formats.hpp"
#include "volume/label_numbers.hpp"
#include "volume/number_grid.hpp"

namespace phasetree::tracer {

namespace {

namespace fs = std::filesystem;

// A name in which a run of # stands for a number with at least that many digits.
struct Pattern {
    std::string before, behind;
    std::size_t digits;

    explicit Pattern(const std::string& name) {
        const std::size_t first = name.find('#');
        const std::size_t end = std::min(name.find_first_not_of('#', first), name.size());
        if (name.find('#', end) != std::string::npos)
            throw std::runtime_error("the # in its name must be adjacent, because they stand for one number");
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

}  // namespace

std::vector<fs::path> layers_of_stack(const fs::path& path) {
    const std::string name = path.filename().string();
    if (name.find('#') == std::string::npos) return {path};
    const Pattern pattern(name);
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    std::map<long, fs::path> found;
    (void)support::each_entry(folder, [&](const fs::path& file) {
        if (const long n = pattern.number_in(file.filename().string()); n >= 0) {
            found.emplace(n, file);
            if (found.size() > static_cast<std::size_t>(VoxelGrid::max_along_axis))
                throw std::runtime_error(fmt::format("there are more than {} images", VoxelGrid::max_along_axis));
        }
        return true;
    });
    if (found.empty()) throw std::runtime_error("there is no file with this name and digits instead of #");
    std::vector<fs::path> layers;
    long next = found.begin()->first;
    for (const auto& [n, file] : found) {
        if (n != next)
            throw std::runtime_error(fmt::format("\"{}\" exists, but \"{}\", which comes before it, does not",
                                                 file.filename().string(), pattern.name_of(next)));
        ++next;
        layers.push_back(file);
    }
    return layers;
}

namespace {

// Appends the voxels of a layer. The first layer sets the size, after `check` has accepted its header. `number`
// converts a grey value to a voxel's number, and `read` reads a file.
template <class T, class Check, class Number, class Read>
void add_layer(const fs::path& file, bool is_first, std::array<int, 3>& size, std::vector<T>& voxels,
               const Check& check, const Number& number, const Read& read) {
    const auto begin = [&](const ImageHeader& header) {
        check(header);
        if (is_first) {
            size = {header.width, header.height, size[2]};
            checked_count(size);
        }
        if (header.width != size[0] || header.height != size[1])
            throw std::runtime_error(fmt::format("it has {} × {} pixels, but the layers below it have {} × {}",
                                                 header.width, header.height, size[0], size[1]));
        return 1;
    };
    const std::size_t first = voxels.size();
    read(file, "layer", begin, [&](std::span<const float> values) {
        for (const float v : values) voxels.push_back(number(v));
    });
    // The first row has the largest y, but the grid is in the order of increasing y.
    const auto columns = static_cast<std::ptrdiff_t>(size[0]);
    auto low = voxels.begin() + static_cast<std::ptrdiff_t>(first), high = voxels.end() - columns;
    for (; low < high; low += columns, high -= columns) std::swap_ranges(low, low + columns, high);
}

void check_is_grey(const ImageHeader& header, const char* must_be) {
    if (header.channels != 1)
        throw std::runtime_error(fmt::format("{}, but it has {} channels", must_be, header.channels));
}

}  // namespace

LabelGrid labels_of_images(const fs::path& path) {
    const std::vector<fs::path> layers = layers_of_stack(path);
    LabelGrid grid;
    grid.lattice.size[2] = static_cast<int>(layers.size());
    LabelNumbers numbers(grid);
    // The largest integer of the images' type, by which read_image() divides.
    double greatest = 255;
    const auto check = [&](const ImageHeader& header) {
        constexpr const char* must_be = "labels must be grey integers of at most 32 bits, or the palette of a PNG";
        check_is_grey(header, must_be);
        if (header.is_floating_point || header.bits > 32)
            throw std::runtime_error(fmt::format("{}, but it has {} of {} bits", must_be,
                                                 header.is_floating_point ? "floating-point numbers" : "values",
                                                 header.bits));
        greatest = std::ldexp(1.0, header.is_signed ? header.bits - 1 : header.bits) - 1;
    };
    // Up to this limit, floats can represent 32-bit integers distinctly.
    constexpr double most = 1 << 20;
    const auto label = [&](float v) {
        const double number = std::round(static_cast<double>(v) * greatest);
        if (!(std::abs(number) <= most))
            throw std::runtime_error(fmt::format("it has a label beyond {}; renumber its labels", most));
        return numbers.index_of(static_cast<std::int32_t>(number));
    };
    for (const fs::path& layer : layers)
        add_layer(layer, layer == layers.front(), grid.lattice.size, grid.voxels, check, label, read_labels);
    return grid;
}

VoxelGrid numbers_of_images(const fs::path& path, const glm::dvec3& spacing) {
    const std::vector<fs::path> layers = layers_of_stack(path);
    VoxelLattice lattice{.spacing = spacing};
    lattice.size[2] = static_cast<int>(layers.size());
    std::vector<float> values;
    const auto check = [](const ImageHeader& header) { check_is_grey(header, "the images must be grey"); };
    for (const fs::path& layer : layers)
        add_layer(
            layer, layer == layers.front(), lattice.size, values, check, [](float v) { return v; }, read_image);
    for (glm::length_t i = 0; i < 3; ++i)
        lattice.first[i] = -0.5 * (lattice.size[static_cast<std::size_t>(i)] - 1) * spacing[i];
    return number_grid(lattice, std::move(values));
}

}  // namespace phasetree::tracer
