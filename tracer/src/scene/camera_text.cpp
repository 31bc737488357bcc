#include "scene/camera_text.hpp"

#include <fmt/format.h>

#include <type_traits>

#include "phasetree/io/parameter_type.hpp"
#include "scene/camera_kinds.hpp"

namespace phasetree::tracer {

namespace {

std::string name_of(const PixelFilter& filter) {
    for (const std::string_view name : names_of_filters()) {
        const PixelFilter named = filter_of_name(name);
        if (named.shape() == filter.shape() && named.radius() == filter.radius()) return std::string(name);
    }
    return ThinLensKind().filter_name;  // no scene file gives another
}

template <class Kind>
std::string members(const Kind& kind) {
    const Kind usual{};
    std::string text;
    Kind::parameters([&](auto member, const auto& p) {
        const auto& value = kind.*member;
        using T = std::remove_cvref_t<decltype(value)>;
        if (p.optional && value == usual.*member) return;
        text += fmt::format("{}\"{}\": {}", text.empty() ? "" : ", ", p.name,
                            ParameterType<T, std::remove_cvref_t<decltype(p)>>::written(value));
    });
    return "{" + text + "}";
}

// The kind of a camera with these parameters writes them; a thin lens need not be named.
template <class Kind, class Parameters>
void write_if_of(const Parameters& parameters, const PixelFilter& filter, std::string& text) {
    if constexpr (std::is_base_of_v<Parameters, Kind>) {
        Kind kind{};
        static_cast<Parameters&>(kind) = parameters;
        kind.filter_name = name_of(filter);
        text = std::is_same_v<Kind, ThinLensKind> ? members(kind)
                                                  : fmt::format("{{\"{}\": {}}}", Kind::info.name, members(kind));
    }
}

template <class... Kinds, class Parameters>
std::string written(TypeList<Kinds...>, const Parameters& parameters, const PixelFilter& filter) {
    std::string text;
    (write_if_of<Kinds>(parameters, filter, text), ...);
    return text;
}

}  // namespace

std::string camera_text(const AnyCameraParameters& camera, const PixelFilter& filter) {
    return std::visit([&](const auto& parameters) { return written(CameraKinds(), parameters, filter); }, camera);
}

}  // namespace phasetree::tracer
