#include "gltf/clear_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <string_view>

#include "gltf/extensions.hpp"
#include "gltf/names.hpp"
#include "shading/thin_film.hpp"

namespace phasetree::tracer::gltf {

namespace {

constexpr float largest_ior = 4;

glm::vec3 clamped(const glm::vec3& v) {
    return glm::clamp(v, glm::vec3(0), glm::vec3(1));
}

class ClearReader {
  public:
    ClearReader(const Item& item, Images& images, std::vector<std::string>& not_shown)
        : item_(item), images_(images), not_shown_(not_shown) {}

    ClearMaterial read() {
        static const Json none = Json::object();
        const Item pbr = item_.item("pbrMetallicRoughness").value_or(Item(none, "the default material"));
        made_.priority = priority_of(item_);
        made_.matter = matter_of(item_);
        read_surface(pbr);
        read_index();
        read_volume();
        read_film();
        note_transmission(pbr);
        note_other_extensions();
        return made_;
    }

  private:
    void note(std::string sentence) { not_shown_.push_back(std::move(sentence)); }

    // The mean of an image, which is used instead of the image.
    std::optional<glm::vec3> mean(const Item& owner, std::string_view key, ImageMeaning meaning,
                                  std::string_view what) {
        const auto texture = owner.item(key);
        if (!texture) return std::nullopt;
        const auto read = images_.read(*texture, meaning);
        note(read ? fmt::format("has an image of its {}, whose mean is used", what)
                  : fmt::format("has an image of its {} in an unsupported format, which is ignored", what));
        return read ? std::optional(read->mean) : std::nullopt;
    }

    void read_surface(const Item& pbr) {
        if (const auto factor = pbr.numbers("baseColorFactor", 4))
            made_.tint = clamped({(*factor)[0], (*factor)[1], (*factor)[2]});
        if (const auto color = mean(pbr, "baseColorTexture", ImageMeaning::colors, "base colour"))
            made_.tint *= clamped(*color);
        made_.roughness = std::clamp(pbr.number("roughnessFactor", 1), 0.0f, 1.0f);
        if (const auto numbers = mean(pbr, "metallicRoughnessTexture", ImageMeaning::numbers, "roughness"))
            made_.roughness *= std::clamp(numbers->y, 0.0f, 1.0f);
        if (item_.has("normalTexture")) note("has a normal map, which is ignored");
        if (const std::string mode = item_.text("alphaMode"); mode == "MASK" || mode == "BLEND")
            note("has an alpha, which is ignored");
        if (item_.vec3("emissiveFactor", glm::vec3(0)) != glm::vec3(0))
            note("emits light at its surface, which is ignored");
    }

    void read_index() {
        if (const auto ior = item_.extension("KHR_materials_ior")) made_.ior = ior->number("ior", 1.5f);
        if (!(made_.ior >= 1 && made_.ior <= largest_ior)) {
            const float usable = made_.ior == 0 ? 1.5f : std::clamp(made_.ior, 1.0f, largest_ior);
            note(fmt::format("has the index {}, which no clear substance has; {} is used (KHR_materials_ior)",
                             made_.ior, usable));
            made_.ior = usable;
        }
        if (const auto dispersion = item_.extension("KHR_materials_dispersion"))
            made_.dispersion = std::max(dispersion->number("dispersion", 0), 0.0f);
    }

    void read_volume() {
        const auto volume = item_.extension("KHR_materials_volume");
        if (!volume) return;
        made_.attenuation_color = clamped(volume->vec3("attenuationColor", glm::vec3(1)));
        const float distance = volume->number("attenuationDistance", 0);
        if (distance > 0) made_.attenuation_distance = distance;
    }

    void read_film() {
        const auto film = item_.extension("KHR_materials_iridescence");
        const float factor = film ? film->number("iridescenceFactor", 0) : 0;
        if (!(factor > 0)) return;
        if (factor < 1) note("is iridescent in part; it has the whole film (KHR_materials_iridescence)");
        float thickness = film->number("iridescenceThicknessMaximum", 400);
        if (const auto share = mean(*film, "iridescenceThicknessTexture", ImageMeaning::numbers, "film's thickness"))
            thickness = glm::mix(film->number("iridescenceThicknessMinimum", 100), thickness, share->y);
        made_.film = SurfaceFilm{.thickness = std::clamp(thickness, 0.0f, ThinFilm::thickest),
                                 .ior = std::clamp(film->number("iridescenceIor", 1.3f), 1.0f, largest_ior)};
    }

    void note_transmission(const Item& pbr) {
        const auto transmission = item_.extension("KHR_materials_transmission");
        if (transmission &&
            (transmission->number("transmissionFactor", 0) < 1 || transmission->has("transmissionTexture")))
            note("transmits a part of the light only; it is read as wholly clear (KHR_materials_transmission)");
        if (pbr.number("metallicFactor", 1) > 0.5f && pbr.has("metallicFactor"))
            note("is also metallic, which is ignored");
    }

    void note_other_extensions() {
        static constexpr std::array read{"KHR_materials_transmission", "KHR_materials_volume",
                                         "KHR_materials_ior",          "KHR_materials_dispersion",
                                         "KHR_materials_iridescence",  "KHR_materials_emissive_strength",
                                         "KHR_texture_transform"};
        const auto extensions = item_.item("extensions");
        if (!extensions) return;
        for (const std::string& name : extensions->keys()) {
            if (std::ranges::find(read, name) != read.end()) continue;
            if (name == "KHR_materials_specular" && is_neutral(*extensions->item(name))) continue;
            const std::string loss = loss_without(name);
            if (!loss.empty()) note(fmt::format("{} ({})", loss, name));
        }
    }
    static bool is_neutral(const Item& specular) {
        return specular.number("specularFactor", 1) == 1 && !specular.has("specularTexture") &&
               !specular.has("specularColorTexture") &&
               specular.vec3("specularColorFactor", glm::vec3(1)) == glm::vec3(1);
    }

    const Item& item_;
    Images& images_;
    std::vector<std::string>& not_shown_;
    ClearMaterial made_;
};

}  // namespace

ClearMaterial clear_material(const Item& material, Images& images, std::vector<std::string>& not_shown) {
    return ClearReader(material, images, not_shown).read();
}

namespace {

// The extras of an item if they have that key. Extras need not be an object.
std::optional<Item> extras_with(const Item& item, std::string_view key) {
    const auto extras = item.item("extras");
    if (!extras) return std::nullopt;
    const std::vector<std::string> keys = extras->keys();
    return std::ranges::find(keys, key) == keys.end() ? std::nullopt : extras;
}

}  // namespace

std::optional<float> priority_of(const Item& item) {
    constexpr std::string_view key = "phasetree_priority";
    const auto extras = extras_with(item, key);
    return extras ? std::optional(extras->number(key, 0)) : std::nullopt;
}

std::string matter_of(const Item& item) {
    constexpr std::string_view key = "phasetree_matter";
    const auto extras = extras_with(item, key);
    return extras ? clean_name(extras->text(key)) : std::string();
}

}  // namespace phasetree::tracer::gltf
