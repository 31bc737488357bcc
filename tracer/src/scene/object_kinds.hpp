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
        "An object of the scene, in a list. Objects must not overlap. Where they do, the earliest copy wins: objects "
        "that no instance refers to come first, in the order of this list, and then the copies made by instances, in "
        "the order of the instances. Gaps of less than a few millionths of an object's size are ignored: rays pass "
        "directly from one object to the other."};

    std::string name{};
    std::optional<Value> tree{};
    std::optional<Value> file{};
    std::optional<Value> transform{};
    std::optional<Value> phases{};

    template <class V>
    static void parameters(V&& v) {
        using P = ObjectParameters;
        v(&P::name, Parameter{"name", "", "Name of the object, which must be unique."});
        v(&P::tree,
          PartParameter{{"tree", "", "Tree of the object: a node, or the name of a shape.", limits::any, true},
                        "object",
                        R"({"$ref": "#/definitions/object"})"});
        v(&P::file, PartParameter{{"file", "",
                                   "Instead of a tree: another scene file, whose tree, phases and materials are used. "
                                   "Its phases are named after the object: \"object.phase\".",
                                   limits::any, true},
                                  "text",
                                  R"({"type": "string"})"});
        v(&P::transform, PartParameter{{"transform", "", "Transform from the object to the scene.", limits::any, true},
                                       "transform or list",
                                       transform_schema});
        v(&P::phases, PartParameter{{"phases", "", "Replaces phases' materials and densities, for this object only.",
                                     limits::any, true},
                                    "object of materials",
                                    R"({"type": "object", "additionalProperties": {"$ref": "#/definitions/phase"}})"});
    }
};

struct InstanceParameters {
    static constexpr KindInfo info{"instances",
                                   "Instances of an object or a group, in a list. An object with instances appears "
                                   "only where they put it; its own transform is applied first."};

    std::string of{};
    std::optional<Value> transform{};
    std::optional<Value> transforms{};
    std::optional<Value> file{};

    template <class V>
    static void parameters(V&& v) {
        using P = InstanceParameters;
        v(&P::of, Parameter{"of", "", "Name of an object or a group."});
        v(&P::transform,
          PartParameter{
              {"transform", "",
               "Transform of the instance. If there is a list of transforms, it is applied after each of them.",
               limits::any, true},
              "transform or list",
              transform_schema});
        v(&P::transforms,
          PartParameter{{"transforms", "",
                         "Many instances: for each, the image of the origin, or twelve numbers: the images of the "
                         "vectors [1, 0, 0], [0, 1, 0] and [0, 0, 1], then the image of the origin.",
                         limits::any, true},
                        "list of [x, y, z] and lists of 12 numbers",
                        R"({"type": "array", "minItems": 1, "items": {"type": "array", "items": {"type": "number"},
                            "minItems": 3, "maxItems": 12}})"});
        v(&P::file,
          PartParameter{{"file", "",
                         "The same in a binary file: the eight bytes `PTPLACES`, the number of instances as a 64-bit "
                         "unsigned integer, then twelve 32-bit floats per instance, all little-endian.",
                         limits::any, true},
                        "text",
                        R"({"type": "string"})"});
    }
};

}  // namespace phasetree::tracer
