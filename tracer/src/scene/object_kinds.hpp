// Parameter lists of objects and their placement in scene files.
#pragma once

#include "phasetree/io/kind.hpp"
#include "phasetree/model/concepts.hpp"
#include "phasetree/nodes/warps/affine.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/scale.hpp"
#include "phasetree/nodes/warps/stretch.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "scene/parameter_types.hpp"

namespace phasetree::tracer {

/// The tree nodes that are affine maps, with their own parameters.
using TransformKinds = TypeList<Translate, Rotate, Scale, Stretch, Affine>;

inline constexpr std::string_view transform_schema = R"({"$ref": "#/definitions/transform"})";

struct ObjectParameters {
    static constexpr KindInfo info{
        "objects",
        "An object of the scene, in a list. Objects must not overlap; where they do, the "
        "first copy is there: first come objects that no instance names, in the order of this list, and then the "
        "copies of instances in theirs. Where one begins within a few resolutions of "
        "where another ends, a ray goes from the one to the other without anything between."};

    std::string name{};
    std::optional<Value> tree{};
    std::optional<Value> file{};
    std::optional<Value> transform{};
    std::optional<Value> phases{};

    template <class V>
    static void parameters(V&& v) {
        using P = ObjectParameters;
        v(&P::name, Parameter{"name", "", "Its name, unlike any other's."});
        v(&P::tree, PartParameter{{"tree", "", "What it is made of: a node, or the name of one of the scene's shapes.",
                                   limits::any, true},
                                  "object",
                                  R"({"$ref": "#/definitions/object"})"});
        v(&P::file,
          PartParameter{{"file", "",
                         "A scene file, beside this one, whose tree is taken instead, with its phases and their "
                         "materials. A phase has the name that it has there, behind the object's name and a dot.",
                         limits::any, true},
                        "text",
                        R"({"type": "string"})"});
        v(&P::transform,
          PartParameter{
              {"transform", "", "Where it stands.", limits::any, true}, "transform or list", transform_schema});
        v(&P::phases,
          PartParameter{
              {"phases", "", "Other materials for phases of its tree, for this object alone.", limits::any, true},
              "object of materials",
              R"({"type": "object", "additionalProperties": {"$ref": "#/definitions/material"}})"});
    }
};

struct InstanceParameters {
    static constexpr KindInfo info{"instances",
                                   "Places of an object or of a group, in a list. An object that is named by an "
                                   "instance stands there, and no longer where its own transform alone puts it, which "
                                   "comes first."};

    std::string of{};
    std::optional<Value> transform{};
    std::optional<Value> transforms{};
    std::optional<Value> file{};

    template <class V>
    static void parameters(V&& v) {
        using P = InstanceParameters;
        v(&P::of, Parameter{"of", "", "The name of an object or of a group."});
        v(&P::transform,
          PartParameter{{"transform", "", "Where it stands; with a list, the last of the maps.", limits::any, true},
                        "transform or list",
                        transform_schema});
        v(&P::transforms,
          PartParameter{{"transforms", "",
                         "Many places: of each where its origin goes, or twelve numbers: where [1, 0, 0], [0, 1, 0] "
                         "and [0, 0, 1] go from there, and where the origin goes.",
                         limits::any, true},
                        "list of [x, y, z] and lists of 12 numbers",
                        R"({"type": "array", "minItems": 1, "items": {"type": "array", "items": {"type": "number"},
                            "minItems": 3, "maxItems": 12}})"});
        v(&P::file, PartParameter{{"file", "",
                                   "The same in a file: the eight bytes `PTPLACES`, their number as an unsigned "
                                   "integer of eight bytes, then twelve floats of four bytes for each, all with the "
                                   "lowest byte first.",
                                   limits::any, true},
                                  "text",
                                  R"({"type": "string"})"});
    }
};

}  // namespace phasetree::tracer
