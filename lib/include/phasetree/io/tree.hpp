#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "phasetree/io/document.hpp"
#include "phasetree/io/file_readers.hpp"
#include "phasetree/io/node_places.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/siren_network.hpp"

namespace phasetree {

/// The phase names of a scene file, in file order. names[0] is "vacuum".
struct PhaseNames {
    std::vector<std::string> names{"vacuum"};

    const std::string& operator[](Phase p) const { return names[p.index]; }
    /// The number of material phases, without the vacuum.
    std::size_t size() const { return names.size() - 1; }
};

/// The model in a scene file: the names in "phases", and the "tree" with the "shapes" that it uses.
struct SceneTree {
    PhaseNames phases;
    Phased object;
};

/// Read the weights of a network: {"radius": R, "layers": [{"weights": [[…], …], "bias": […]}, …]}. Throws SceneError;
/// the message never contains text from the file.
SirenNetwork read_siren(const std::filesystem::path&);

/// Read the model of a scene document. The rest of the file is ignored.
///
///     "phases": {"glass": …, "water": …},
///     "shapes": {"bulb": {"sphere": {"radius": 1}}},
///     "tree":   {"under": [{"set": {"phase": "glass", "of": "bulb"}}, …]}
///
/// A node is an object with one member: the node's name and its parameters. A node whose only required parameter is a
/// list of children or a text accepts that value instead of the parameters. A string is a named shape. A phase is a
/// string, a set of phases a list of strings.
///
/// Files are resolved relative to the scene file's folder. `places`, if given, receives the position of every node.
/// Throws SceneError with the position in the text.
SceneTree read_tree(const Document&, const FileReaders& = {}, NodePlaces* places = nullptr);

/// Read the names in a document's "phases". Without "phases" there is only the vacuum.
PhaseNames read_phase_names(const Document&);

/// Read objects from anywhere in a document; they share its phases and shapes. Each value is a node or the name of a
/// shape. Throws SceneError like read_tree(), and also for errors in shapes that none of the objects uses.
std::vector<Phased> read_objects(const Document&, const PhaseNames&, std::span<const Value> objects,
                                 const FileReaders& = {}, NodePlaces* places = nullptr);

/// Existing handles that a node's text can refer to by name.
struct KnownShapes {
    std::map<std::string, Field, std::less<>> fields;
    std::map<std::string, Phased, std::less<>> objects;
};

/// Read a single node, whose children are in the text or in the known shapes. Bindings to other languages use this to
/// make nodes of any kind, with the reader's checks and messages. Throws SceneError.
Field read_field(const Document&, const PhaseNames&, KnownShapes, const FileReaders& = {});
Phased read_object(const Document&, const PhaseNames&, KnownShapes, const FileReaders& = {});

/// Read a field that is outside the "tree" of a scene document: a node, or the name of one of the document's shapes.
/// The document may be a part of a scene that has no "shapes" and "phases"; the node then cannot refer to any. Throws
/// SceneError like read_tree().
Field read_field(const Document&, Value, const FileReaders& = {});

}  // namespace phasetree
