#pragma once

#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "phasetree/io/parameter_type.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree {

/// Return the single member of an object that selects a kind, {"kind": {…}}. Nodes are written in the same way. Throws
/// SceneError unless its key is one of `kinds`. `what` names the choice in messages ("a material").
Value member_of_kind(const Document&, Value, std::string_view what, std::span<const std::string_view> kinds);

/// Check that the key of such a member is one of `kinds`. Throws SceneError as member_of_kind() does.
void check_kind(const Document&, Value member, std::string_view what, std::span<const std::string_view> kinds);

/// Whether a member is of the kind with this name, in either spelling (is_other_spelling).
bool is_kind(Value member, std::string_view name);

/// Read an object that selects a kind, and call f.template operator()<Kind>(member) for the selected one.
template <class... Kinds, class F>
void with_kind(TypeList<Kinds...>, const Document& document, Value value, std::string_view what, F&& f) {
    const std::string_view names[] = {Kinds::info.name...};
    const Value member = member_of_kind(document, value, what, names);
    ((is_kind(member, Kinds::info.name) ? f.template operator()<Kinds>(member) : void()), ...);
}

/// Read the parameters listed by T into their members. Members of missing optional parameters are unchanged. Unknown
/// keys are not checked here; call reader.finish().
template <class T>
void read_parameters(ObjectReader& reader, T& target) {
    // Mark all names first, so that a present parameter is never suggested as the misspelling of a missing one.
    T::parameters([&](auto, const auto& p) { reader.allow({p.name}); });
    T::parameters([&](auto member, const auto& p) {
        auto& place = target.*member;
        if (p.optional && !reader.value(p.name)) return;
        place = ParameterType<std::remove_cvref_t<decltype(place)>, std::remove_cvref_t<decltype(p)>>::read(
            reader.document(), reader.required_value(p.name), "\"" + std::string(p.name) + "\"", p);
    });
}

/// Convert a ParameterError to a SceneError at the parameter's position in the object of `reader`.
SceneError located(ObjectReader& reader, const ParameterError&);

/// Return make(), which builds something from what `reader` has read. If it throws ParameterError or
/// std::invalid_argument, throw a SceneError instead: at the parameter, or at the object.
template <class Make>
decltype(auto) with_place(ObjectReader& reader, Make&& make) {
    try {
        return make();
    } catch (const ParameterError& e) {
        throw located(reader, e);
    } catch (const std::invalid_argument& e) {
        throw reader.document().error(reader.object(), e.what());
    }
}

/// Read an object as a Kind, and return make(kind). Throws SceneError for unknown keys. `what` names the object in
/// messages ("the sphere light").
template <class Kind, class Make>
auto read_kind(const Document& document, Value object, std::string_view what, Make&& make) {
    ObjectReader reader(document, object, what);
    Kind kind{};
    read_parameters(reader, kind);
    auto made = with_place(reader, [&] { return make(kind); });
    reader.finish();
    return made;
}

}  // namespace phasetree
