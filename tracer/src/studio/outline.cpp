#include "studio/outline.hpp"

#include <algorithm>
#include <set>
#include <string_view>

#include "phasetree/io/keys.hpp"
#include "scene/phase_entry.hpp"
#include "studio/pointer.hpp"

namespace phasetree::tracer::studio {

namespace {

// Walks a document, from its top-level members down.
class Outliner {
  public:
    Outliner(const Document& document, const Vocabulary& vocabulary, std::size_t most)
        : vocabulary_(vocabulary), root_(document.root()), most_(most) {}

    Outline outline() {
        if (!root_.is_object()) return {};
        OutlineEntry scene = entry("scene", "scene", "", root_);
        scene.of = vocabulary_.only("scene");
        for (const char* const name : {"$schema", "version", "unit", "background"})
            if (const auto member = root_.find(name)) add_parameter(scene, *member, "", nullptr);
        result_.entries.push_back(std::move(scene));
        single("render", "render");
        single("camera", "camera");
        each("lights", "light");
        if (const auto phases = root_.find("phases"))
            for (const Value phase : *phases) add(phase_entry_of(phase, "/phases/" + escaped(phase.key())));
        if (const auto shapes = root_.find("shapes"); shapes && shapes->is_object())
            for (const Value shape : *shapes)
                named(is_field(shape) ? "field" : "object", "/shapes/" + escaped(shape.key()), shape);
        single("tree", "object");
        each("objects", "placed_object");
        if (const auto groups = root_.find("groups"); groups && groups->is_object())
            for (const Value group : *groups) {
                OutlineEntry one = entry("group", "group", "/groups/" + escaped(group.key()), group);
                one.label = std::string(group.key());
                items(one, group, "instance", "instances", one.pointer);
                add(std::move(one));
            }
        each("instances", "instance");
        each("meshes", "mesh");
        each("expect", "statement");
        return std::move(result_);
    }

  private:
    static OutlineEntry entry(std::string kind, std::string type, std::string pointer, Value value) {
        OutlineEntry result;
        result.kind = std::move(kind);
        result.type = std::move(type);
        result.pointer = std::move(pointer);
        result.value = value;
        return result;
    }

    void add(std::optional<OutlineEntry> one) {
        if (one) result_.entries.push_back(std::move(*one));
    }

    void single(const char* key, const char* type) {
        if (const auto member = root_.find(key)) add(read(type, std::string("/") + key, *member));
    }
    void each(const char* key, const char* type) {
        const auto list = root_.find(key);
        if (!list || !list->is_array()) return;
        std::size_t i = 0;
        for (const Value item : *list) add(read(type, "/" + std::string(key) + "/" + std::to_string(i++), item));
    }
    void named(const char* type, const std::string& pointer, Value value) {
        std::optional<OutlineEntry> one = read(type, pointer, value);
        if (one) one->label = std::string(value.key());
        add(std::move(one));
    }

    // An entry for a value that stands where a type is expected. nullopt if it cannot be of that type, or if there are
    // too many entries.
    std::optional<OutlineEntry> read(const std::string& type, const std::string& pointer, Value value) {
        if (count_ >= most_) {
            result_.has_more = true;
            return std::nullopt;
        }
        if (value.is_string() && (type == "field" || type == "object")) {
            ++count_;
            OutlineEntry one = entry("reference", type, pointer, value);
            one.label = std::string(value.string());
            return one;
        }
        if (type == "transform" && value.is_array()) return transforms(pointer, value);
        if (!value.is_object() || Keys::are_in(value)) return std::nullopt;
        ++count_;
        if (const CatalogueKind* only = vocabulary_.only(type)) {
            OutlineEntry one = entry(only->name, type, pointer, value);
            one.of = only;
            parameters(one, *only, value, pointer);
            if (type == "placed_object") object_with_phases(one, value);
            return one;
        }
        return of_choice(type, pointer, value);
    }

    // The name of an entry of "objects", and the materials of phases that it overrides.
    void object_with_phases(OutlineEntry& one, Value object) {
        if (const auto name = object.find("name"); name && name->is_string()) one.label = name->string();
        const auto phases = object.find("phases");
        if (!phases) return;
        for (const Value phase : *phases) {
            std::optional<OutlineEntry> entry = phase_entry_of(phase, one.pointer + "/phases/" + escaped(phase.key()));
            if (!entry) return;
            entry->slot = "phases";
            one.children.push_back(std::move(*entry));
        }
    }

    // {"kind": {parameters}}
    std::optional<OutlineEntry> of_choice(const std::string& type, const std::string& pointer, Value value) {
        const CatalogueKind* kind = value.size() == 1 ? vocabulary_.find(type, value[0].key()) : nullptr;
        // The parameters of a thin lens may stand alone.
        if (type == "camera" && !kind) {
            OutlineEntry one = entry("thin_lens", type, pointer, value);
            one.of = vocabulary_.find(type, one.kind);
            if (one.of) parameters(one, *one.of, value, pointer);
            return one;
        }
        if (value.size() == 0) return entry("", type, pointer, value);
        const Value member = value[0];
        OutlineEntry one = entry(kind ? kind->name : std::string(member.key()), type, pointer, value);
        one.of = kind;
        const std::string inner = pointer + "/" + escaped(member.key());
        if (!kind) return one;
        if (member.is_object())
            parameters(one, *kind, member, inner);
        else if (const KindParameter* lone = kind->lone_parameter())
            parameter(one, *lone, member, inner);
        return one;
    }

    OutlineEntry transforms(const std::string& pointer, Value list) {
        ++count_;
        OutlineEntry one = entry("list", "transform", pointer, list);
        items(one, list, "transform", "of", pointer);
        return one;
    }

    void items(OutlineEntry& parent, Value list, const std::string& type, const std::string& slot,
               const std::string& pointer) {
        if (!list.is_array()) return;
        std::size_t i = 0;
        for (const Value item : list) child(parent, type, slot, pointer + "/" + std::to_string(i++), item);
    }

    bool child(OutlineEntry& parent, const std::string& type, const std::string& slot, const std::string& pointer,
               Value value) {
        std::optional<OutlineEntry> one = read(type, pointer, value);
        if (!one) return false;
        one->slot = slot;
        parent.children.push_back(std::move(*one));
        return true;
    }

    void parameters(OutlineEntry& parent, const CatalogueKind& kind, Value object, const std::string& pointer) {
        for (const Value member : object) {
            const std::string at = pointer + "/" + escaped(member.key());
            const KindParameter* known = kind.parameter(member.key());
            if (known)
                parameter(parent, *known, member, at);
            else
                add_parameter(parent, member, pointer, nullptr);
        }
    }

    void parameter(OutlineEntry& parent, const KindParameter& p, Value value, const std::string& pointer) {
        if (p.control == "phase" || p.control == "phases") {
            if (value.is_string()) parent.phases.emplace_back(value.string());
            for (const Value item : value)
                if (item.is_string()) parent.phases.emplace_back(item.string());
        }
        if (p.slot && p.control == "curve") {
            stops(parent, p, value, pointer);
        } else if (p.slot && p.slot->is_list) {
            items(parent, value, p.slot->type, p.name, pointer);
            return;
        }
        if (p.slot && child(parent, p.slot->type, p.name, pointer, value)) return;
        OutlineParameter one{p.name, pointer, value, Keys::are_in(value), true, &p};
        parent.parameters.push_back(std::move(one));
    }

    // The stops of a ramp, [number, texture].
    void stops(OutlineEntry& parent, const KindParameter& p, Value list, const std::string& pointer) {
        std::size_t i = 0;
        for (const Value stop : list) {
            const std::string at = pointer + "/" + std::to_string(i++) + "/1";
            if (stop.is_array() && stop.size() == 2) (void)child(parent, p.slot->type, p.name, at, stop[1]);
        }
    }

    static void add_parameter(OutlineEntry& parent, Value member, const std::string& pointer, const KindParameter* of) {
        parent.parameters.push_back({std::string(member.key()), pointer + "/" + escaped(member.key()), member,
                                     Keys::are_in(member), parent.type == "scene", of});
    }

    // The entry of a phase: its material, and the parameters that are written next to it, such as the mass density.
    std::optional<OutlineEntry> phase_entry_of(Value phase, const std::string& pointer) {
        if (count_ >= most_) result_.has_more = true;
        if (result_.has_more) return std::nullopt;
        ++count_;
        OutlineEntry one = entry("", "material", pointer, phase);
        one.label = std::string(phase.key());
        one.phases.emplace_back(phase.key());
        for (const Value member : phase) {
            if (!member.key().empty() && is_phase_parameter(member.key())) {
                one.parameters.push_back({std::string(member.key()), pointer + "/" + escaped(member.key()), member,
                                          Keys::are_in(member), true, nullptr});
                continue;
            }
            if (!one.kind.empty() || member.key().empty()) continue;
            one.of = vocabulary_.find("material", member.key());
            one.kind = one.of ? one.of->name : std::string(member.key());
            if (one.of && member.is_object()) parameters(one, *one.of, member, pointer + "/" + escaped(member.key()));
        }
        return one;
    }

    // Whether a shape is a field, by the rules of the reader: a node that may be either is of the same type as its
    // child.
    bool is_field(Value shape) const {
        const auto shapes = root_.find("shapes");
        for (int steps = 0; steps < 1000; ++steps) {
            if (shape.is_string()) {
                const auto target = shapes->find(shape.string());
                if (!target) return true;
                shape = *target;
                continue;
            }
            if (!shape.is_object() || shape.size() != 1) return true;
            const bool may_be_object = vocabulary_.find("object", shape[0].key()) != nullptr;
            if (!may_be_object || !vocabulary_.find("field", shape[0].key())) return !may_be_object;
            const auto child = shape[0].find("of");
            if (!child) return true;
            shape = child->is_array() && child->size() > 0 ? (*child)[0] : *child;
        }
        return true;
    }

    const Vocabulary& vocabulary_;
    Value root_;
    Outline result_;
    std::size_t most_, count_ = 0;
};

}  // namespace

Outline outline_of(const Document& document, const Vocabulary& vocabulary, std::size_t most) {
    return Outliner(document, vocabulary, most).outline();
}

}  // namespace phasetree::tracer::studio
