#include <fmt/format.h>

#include "phasetree/reading/object_reader.hpp"
#include "phasetree/reading/tree.hpp"

namespace phasetree {

SirenNetwork read_siren(const std::filesystem::path& path) {
    const Document document = Document::from_file(path);
    ObjectReader root(document, document.root(), "the network");
    root.allow({"source", "radius", "layers"});
    root.finish();
    SirenNetwork network;
    network.radius = root.required<float>("radius", Range::positive());
    const Value layers = root.required_value("layers");
    if (!layers.is_array())
        throw document.error(layers, fmt::format("\"layers\" must be a list, but is {}", name_of(layers.kind())));
    for (const Value item : layers) {
        ObjectReader reader(document, item, "the layer");
        reader.allow({"weights", "bias"});
        reader.finish();
        SirenNetwork::Layer layer;
        layer.bias = reader.required<std::vector<float>>("bias");
        layer.outputs = static_cast<int>(layer.bias.size());
        const Value rows = reader.required_value("weights");
        if (!rows.is_array() || rows.size() != layer.bias.size())
            throw document.error(rows, "\"weights\" must be a list of rows, one for each number in \"bias\"");
        for (const Value row : rows) {
            const auto numbers = as<std::vector<float>>(document, row, "a row of \"weights\"");
            if (layer.weights.empty()) layer.inputs = static_cast<int>(numbers.size());
            if (numbers.empty() || numbers.size() != static_cast<std::size_t>(layer.inputs))
                throw document.error(row, "the rows of \"weights\" must be of one length");
            layer.weights.insert(layer.weights.end(), numbers.begin(), numbers.end());
        }
        network.layers.push_back(std::move(layer));
    }
    if (const char* mistake = network.mistake()) throw document.error(document.root(), mistake);
    return network;
}

}  // namespace phasetree
