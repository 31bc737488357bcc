#include <fmt/format.h>

#include "lights/light_kinds.hpp"
#include "phasetree/io/read_kind.hpp"
#include "scene/parameter_types.hpp"
#include "scene/read_parts.hpp"
#include "scene/unread_file.hpp"

namespace phasetree::tracer {

namespace {

template <class Light, class Kind>
void add(Lights& lights, Light light, const Kind& kind) {
    lights.add(std::move(light), kind.checked_group(), kind.spectrum);
}
template <class Light, class Kind>
void add(Lights& lights, std::vector<Light> several, const Kind& kind) {
    for (Light& light : several) add(lights, std::move(light), kind);
}

}  // namespace

Lights read_lights(const Document& document, Value root) {
    Lights lights;
    if (const std::optional<Value> list = root.find("lights")) {
        if (!list->is_array())
            throw document.error(*list, fmt::format("\"lights\" must be a list, but is {}", name_of(list->kind())));
        EnvironmentImages images;
        for (const Value light : *list) {
            with_kind(LightKinds(), document, light, "a light", [&]<class Kind>(Value member) {
                read_kind<Kind>(document, member, fmt::format("the {} light", Kind::info.name), [&](const Kind& kind) {
                    if constexpr (std::is_same_v<Kind, PortalParameters>)
                        lights.add(kind.made());
                    else if (is_left_unread(document, kind))
                        (void)kind.checked_group();
                    else
                        add(lights, made_light(kind, images), kind);
                    return true;
                });
            });
        }
    }
    if (const std::optional<Value> background = root.find("background"))
        lights.set_background(as_colour(document, *background, "\"background\""));
    return lights;
}

}  // namespace phasetree::tracer
