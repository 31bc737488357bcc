#include "scene/camera_text.hpp"

#include <fmt/format.h>

#include <type_traits>

#include "phasetree/io/keys.hpp"
#include "phasetree/io/parameter_type.hpp"
#include "scene/camera_kinds.hpp"

namespace phasetree::tracer {

namespace {

std::string name_of(const PixelFilter& filter) {
    for (const std::string_view name : names_of_filters()) {
        const PixelFilter named = filter_of_name(name);
        if (named.shape() == filter.shape() && named.radius() == filter.radius()) return std::string(name);
    }
    return CameraInFile().filter_name;  // no scene file uses another filter
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

// Writes the parameters with the kind that has them. A thin lens need not be named.
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

// The end of an object that begins at `from`, after its closing bracket. The text must be valid JSON with comments.
std::size_t end_of_object(const std::string& text, std::size_t from) {
    int depth = 0;
    for (std::size_t i = from; i < text.size(); ++i) {
        if (text.compare(i, 2, "//") == 0) {
            i = text.find_first_of("\r\n", i);
        } else if (text.compare(i, 2, "/*") == 0) {
            i = text.find("*/", i + 2) + 1;
        } else if (text[i] == '"') {
            while (text[++i] != '"')
                if (text[i] == '\\') ++i;
        } else if (text[i] == '{') {
            ++depth;
        } else if (text[i] == '}' && --depth == 0) {
            return i + 1;
        }
    }
    return text.size();
}

}  // namespace

std::string camera_text(const AnyCameraParameters& camera, const PixelFilter& filter) {
    return std::visit([&](const auto& parameters) { return written(CameraKinds(), parameters, filter); }, camera);
}

std::string with_camera(const Document& document, const std::string& camera) {
    const auto old = document.root().find("camera");
    if (!old || !old->is_object()) throw document.error(document.root(), "the scene has no camera to replace");
    if (!times_of_keys(*old).empty())
        throw document.error(*old, "the camera has keys, which would be lost; edit the scene file instead");
    std::string text = document.text();
    return text.replace(old->offset(), end_of_object(text, old->offset()) - old->offset(), camera);
}

}  // namespace phasetree::tracer
