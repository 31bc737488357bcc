#include <fmt/format.h>

#include "phasetree/io/object_reader.hpp"
#include "phasetree/io/tree.hpp"

namespace phasetree {

namespace {

SirenNetwork network_of(const Document& document) {
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
            throw document.error(rows, "\"weights\" must be a list of rows, one per number in \"bias\"");
        for (const Value row : rows) {
            const auto numbers = as<std::vector<float>>(document, row, "a row of \"weights\"");
            if (layer.weights.empty()) layer.inputs = static_cast<int>(numbers.size());
            if (numbers.empty() || numbers.size() != static_cast<std::size_t>(layer.inputs))
                throw document.error(row, "the rows of \"weights\" must have the same length");
            layer.weights.insert(layer.weights.end(), numbers.begin(), numbers.end());
        }
        network.layers.push_back(std::move(layer));
    }
    return network;
}

// Replaces the message of an error by its position in the file and `what`, and quotes none of the file's contents. The
// scene determines which file is read. It may come from a stranger, and whoever reads the error may not have permission
// to read the file. Errors such as a missing or too large file are passed on unchanged.
template <class F>
auto unquoted(const std::filesystem::path& path, std::string_view what, F&& read) {
    try {
        return read();
    } catch (const SceneError& e) {
        if (e.line() == 0) throw;
        throw SceneError(path.string(), fmt::format("{} (line {}, column {})", what, e.line(), e.column()));
    }
}

}  // namespace

SirenNetwork read_siren(const std::filesystem::path& path) {
    const Document document = unquoted(path, "is not JSON", [&] { return Document::from_file(path); });
    SirenNetwork network = unquoted(path,
                                    "is not a network {\"radius\": R, \"layers\": [{\"weights\": [[…], …], \"bias\": "
                                    "[…]}, …]} with one row of weights per number in bias",
                                    [&] { return network_of(document); });
    if (const char* mistake = network.mistake()) throw SceneError(path.string(), mistake);
    return network;
}

SirenNetwork FileFormat<SirenNetwork>::read(const std::filesystem::path& path) {
    return read_siren(path);
}

}  // namespace phasetree
