// Chooses which of an OpenVDB file's grids to read, by name and kind.
//
// Only openvdb.cpp includes this, because OpenVDB's headers are large.
#pragma once

#include <fmt/format.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace phasetree::tracer {

// How messages refer to the wanted grids.
struct GridsCalled {
    const char* one;
    const char* several;
};

// A grid of a file, of which only the metadata has been read. Its name is the one by which OpenVDB finds it: "density",
// or "density[0]" and "density[1]" if two grids have that name.
struct ListedGrid {
    std::string name;
    openvdb::GridBase::ConstPtr grid;
};

inline std::vector<ListedGrid> grids_of(openvdb::io::File& file) {
    std::vector<ListedGrid> grids;
    const openvdb::GridPtrVecPtr metadata = file.readAllGridMetadata();
    auto name = file.beginName();  // iterates over the grids in the same order
    for (const openvdb::GridBase::Ptr& grid : *metadata) {
        grids.push_back({*name, grid});
        ++name;
    }
    return grids;
}

// Formats a list of grids: "density" (float fog volume), "v" (vec3s) and 3 more
inline std::string listed(const std::vector<ListedGrid>& grids) {
    constexpr std::size_t most_grids = 8, most_bytes_of_name = 40;
    std::string list;
    for (std::size_t i = 0; i < std::min(grids.size(), most_grids); ++i) {
        const auto& [name, grid] = grids[i];
        const bool is_cut = name.size() > most_bytes_of_name;
        const openvdb::GridClass kind = grid->getGridClass();
        list += fmt::format("{}\"{}{}\" ({}{})", i == 0 ? "" : ", ", name.substr(0, most_bytes_of_name),
                            is_cut ? "…" : "", grid->valueType(),
                            kind == openvdb::GRID_LEVEL_SET    ? " level set"
                            : kind == openvdb::GRID_FOG_VOLUME ? " fog volume"
                                                               : "");
    }
    if (grids.size() > most_grids) list += fmt::format(" and {} more", grids.size() - most_grids);
    return list;
}

// The grids with a name: the one that has it including its index, or all that have it without an index.
inline std::vector<ListedGrid> grids_called(const std::string& name, const std::vector<ListedGrid>& grids) {
    std::vector<ListedGrid> found;
    std::ranges::copy_if(grids, std::back_inserter(found), [&](const ListedGrid& g) { return g.name == name; });
    if (found.empty())
        std::ranges::copy_if(grids, std::back_inserter(found),
                             [&](const ListedGrid& g) { return g.grid->getName() == name; });
    return found;
}

// The name of the grid to read: the only suitable one, or the one with the given name.
template <class IsWanted, class WhyNot>
inline std::string chosen_grid(const std::vector<ListedGrid>& grids, const std::string& name, const GridsCalled& called,
                               const IsWanted& is_wanted, const WhyNot& why_not) {
    if (grids.empty()) throw std::runtime_error("it has no grids");
    const std::vector<ListedGrid> candidates = name.empty() ? grids : grids_called(name, grids);
    if (candidates.empty())
        throw std::runtime_error(fmt::format("it has no grid \"{}\"; it has {}", name, listed(grids)));
    std::vector<ListedGrid> wanted;
    std::ranges::copy_if(candidates, std::back_inserter(wanted),
                         [&](const ListedGrid& g) { return is_wanted(*g.grid); });
    if (wanted.size() == 1) return wanted.front().name;
    if (wanted.empty() && name.empty() && grids.size() > 1)
        throw std::runtime_error(fmt::format("none of its grids is {}; it has {}", called.one, listed(grids)));
    if (wanted.empty()) {
        const std::string reason = why_not(*candidates.front().grid);
        throw std::runtime_error(name.empty() ? reason : fmt::format("its grid \"{}\": {}", name, reason));
    }
    if (name.empty())
        throw std::runtime_error(
            fmt::format("it has several {}; choose one with \"grid\": {}", called.several, listed(wanted)));
    throw std::runtime_error(
        fmt::format("it has several grids called \"{}\"; choose one by its index: {}", name, listed(wanted)));
}

}  // namespace phasetree::tracer
