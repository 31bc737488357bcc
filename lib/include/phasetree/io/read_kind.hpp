#pragma once

#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "phasetree/io/parameter_type.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree {

/// A choice between kinds is an object of one member, {"kind": {…}}, as nodes are. This is that member, whose key is
/// one of `kinds`; SceneError otherwise. `what` names the choice in messages ("a material").
Value member_of_kind(const Document&, Value, std::string_view what, std::span<const std::string_view> kinds);

/// The same, and calls f.template operator()<Kind>(member) for the kind that it is.
template <class... Kinds, class F>
void with_kind(TypeList<Kinds...>, const Document& document, Value value, std::string_view what, F&& f) {
    const std::string_view names[] = {Kinds::info.name...};
    const Value member = member_of_kind(document, value, what, names);
    ((Kinds::info.name == member.key() ? f.template operator()<Kinds>(member) : void()), ...);
}

/// Reads the parameters that T lists into the members that it lists them for. What is optional and missing stays as
/// it is. Other keys are not checked here; reader.finish() does that.
template <class T>
void read_parameters(ObjectReader& reader, T& target) {
    // All are named first, so that none of them is taken for a misspelling of one that is missing.
    T::parameters([&](auto, const auto& p) { reader.allow({p.name}); });
    T::parameters([&](auto member, const auto& p) {
        auto& place = target.*member;
        if (p.optional && !reader.value(p.name)) return;
        place = ParameterType<std::remove_cvref_t<decltype(place)>, std::remove_cvref_t<decltype(p)>>::read(
            reader.document(), reader.required_value(p.name), "\"" + std::string(p.name) + "\"", p);
    });
}

/// Locates an error at its parameter in what `reader` has read.
SceneError located(ObjectReader& reader, const ParameterError&);

/// Calls make(), which makes something of what `reader` has read. A ParameterError becomes one at the parameter, a
/// std::invalid_argument one at the object.
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

/// Reads the object as a Kind and returns what make(kind) returns; refuses keys that the kind does not list. `what`
/// names the object in messages ("the sphere light").
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
