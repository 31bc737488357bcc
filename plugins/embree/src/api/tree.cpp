#include "api/tree_data.hpp"

#include "phasetree/nodes/fields/height_grid.hpp"

struct PhasetreeImageSink {
    phasetree::HeightGrid grid;
};

namespace phasetree::embree::api {

namespace {

std::uint64_t number_of(PhasetreeTree handle) {
    return reinterpret_cast<std::uintptr_t>(handle);
}

PhasetreeTree make(Document document, std::optional<PhasetreeFileReader> reader) {
    FileReaders readers;
    if (reader) {
        const auto read_image = [reader](const std::filesystem::path& path, const std::string&) {
            PhasetreeImageSink sink;
            if (const char* problem = reader->readImage(reader->userPtr, path.string().c_str(), &sink))
                throw std::runtime_error(problem);
            if (sink.grid.values.empty())
                throw std::runtime_error(
                    fmt::format("\"{}\": the application's reader returned no image", path.string()));
            return std::move(sink.grid);
        };
        readers.add<HeightGrid>({.read = read_image});
    }
    SceneTree tree = read_tree(document, readers);
    std::vector<std::optional<std::string>> materials(1);  // the vacuum's
    const Value phases = *document.root().find("phases");
    for (const Value phase : phases) {
        materials.emplace_back();
        if (phase.is_object()) materials.back() = json_of(document, phase);
    }
    const auto number = TreeTable::instance().insert(
        std::make_unique<TreeData>(TreeData{std::move(document), reader, std::move(tree), std::move(materials)}));
    return reinterpret_cast<PhasetreeTree>(static_cast<std::uintptr_t>(number));
}

std::optional<PhasetreeFileReader> checked(const PhasetreeFileReader* reader) {
    if (!reader) return std::nullopt;
    if (!reader->readImage) throw invalid("reader->readImage is NULL; pass NULL for the reader to read no images");
    return *reader;
}

ApiError no_tree(PhasetreeTree handle) {
    return {PHASETREE_ERROR_INVALID_HANDLE,
            handle ? "tree is not a valid handle, or has already been released" : "tree is NULL"};
}

}  // namespace

const TreeData& data_of(PhasetreeTree handle) {
    const TreeData* data = TreeTable::instance().find(number_of(handle));
    if (!data) throw no_tree(handle);
    return *data;
}

}  // namespace phasetree::embree::api

using namespace phasetree;
using namespace phasetree::embree::api;

float* phasetreeNewImageValues(PhasetreeImage image, unsigned int width, unsigned int height) {
    constexpr unsigned largest = 32768;
    if (!image || width == 0 || height == 0 || width > largest || height > largest) return nullptr;
    try {
        image->grid.values.assign(std::size_t{width} * height, 0.0f);
    } catch (...) {
        return nullptr;
    }
    image->grid.width = static_cast<int>(width);
    image->grid.height = static_cast<int>(height);
    return image->grid.values.data();
}

PhasetreeError phasetreeNewTreeFromFile(unsigned int api_version, const char* path, const PhasetreeFileReader* reader,
                                        PhasetreeTree* tree) {
    return guarded_call(__func__, [&] {
        require_version(api_version);
        require(path, "path");
        require(tree, "tree");
        *tree = make(Document::from_file(path), checked(reader));
    });
}

PhasetreeError phasetreeNewTreeFromText(unsigned int api_version, const char* text, size_t length, const char* name,
                                        const PhasetreeFileReader* reader, PhasetreeTree* tree) {
    return guarded_call(__func__, [&] {
        require_version(api_version);
        require(text, "text");
        require(tree, "tree");
        *tree = make(Document::from_text(std::string(text, length), name ? name : "<text>"), checked(reader));
    });
}

PhasetreeError phasetreeNewEditedTree(PhasetreeTree tree, const char* path, const char* value, PhasetreeTree* edited) {
    return guarded_call(__func__, [&] {
        const TreeData& data = data_of(tree);
        require(path, "path");
        require(value, "value");
        require(edited, "edited");
        *edited = make(Document::from_text(with_value(data.document, path, value), data.document.name()), data.reader);
    });
}

PhasetreeError phasetreeRetainTree(PhasetreeTree tree) {
    return guarded_call(__func__, [&] {
        if (!TreeTable::instance().retain(number_of(tree))) throw no_tree(tree);
    });
}

PhasetreeError phasetreeReleaseTree(PhasetreeTree tree) {
    return guarded_call(__func__, [&] {
        if (!TreeTable::instance().release(number_of(tree))) throw no_tree(tree);
    });
}

PhasetreeError phasetreeGetTreePhaseCount(PhasetreeTree tree, unsigned int* count) {
    return guarded_call(__func__, [&] {
        const TreeData& data = data_of(tree);
        require(count, "count");
        *count = static_cast<unsigned>(data.tree.phases.names.size());
    });
}

PhasetreeError phasetreeGetTreePhaseName(PhasetreeTree tree, unsigned int phase, const char** name) {
    return guarded_call(__func__, [&] {
        const TreeData& data = data_of(tree);
        require(name, "name");
        const auto& names = data.tree.phases.names;
        if (phase >= names.size()) throw invalid("phase {} does not exist; the tree has {}", phase, names.size());
        *name = names[phase].c_str();
    });
}

PhasetreeError phasetreeGetTreePhaseByName(PhasetreeTree tree, const char* name, unsigned int* phase) {
    return guarded_call(__func__, [&] {
        const TreeData& data = data_of(tree);
        require(name, "name");
        require(phase, "phase");
        const auto& names = data.tree.phases.names;
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end()) throw invalid("unknown phase \"{}\"", name);
        *phase = static_cast<unsigned>(found - names.begin());
    });
}

PhasetreeError phasetreeGetTreeBounds(PhasetreeTree tree, RTCBounds* out) {
    return guarded_call(__func__, [&] {
        const TreeData& data = data_of(tree);
        require(out, "bounds");
        const Bounds b = bounds(data.tree.object);
        *out = RTCBounds{b.low.x, b.low.y, b.low.z, 0, b.high.x, b.high.y, b.high.z, 0};
    });
}
