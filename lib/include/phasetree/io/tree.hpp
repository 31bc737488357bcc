#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "phasetree/io/document.hpp"
#include "phasetree/io/node_places.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/height_grid.hpp"
#include "phasetree/nodes/fields/siren_network.hpp"
#include "phasetree/nodes/fields/voxel_grid.hpp"
#include "phasetree/nodes/phased/label_grid.hpp"
#include "phasetree/nodes/profiles/text_outlines.hpp"

namespace phasetree {

/// The names that a scene file gives to its phases, in the order of the file: names[0] is "vacuum".
struct PhaseNames {
    std::vector<std::string> names{"vacuum"};

    const std::string& operator[](Phase p) const { return names[p.index]; }
    /// Material phases, the vacuum not counted.
    std::size_t size() const { return names.size() - 1; }
};

/// What of a scene file is the model: the names of "phases", the named "shapes", and the "tree".
struct SceneTree {
    PhaseNames phases;
    Phased object;
};

/// What reads the files that nodes name. This library knows no images, OpenVDB or fonts; whoever does gives it readers
/// for them. A reader throws any std::exception whose what() says what is wrong with the file. `grid` is the name of
/// the grid that is wanted of a file that may hold several, or empty.
struct FileReaders {
    std::function<HeightGrid(const std::filesystem::path&)> height_grid{};
    std::function<VoxelGrid(const std::filesystem::path&, const std::string& grid)> level_set{};
    std::function<LabelGrid(const std::filesystem::path&, const std::string& grid)> label_grid{};
    /// The files that the name of a label grid stands for, such as the images of a stack. Without it, it is one file's.
    std::function<std::vector<std::filesystem::path>(const std::filesystem::path&)> label_files{};
    /// What the letters of a font make of a text.
    std::function<TextOutlines(const std::filesystem::path& font, const std::string& text)> text_outlines{};
};

/// The weights of a network: {"radius": R, "layers": [{"weights": [[…], …], "bias": […]}, …]}. Throws SceneError, which
/// quotes nothing of the file.
SirenNetwork read_siren(const std::filesystem::path&);

/// Reads the model of a scene document; the rest of the file is ignored.
///
///     "phases": {"glass": …, "water": …},
///     "shapes": {"bulb": {"sphere": {"radius": 1}}},
///     "tree":   {"under": [{"set": {"phase": "glass", "of": "bulb"}}, …]}
///
/// A node is an object of one member: the node's name, and its parameters; a node whose one required parameter is a
/// list of children takes the list instead of the parameters, as does one whose required parameter is a text. A string
/// is a named shape. Names of phases are strings, sets of phases lists of them. Throws SceneError, at the place in the
/// text. Files are sought from the scene file's folder. `places` receives every node.
SceneTree read_tree(const Document&, const FileReaders& = {}, NodePlaces* places = nullptr);

/// The names of a document's "phases". A document without any has the vacuum alone.
PhaseNames read_phase_names(const Document&);

/// Reads objects that stand anywhere in a document, which share its phases and shapes; of each the node or the name of
/// a shape. Throws SceneError as read_tree() does, also for a shape that none of them uses.
std::vector<Phased> read_objects(const Document&, const PhaseNames&, std::span<const Value> objects,
                                 const FileReaders& = {}, NodePlaces* places = nullptr);

/// What a node's text may name that stands nowhere in it: handles that a program has, by names that it gives them.
struct KnownShapes {
    std::map<std::string, Field, std::less<>> fields;
    std::map<std::string, Phased, std::less<>> objects;
};

/// Reads one node, with what it is made of either in the text or known already. This is how a binding to another
/// language makes nodes of any kind, with the reader's checks and sentences. Throws SceneError.
Field read_field(const Document&, const PhaseNames&, KnownShapes, const FileReaders& = {});
Phased read_object(const Document&, const PhaseNames&, KnownShapes, const FileReaders& = {});

/// Reads a plain field that stands elsewhere in a scene document: a node, or the name of one of the document's shapes.
/// A document that is but a part of a scene has neither shapes nor phases. Throws SceneError as read_tree() does.
Field read_field(const Document&, Value, const FileReaders& = {});

}  // namespace phasetree
