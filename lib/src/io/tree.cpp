#include "phasetree/io/tree.hpp"

#include <fmt/format.h>

#include <map>

#include "io/json/string_offset.hpp"
#include "io/node_files.hpp"
#include "model/text_error.hpp"
#include "phasetree/io/keys.hpp"
#include "phasetree/io/meant_kind.hpp"
#include "phasetree/io/object_reader.hpp"
#include "phasetree/io/parameter_type.hpp"
#include "phasetree/io/suggest.hpp"
#include "tree/node.hpp"

namespace phasetree {

using model::PreparationTogether;

namespace {

template <class Handle>
using NodesOf = std::conditional_t<std::is_same_v<Handle, Field>, FieldNodes, PhasedNodes>;

template <class Handle>
constexpr std::string_view kind_name = std::is_same_v<Handle, Field> ? "a plain field" : "an object of phases";

/// What to do if the other kind of handle is found.
template <class Handle>
constexpr std::string_view kind_remedy =
    std::is_same_v<Handle, Field> ? "use the field before it is filled, or combine objects with \"over\""
                                  : "fill fields with \"set\", and combine objects with \"over\"";

template <class List>
bool has_node(std::string_view name) {
    bool found = false;
    for_each_type(List(), [&]<class N>() { found = found || N::info.name == name; });
    return found;
}

static_assert(Document::max_depth >= 3 * max_tree_depth + 8, "the deepest tree that there may be can be written");

class Reader {
  public:
    Reader(const Document& document, PhaseNames names, std::optional<Value> shapes, const FileReaders& files,
           KnownShapes known = {}, NodePlaces* places = nullptr)
        : document_(document),
          names_(std::move(names)),
          shapes_(shapes),
          files_(document, files, preparation_),
          places_(places),
          fields_(std::move(known.fields)),
          objects_(std::move(known.objects)) {}

    template <class Handle>
    Handle read(Value value) {
        const Level level(*this, levels_, 2 * max_tree_depth, value);
        if (value.is_string()) return named<Handle>(value);
        if (!value.is_object() || value.size() != 1) {
            throw document_.error(value, value.is_object()
                                             ? "a node must be an object with one member, {\"name\": {…}}, but has " +
                                                   std::to_string(value.size())
                                             : fmt::format("expected {}: a node {{\"name\": {{…}}}} or the name of a "
                                                           "shape, but found {}",
                                                           kind_name<Handle>, name_of(value.kind())));
        }
        const Value member = value[0];
        Handle (Reader::*make_node)(Value) = nullptr;
        for_each_type(NodesOf<Handle>(), [&]<class N>() {
            if (!make_node && N::info.name == member.key()) make_node = &Reader::make<Handle, N>;
        });
        if (!make_node) throw unknown_node<Handle>(member);
        return (this->*make_node)(member);
    }

    // Reads the shapes that the tree did not use, so that mistakes in them are found, too.
    void read_unused() {
        if (!shapes_) return;
        for (const Value shape : *shapes_) {
            const std::string name(shape.key());
            if (is_field(shape)) {
                if (!fields_.contains(name)) fields_.emplace(name, read<Field>(shape));
            } else if (!objects_.contains(name)) {
                objects_.emplace(name, read<Phased>(shape));
            }
        }
    }

  private:
    // Counts the nesting of nodes, and of nodes and names, including through named shapes, so that no file can exhaust
    // the stack.
    struct Level {
        Level(const Reader& reader, std::size_t& count, std::size_t most, Value value) : count_(count) {
            if (count_ == most)
                throw reader.document_.error(value, fmt::format("the tree is deeper than {} nodes", max_tree_depth));
            ++count_;
        }
        ~Level() { --count_; }
        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;

      private:
        std::size_t& count_;
    };

    template <class Handle>
    std::map<std::string, Handle, std::less<>>& known() {
        if constexpr (std::is_same_v<Handle, Field>)
            return fields_;
        else
            return objects_;
    }

    template <class Handle>
    Handle named(Value reference) {
        const std::string_view name = reference.string();
        if (const auto found = known<Handle>().find(name); found != known<Handle>().end()) return found->second;
        const std::optional<Value> shape = shapes_ ? shapes_->find(name) : std::nullopt;
        if (!shape) {
            using Other = std::conditional_t<std::is_same_v<Handle, Field>, Phased, Field>;
            if (known<Other>().contains(name)) throw other_kind<Handle>(reference);
            throw document_.error(reference, fmt::format("unknown shape \"{}\"", name), closest(name, shape_names()));
        }
        if (std::find(open_.begin(), open_.end(), name) != open_.end())
            throw document_.error(reference, fmt::format("the shape \"{}\" contains itself", name));
        if (is_field(*shape) != std::is_same_v<Handle, Field>) throw other_kind<Handle>(reference);
        open_.emplace_back(name);
        Handle result = read<Handle>(*shape);
        open_.pop_back();
        known<Handle>().emplace(std::string(name), result);
        return result;
    }

    template <class Handle>
    SceneError other_kind(Value reference) const {
        using Other = std::conditional_t<std::is_same_v<Handle, Field>, Phased, Field>;
        return document_.error(reference, fmt::format("\"{}\" is {}, but {} is required here; {}", reference.string(),
                                                      kind_name<Other>, kind_name<Handle>, kind_remedy<Handle>));
    }

    // Whether a shape is a plain field, judging by its node's name. A warp is of the same kind as its child.
    bool is_field(Value shape) const {
        for (std::size_t steps = 0; steps < 2 * max_tree_depth; ++steps) {
            if (shape.is_string()) {
                const std::optional<Value> target = shapes_ ? shapes_->find(shape.string()) : std::nullopt;
                if (!target) return true;
                shape = *target;
                continue;
            }
            if (!shape.is_object() || shape.size() != 1) return true;
            const std::string_view name = shape[0].key();
            const bool may_be_field = has_node<FieldNodes>(name), may_be_object = has_node<PhasedNodes>(name);
            // Report the unknown node here, rather than as a field where an object is needed.
            if (!may_be_field && !may_be_object) throw unknown_node(shape[0], names_of(FieldNodes(), PhasedNodes()));
            if (!may_be_object) return true;
            if (!may_be_field) return false;
            const std::optional<Value> child = shape[0].find("of");
            if (!child) return true;
            // The items of a list, such as that of levels of detail, are all of one kind.
            shape = child->is_array() && child->size() > 0 ? (*child)[0] : *child;
        }
        return true;
    }

    template <class Handle, class N>
    Handle make(Value member) {
        const Level level(*this, nodes_, max_tree_depth, member);
        N node{};
        if (member.is_array())
            read_list(node, member);
        else if (!(member.is_string() && read_text(node, member)))
            read_parameters(node, member);
        try {
            Handle made = made_of<Handle>(node, member);
            if (places_) places_->add(made, document_, member.key_offset());
            return made;
        } catch (const TextError& e) {
            const Value text = member.is_string() ? member : member.find(e.parameter()).value();
            throw document_.error(io::offset_in_string(document_.text(), text.offset(), e.offset()), e.message());
        } catch (const ModelError& e) {
            throw document_.error(member.key_offset(), e.what());
        }
    }

    // Creates the node from its parameters, and from its file if it has one.
    template <class Handle, class N>
    Handle made_of(N& node, Value member) {
        if constexpr (io::MadeFromFile<N>) {
            if (const std::optional<Value> file = member.find("file")) return files_.made<Handle>(node, *file);
        }
        return Handle(std::move(node));
    }

    template <class N>
    void read_parameters(N& node, Value member) {
        ObjectReader reader(document_, member, fmt::format("\"{}\"", N::info.name));
        // Register every key first, so that a misspelt key is reported before the one that it was meant to be is
        // reported missing.
        for_each_parameter(node, [&](auto&, const Parameter& p) { reader.allow({p.name}); });
        reader.finish();
        for_each_parameter(node, [&](auto& target, const auto& p) {
            if (p.optional && !reader.value(p.name)) return;
            read_value(target, reader.required_value(p.name), p);
        });
    }

    // Reads the text of a node whose only required parameter is a text. Returns whether it is such a node.
    template <class N>
    bool read_text(N& node, Value text) {
        std::size_t required = 0;
        std::string* only = nullptr;
        for_each_parameter(node, [&](auto& target, const Parameter& p) {
            if (p.optional) return;
            ++required;
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(target)>, std::string>) only = &target;
        });
        if (required != 1 || !only) return false;
        *only = text.string();
        return true;
    }

    template <class N>
    void read_list(N& node, Value list) {
        std::string missing, single;
        for_each_parameter(node, [&](auto& target, const Parameter& p) {
            if (p.optional) return;
            if constexpr (requires { target.push_back(target.front()); }) {
                if (single.empty()) {
                    single = p.name;
                    read_value(target, list, p);
                    return;
                }
            }
            if (missing.empty()) missing = p.name;
        });
        if (single.empty())
            throw document_.error(list,
                                  fmt::format("the parameters of \"{}\" must be an object, not a list", N::info.name));
        if (!missing.empty())
            throw document_.error(
                list, fmt::format("\"{0}\" needs \"{1}\" beside the list: {{\"{0}\": {{\"{2}\": […], \"{1}\": …}}}}",
                                  N::info.name, missing, single));
    }

    void read_value(std::string& target, Value value, const ChoiceParameter& p) {
        target = ParameterType<std::string, ChoiceParameter>::read(document_, value, fmt::format("\"{}\"", p.name), p);
    }

    template <class T>
    void read_value(T& target, Value value, const Parameter& p) {
        const std::string what = fmt::format("\"{}\"", p.name);
        if constexpr (std::is_same_v<T, Field> || std::is_same_v<T, Phased>) {
            target = read<T>(value);
        } else if constexpr (std::is_same_v<T, std::vector<Field>> || std::is_same_v<T, std::vector<Phased>>) {
            if (!value.is_array())
                throw document_.error(value, fmt::format("{} must be a list, but is {}", what, name_of(value.kind())));
            if (value.size() == 0) throw document_.error(value, fmt::format("{} must not be empty", what));
            for (const Value item : value) target.push_back(read<typename T::value_type>(item));
        } else if constexpr (std::is_same_v<T, std::vector<float>> || std::is_same_v<T, std::vector<glm::vec2>> ||
                             std::is_same_v<T, std::vector<glm::vec3>> || std::is_same_v<T, std::vector<Phase>>) {
            if (p.one_for_all && (value.is_number() || Keys::are_in(value)))
                return read_value(target.emplace_back(), value, p);
            if (!value.is_array())
                throw document_.error(
                    value, fmt::format("{} must be {}list, but is {}", what, p.one_for_all ? "a number or a " : "a ",
                                       name_of(value.kind())));
            if (value.size() == 0) throw document_.error(value, fmt::format("{} must not be empty", what));
            for (const Value item : value) read_value(target.emplace_back(), item, p);
        } else if constexpr (std::is_same_v<T, Phase>) {
            target = phase(value, what);
        } else if constexpr (requires { target.content; }) {
            target.path = as<std::string>(document_, value, what);
            if (target.path.empty()) throw document_.error(value, fmt::format("{} must not be empty", what));
        } else if constexpr (std::is_same_v<T, PhaseSet>) {
            if (value.is_string()) {
                target = PhaseSet::of(phase_or_vacuum(value, what));
            } else if (value.is_array() && value.size() > 0) {
                for (const Value item : value) target = target | PhaseSet::of(phase_or_vacuum(item, what));
            } else {
                throw document_.error(value, fmt::format("{} must be the name of a phase or a list of names", what));
            }
        } else {
            target = as<T>(document_, value, what, range_of(p.limits));
        }
    }

    // A set may contain the vacuum; nodes that cannot use it reject it themselves.
    Phase phase_or_vacuum(Value value, const std::string& what) const {
        return value.is_string() && value.string() == names_.names[0] ? vacuum : phase(value, what);
    }

    Phase phase(Value value, const std::string& what) const {
        if (!value.is_string())
            throw document_.error(
                value, fmt::format("{} must be the name of a phase, but is {}", what, name_of(value.kind())));
        for (std::size_t i = 1; i < names_.names.size(); ++i)
            if (names_.names[i] == value.string()) return Phase{static_cast<std::uint8_t>(i)};
        if (value.string() == names_.names[0])
            throw document_.error(value, fmt::format("{} must be a phase other than the vacuum", what));
        const std::span<const std::string> phases = std::span(names_.names).subspan(1);
        const auto meant = closest(value.string(), phases);
        throw document_.error(
            value, fmt::format("unknown phase \"{}\"{}", value.string(), meant ? "" : valid_names("phase", phases)),
            meant);
    }

    template <class Handle>
    SceneError unknown_node(Value member) {
        using Other = std::conditional_t<std::is_same_v<Handle, Field>, Phased, Field>;
        if (has_node<NodesOf<Other>>(member.key()))
            return document_.error(member.key_offset(),
                                   fmt::format("\"{}\" makes {}, but {} is required here; {}", member.key(),
                                               kind_name<Other>, kind_name<Handle>, kind_remedy<Handle>));
        return unknown_node(member, names_of(NodesOf<Handle>()));
    }
    SceneError unknown_node(Value member, const std::vector<std::string>& known) const {
        return document_.error(member.key_offset(), fmt::format("unknown node \"{}\"", member.key()),
                               meant_kind(member.key(), known));
    }
    template <class... Lists>
    static std::vector<std::string> names_of(Lists... lists) {
        std::vector<std::string> all;
        (for_each_type(lists, [&]<class N>() { all.emplace_back(N::info.name); }), ...);
        return all;
    }

    std::vector<std::string> shape_names() const {
        std::vector<std::string> all;
        if (shapes_)
            for (const Value shape : *shapes_) all.emplace_back(shape.key());
        return all;
    }

    const Document& document_;
    PreparationTogether preparation_;
    PhaseNames names_;
    std::optional<Value> shapes_;
    io::NodeFiles files_;
    NodePlaces* places_;
    std::map<std::string, Field, std::less<>> fields_;
    std::map<std::string, Phased, std::less<>> objects_;
    std::vector<std::string> open_;  // shapes being read, for detecting cycles
    std::size_t levels_ = 0, nodes_ = 0;
};

PhaseNames read_phases(const Document& document, Value root) {
    const std::optional<Value> phases = root.find("phases");
    if (!phases) throw document.error(root, "the scene needs \"phases\"");
    if (!phases->is_object())
        throw document.error(*phases, fmt::format("\"phases\" must be an object, but is {}", name_of(phases->kind())));
    PhaseNames names;
    for (const Value phase : *phases) {
        if (phase.key() == names.names[0])
            throw document.error(phase.key_offset(), "\"vacuum\" is reserved and cannot be declared");
        if (names.names.size() == Phase::capacity)
            throw document.error(phase.key_offset(), fmt::format("more than {} phases", Phase::capacity - 1));
        names.names.emplace_back(phase.key());
    }
    if (names.size() == 0)
        throw document.error(*phases, "\"phases\" must not be empty; remove it if the scene has no \"tree\"");
    return names;
}

std::optional<Value> shapes_of(const Document& document) {
    const Value root = document.root();
    const std::optional<Value> shapes = root.is_object() ? root.find("shapes") : std::nullopt;
    if (shapes && !shapes->is_object())
        throw document.error(*shapes, fmt::format("\"shapes\" must be an object, but is {}", name_of(shapes->kind())));
    return shapes;
}

}  // namespace

SceneTree read_tree(const Document& document, const FileReaders& files, NodePlaces* places) {
    const Value root = document.root();
    if (!root.is_object())
        throw document.error(root, fmt::format("a scene must be an object, but is {}", name_of(root.kind())));
    PhaseNames names = read_phases(document, root);
    const std::optional<Value> shapes = shapes_of(document);
    const std::optional<Value> tree = root.find("tree");
    if (!tree) throw document.error(root, "the scene needs \"tree\"");
    Reader reader(document, names, shapes, files, {}, places);
    SceneTree result{names, reader.read<Phased>(*tree)};
    reader.read_unused();
    return result;
}

PhaseNames read_phase_names(const Document& document) {
    const Value root = document.root();
    return root.is_object() && root.find("phases") ? read_phases(document, root) : PhaseNames();
}

std::vector<Phased> read_objects(const Document& document, const PhaseNames& names, std::span<const Value> objects,
                                 const FileReaders& files, NodePlaces* places) {
    Reader reader(document, names, shapes_of(document), files, {}, places);
    std::vector<Phased> result;
    for (const Value object : objects) result.push_back(reader.read<Phased>(object));
    reader.read_unused();
    return result;
}

Field read_field(const Document& document, const PhaseNames& names, KnownShapes known, const FileReaders& files) {
    return Reader(document, names, std::nullopt, files, std::move(known)).read<Field>(document.root());
}

Phased read_object(const Document& document, const PhaseNames& names, KnownShapes known, const FileReaders& files) {
    return Reader(document, names, std::nullopt, files, std::move(known)).read<Phased>(document.root());
}

Field read_field(const Document& document, Value value, const FileReaders& files) {
    return Reader(document, read_phase_names(document), shapes_of(document), files).read<Field>(value);
}

}  // namespace phasetree
