// Reads the objects of a scene file and their placement. Phases are numbered in the order in which they are found:
// those of the file itself, then those of each other file that is used, and those that get their own material from an
// object.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>

#include "media/medium.hpp"
#include "phasetree/io/read_kind.hpp"
#include "phasetree/io/suggest.hpp"
#include "phasetree/model/renumber.hpp"
#include "phasetree/trace/tracer.hpp"
#include "phasetree/tree/unbounded.hpp"
#include "scene/nothing_left.hpp"
#include "scene/object_kinds.hpp"
#include "scene/placed.hpp"
#include "scene/read_parts.hpp"
#include "scene/read_transform.hpp"
#include "scene/unbounded_error.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::string_view name_of_tree = "tree";

/// An object in the file, before its phases are numbered for the scene.
struct Found {
    Document document;  ///< the document with its tree
    Value at;           ///< its location in the scene's file, for errors
    PhaseNames names;   ///< names of its tree's phases
    std::optional<Value> own_phases;
    std::string from;  ///< the file that it is read from; empty if its tree is in the scene's own file
    PlacedObject object;
};

class ObjectsReader {
  public:
    ObjectsReader(const Document& document, const Shutter& shutter, NodePlaces* node_places)
        : document_(document), shutter_(shutter), root_(document.root()), node_places_(node_places) {
        model_.phases = read_phase_names(document);
        if (const auto phases = root_.find("phases"))
            for (const Value phase : *phases) model_.materials.push_back({document, phase});
    }

    ObjectsModel read() && {
        find_objects();
        for (Found& found : found_) add(found);
        read_groups();
        if (const auto list = root_.find("instances")) read_instances(*list, "\"instances\"", model_.placed.instances);
        add_default_instances();
        if (model_.placed.copies() > max_copies)
            throw document_.error(root_,
                                  fmt::format("groups and instances produce {} copies of objects; the limit is {}",
                                              model_.placed.copies(), max_copies));
        return std::move(model_);
    }

  private:
    // Finds the objects and reads their trees. Those in the scene's own file are read together, because they share its
    // "shapes".
    void find_objects() {
        std::vector<Value> trees;
        std::vector<std::size_t> of;
        if (const auto tree = root_.find("tree")) {
            found_.push_back({document_, *tree, model_.phases, {}, "", {std::string(name_of_tree), {}, {}}});
            trees.push_back(*tree);
            of.push_back(0);
        }
        const Value list = root_.find("objects").value();
        if (!list.is_array() || list.size() == 0)
            throw document_.error(list, "\"objects\" must be a list of at least one object");
        for (const Value value : list) {
            ObjectReader reader(document_, value, "the object");
            ObjectParameters p;
            read_parameters(reader, p);
            reader.finish();
            check_name(reader.required_value("name"), p.name);
            if (p.tree.has_value() == p.file.has_value())
                throw document_.error(value, "an object must have either \"tree\" or \"file\"");
            found_.push_back({document_, value, model_.phases, p.phases, "", {p.name, {}, {}}});
            if (p.transform) {
                ReadTransform read = read_transform(document_, *p.transform, shutter_);
                found_.back().object.first = read.at_opening;
                if (read.moving) found_.back().object.moving = moving_number(std::move(*read.moving));
            }
            if (p.tree) {
                trees.push_back(*p.tree);
                of.push_back(found_.size() - 1);
            } else {
                take(*p.file, found_.back());
            }
        }
        const std::vector<Phased> read =
            phasetree::read_objects(document_, model_.phases, trees, file_readers(), node_places_);
        for (std::size_t i = 0; i < read.size(); ++i) found_[of[i]].object.tree = read[i];
    }

    // The document of another file. If it does not exist, the error is located where it is named.
    Document document_beside(Value named, const std::string& name) const {
        try {
            return document_.beside(named);
        } catch (const SceneError& e) {
            if (e.line() > 0) throw;
            throw document_.error(named, fmt::format("{}: {}", name, e.message()), e.suggestion());
        }
    }

    // Reads the tree of another file. A file named by several objects is read once.
    void take(Value named, Found& found) {
        const std::string name = as<std::string>(document_, named, "\"file\"");
        auto known = files_.find(name);
        if (known == files_.end()) {
            const Document other = document_beside(named, name);
            const Value root = other.root();
            if (has_objects(other))
                throw document_.error(named, fmt::format("\"{}\" is a scene of several objects; use a scene with a "
                                                         "single tree, such as one of its files",
                                                         name));
            if (!root.is_object() || !root.find("tree"))
                throw document_.error(named, fmt::format("\"{}\" has no \"tree\"", name));
            known = files_.emplace(name, TakenFile{other, read_tree(other, file_readers(), node_places_)}).first;
        }
        found.document = known->second.document;
        found.names = known->second.tree.phases;
        found.object.tree = known->second.tree.object;
        found.from = name;
    }

    void check_name(Value at, const std::string& name) const {
        if (name.empty()) throw document_.error(at, "\"name\" must not be empty");
        const bool is_there = std::ranges::any_of(found_, [&](const Found& f) { return f.object.name == name; });
        if (is_there) throw document_.error(at, fmt::format("another object is already named \"{}\"", name));
    }

    // Adds a phase to the scene and returns its number. If the name is already used, a number is appended.
    Phase new_phase(std::string name, const Document& document, Value material, Value at) {
        std::vector<std::string>& names = model_.phases.names;
        if (names.size() == Phase::capacity)
            throw document_.error(
                at, fmt::format("the objects of the scene have more than {} phases in total", Phase::capacity - 1));
        const std::string wanted = name;
        for (int i = 2; std::ranges::find(names, name) != names.end(); ++i) name = fmt::format("{} {}", wanted, i);
        names.push_back(std::move(name));
        model_.materials.push_back({document, material});
        return Phase{static_cast<std::uint8_t>(names.size() - 1)};
    }

    // The material that the object itself defines for the phase with this name.
    std::optional<Value> own_material(const Found& found, const std::string& phase) const {
        return found.own_phases ? found.own_phases->find(phase) : std::nullopt;
    }

    void check_own_phases(const Found& found) const {
        if (!found.own_phases) return;
        if (!found.own_phases->is_object())
            throw document_.error(*found.own_phases, "\"phases\" must be an object of materials");
        for (const Value own : *found.own_phases)
            if (own.key() == found.names.names[0] ||
                std::ranges::find(found.names.names, own.key()) == found.names.names.end())
                throw document_.error(own.key_offset(), fmt::format("the object has no phase \"{}\"", own.key()),
                                      closest(own.key(), std::span(found.names.names).subspan(1)));
    }

    void add(Found& found) {
        check_own_phases(found);
        std::array<Phase, Phase::capacity> numbers{};
        bool is_changed = false;
        for (std::size_t i = 1; i < found.names.names.size(); ++i) {
            const std::string& phase = found.names.names[i];
            const std::string name = fmt::format("{}.{}", found.object.name, phase);
            Phase& number = numbers[i];
            number = Phase{static_cast<std::uint8_t>(i)};
            if (const auto own = own_material(found, phase)) {
                number = new_phase(name, document_, *own, found.at);
            } else if (!found.from.empty()) {
                Phase& of_file = files_.find(found.from)->second.numbers[i];
                if (of_file == phasetree::vacuum)
                    of_file = new_phase(name, found.document, found.document.root().find("phases")->find(phase).value(),
                                        found.at);
                number = of_file;
            }
            is_changed = is_changed || number.index != i;
        }
        try {
            if (is_changed)
                found.object.tree = with_numbers(found.object.tree, std::span(numbers).first(found.names.names.size()));
            found.object.tree = with_bounds(found.object.tree);
            (void)prepare_to_trace(found.object.tree);  // only checks whether the tree can be traced
        } catch (const UnboundedError&) {
            throw unbounded_error(found);
        } catch (const ModelError& e) {
            throw document_.error(found.at, fmt::format("\"{}\": {}", found.object.name, e.what()));
        }
        object_numbers_.emplace(found.object.name, static_cast<std::uint32_t>(model_.placed.objects.size()));
        model_.placed.objects.push_back(found.object);
    }

    // Reads the object's tree again to find the positions of its nodes.
    SceneError unbounded_error(const Found& found) const {
        NodePlaces places;
        Phased tree;
        if (!found.from.empty()) {
            tree = read_tree(found.document, file_readers(), &places).object;
        } else {
            const Value own = found.at.find(name_of_tree).value_or(found.at);
            tree =
                phasetree::read_objects(document_, model_.phases, std::span(&own, 1), file_readers(), &places).front();
        }
        return tracer::unbounded_error(found.document, tree, places, fmt::format("\"{}\": ", found.object.name));
    }

    // Renumbers the phases. The nodes' positions in the text do not change.
    Phased with_numbers(const Phased& tree, std::span<const Phase> numbers) const {
        if (!node_places_) return renumbered(tree, numbers);
        return renumbered(tree, numbers, [&](const void* of, const auto& copy) { node_places_->add_copy(of, copy); });
    }

    void read_groups() {
        groups_ = root_.find("groups");
        if (!groups_) return;
        if (!groups_->is_object())
            throw document_.error(*groups_, "\"groups\" must be an object with a list of instances under each name");
        for (const Value group : *groups_) (void)group_number(group);
    }

    // The number of a group, which is read now if necessary. The groups that it names are read before it, so they have
    // smaller numbers.
    std::uint32_t group_number(Value group) {
        const std::string name(group.key());
        if (const auto known = group_numbers_.find(name); known != group_numbers_.end()) return known->second;
        if (object_number(name))
            throw document_.error(group.key_offset(), fmt::format("an object is already named \"{}\"", name));
        if (std::ranges::find(open_, name) != open_.end())
            throw document_.error(group.key_offset(), fmt::format("the group \"{}\" contains itself", name));
        // The depth is checked twice, because groups may be listed before or after those that they name: here for the
        // recursion of this function, and below for the recursion of rays.
        const auto require_depth = [&](std::size_t depth) {
            if (depth > deepest)
                throw document_.error(group.key_offset(),
                                      fmt::format("groups are nested more than {} levels deep", deepest));
        };
        require_depth(open_.size() + 1);
        open_.push_back(name);
        PlacedGroup made;
        made.name = name;
        made.offset = group.key_offset();
        read_instances(group, fmt::format("the group \"{}\"", name), made.instances);
        for (const Instance& instance : made.instances)
            if (instance.is_group) made.depth = std::max(made.depth, 1 + model_.placed.groups[instance.of].depth);
        require_depth(made.depth);
        made.copies = model_.placed.copies_of(made.instances);
        if (made.copies > max_copies)
            throw document_.error(group.key_offset(),
                                  fmt::format("the group \"{}\" has {} copies of objects; the limit is {}", name,
                                              made.copies, max_copies));
        open_.pop_back();
        const auto number = static_cast<std::uint32_t>(model_.placed.groups.size());
        model_.placed.groups.push_back(std::move(made));
        group_numbers_.emplace(name, number);
        return number;
    }

    std::optional<std::uint32_t> object_number(std::string_view name) const {
        const auto found = object_numbers_.find(name);
        return found == object_numbers_.end() ? std::nullopt : std::optional(found->second);
    }

    void read_instances(Value list, const std::string& what, std::vector<Instance>& instances) {
        if (!list.is_array() || list.size() == 0)
            throw document_.error(list, what + " must be a list of at least one instance");
        for (const Value value : list) {
            ObjectReader reader(document_, value, "the instance");
            InstanceParameters p;
            read_parameters(reader, p);
            reader.finish();
            if (p.transforms && p.file)
                throw document_.error(value, "an instance must have either \"transforms\" or \"file\"");
            Instance instance = instance_of(reader.required_value("of"), p.of);
            Transform outer;
            if (p.transform) {
                ReadTransform read = read_transform(document_, *p.transform, shutter_);
                if (read.moving)
                    instance.moving = moving_number(std::move(*read.moving));
                else
                    outer = read.at_opening;
            }
            std::vector<Transform> many;
            if (p.transforms) many = read_transforms(document_, *p.transforms);
            if (p.file) many = read_transforms_file(document_, *p.file);
            if (!p.transforms && !p.file) many.emplace_back();
            instances_read_ += many.size();
            if (instances_read_ > most_instances)
                throw document_.error(value, fmt::format("there are more than {} instances in total", most_instances));
            for (const Transform& one : many) {
                instance.transform = outer * one;
                instances.push_back(instance);
            }
        }
    }

    Instance instance_of(Value at, const std::string& name) {
        if (const auto object = object_number(name)) {
            is_named_.resize(model_.placed.objects.size());
            is_named_[*object] = true;
            return {{}, *object, false};
        }
        if (const auto group = groups_ ? groups_->find(name) : std::nullopt) return {{}, group_number(*group), true};
        std::vector<std::string> names;
        for (const PlacedObject& object : model_.placed.objects) names.push_back(object.name);
        if (groups_)
            for (const Value group : *groups_) names.emplace_back(group.key());
        throw document_.error(at, fmt::format("unknown object or group \"{}\"", name), closest(name, names));
    }

    std::uint32_t moving_number(MovingTransform moving) {
        model_.placed.moving.push_back(std::move(moving));
        return static_cast<std::uint32_t>(model_.placed.moving.size() - 1);
    }

    // Adds one instance of each object that no instance or group names, with only its own transform. They come first,
    // in the order of the file.
    void add_default_instances() {
        is_named_.resize(model_.placed.objects.size());
        std::vector<Instance> alone;
        for (std::uint32_t i = 0; i < is_named_.size(); ++i)
            if (!is_named_[i]) alone.push_back({{}, i, false});
        auto& instances = model_.placed.instances;
        instances.insert(instances.begin(), alone.begin(), alone.end());
        if (instances.empty())
            throw document_.error(root_,
                                  "the scene is empty: all objects are in groups, and there are no \"instances\"");
    }

    static constexpr std::size_t deepest = 32;  // maximum nesting depth of groups

    struct TakenFile {
        Document document;
        SceneTree tree;
        std::array<Phase, Phase::capacity> numbers{};  // in the scene; the vacuum's for phases without a number yet
    };

    const Document& document_;
    Shutter shutter_;
    Value root_;
    NodePlaces* node_places_;
    ObjectsModel model_;
    std::vector<Found> found_;
    std::map<std::string, TakenFile, std::less<>> files_;
    std::optional<Value> groups_;
    std::vector<std::string> open_;  // groups being read, to detect cycles
    std::map<std::string, std::uint32_t, std::less<>> object_numbers_, group_numbers_;
    std::vector<bool> is_named_;
    std::uint64_t instances_read_ = 0;
};

}  // namespace

bool has_objects(const Document& document) {
    return document.root().is_object() && document.root().find("objects");
}

ObjectsModel read_placed_objects(const Document& document, const Shutter& shutter, NodePlaces* node_places) {
    return ObjectsReader(document, shutter, node_places).read();
}

}  // namespace phasetree::tracer
