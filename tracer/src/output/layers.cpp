#include "output/layers.hpp"

#include <algorithm>
#include <string_view>

namespace phasetree::tracer {

namespace {

constexpr std::string_view cryptomatte = "cryptomatte/";

// The Cryptomattes of an image: their names, and the common prefix of their attributes. Cryptomatte 1.2 stores the name
// as "cryptomatte/NUMBER/name", and its other attributes with the same number.
std::vector<std::pair<std::string, std::string>> cryptomattes_of(const Image& image) {
    std::vector<std::pair<std::string, std::string>> all;
    for (const auto& [key, text] : image.attributes)
        if (key.starts_with(cryptomatte) && key.ends_with("/name"))
            all.emplace_back(text, key.substr(0, key.size() - std::string_view("name").size()));
    return all;
}

// Whether an EXR layer is a rank of a Cryptomatte: its name followed by two digits.
bool is_rank_of(const std::string& layer, const std::string& matte) {
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    return layer.size() == matte.size() + 2 && layer.starts_with(matte) && is_digit(layer[matte.size()]) &&
           is_digit(layer[matte.size() + 1]);
}

}  // namespace

Layer whole(const Image& image) {
    Layer all{.name = layer_of_picture, .has_picture = true, .attributes = image.attributes};
    for (const Channel& channel : image.extra_channels) all.channels.push_back(&channel);
    return all;
}

std::vector<Layer> layers_of(const Image& image) {
    const auto mattes = cryptomattes_of(image);
    std::vector<Layer> layers{{.name = layer_of_picture, .has_picture = true}};
    for (const Channel& channel : image.extra_channels) {
        if (channel.name == "A") {  // stored next to R, G and B, as usual for alpha
            layers.front().channels.push_back(&channel);
            continue;
        }
        std::string name = channel.name.substr(0, channel.name.find('.'));
        const auto matte = std::ranges::find_if(mattes, [&](const auto& m) { return is_rank_of(name, m.first); });
        if (matte != mattes.end()) name = matte->first;
        std::ranges::replace(name, '/', '_');  // user-defined channels may have any name
        auto layer = std::ranges::find(layers, name, &Layer::name);
        if (layer == layers.end()) {
            layer = layers.insert(layers.end(), Layer{.name = name});
            if (matte != mattes.end())
                for (const auto& attribute : image.attributes)
                    if (attribute.first.starts_with(matte->second)) layer->attributes.push_back(attribute);
        }
        layer->channels.push_back(&channel);
    }
    // Attributes that do not belong to a Cryptomatte go with the picture.
    for (const auto& attribute : image.attributes)
        if (std::ranges::none_of(mattes, [&](const auto& m) { return attribute.first.starts_with(m.second); }))
            layers.front().attributes.push_back(attribute);
    return layers;
}

std::vector<std::string> layer_names(const Image& image) {
    std::vector<std::string> names;
    for (Layer& layer : layers_of(image)) names.push_back(std::move(layer.name));
    return names;
}

bool is_for_each_plane(const std::filesystem::path& path) {
    return path.string().find(plane_in_name) != std::string::npos;
}

std::filesystem::path file_of_plane(const std::filesystem::path& path, const std::string& plane) {
    std::string name = path.filename().string();
    if (const std::size_t at = name.find(plane_in_name); at != std::string::npos)
        name.replace(at, plane_in_name.size(), plane);
    return path.parent_path() / name;
}

}  // namespace phasetree::tracer
