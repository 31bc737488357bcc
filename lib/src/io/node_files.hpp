#pragma once

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "io/node_source.hpp"
#include "model/preparation.hpp"
#include "phasetree/io/balls.hpp"
#include "phasetree/io/mesh.hpp"
#include "phasetree/io/tree.hpp"

namespace phasetree::io {

/// Creates the nodes that take files. Within one read of a scene, each file, or each requested part of it, is read
/// once. If the document keeps nodes (KeptNodes), a node that an earlier read created from the same source is reused.
class NodeFiles {
  public:
    /// All arguments must outlive this object. `budget` pays for the preparation of the nodes.
    NodeFiles(const Document& document, const FileReaders& readers, const model::PreparationTogether& budget)
        : document_(document), readers_(readers), budget_(budget) {}

    /// Creates a node whose parameters are all set except the file's content; `file` is the file's name in the
    /// document. Throws SceneError at that name, and whatever creating the node throws.
    template <class Handle, MadeFromFile N>
    Handle made(N& node, Value file) {
        KeptNodes* const kept = document_.kept_nodes();
        const std::optional<KeptNodes::Source> source = kept ? source_of_node(node, file) : std::nullopt;
        if (source) {
            if (const std::optional<KeptNodes::Node> known = kept->take(*source)) {
                model::PreparationTogether::pay(N::info.name, known->steps);
                kept->keep(*source, *known);
                return std::get<Handle>(known->handle);
            }
        }
        std::string part;
        if constexpr (requires { node.part_of_file(); }) part = node.part_of_file();
        read(node.file, part, file);
        const std::uint64_t paid = budget_.paid();
        Handle made(std::move(node));
        if (source) kept->keep(*source, {made, budget_.paid() - paid});
        return made;
    }

  private:
    // Nothing if the node cannot be recognised later.
    template <class N>
    std::optional<KeptNodes::Source> source_of_node(N& node, Value file) const {
        const std::filesystem::path path = document_.file(file);
        std::vector<std::filesystem::path> files{path};
        if constexpr (std::is_same_v<decltype(node.file), FromFile<LabelGrid>>) {
            try {
                if (readers_.label_files) files = readers_.label_files(path);
            } catch (const std::exception&) {
                return std::nullopt;  // the reader of the files will report the problem
            }
        }
        return source_of(node, path, files);
    }

    template <class Content>
    void read(FromFile<Content>& target, const std::string& part, Value file) {
        const std::filesystem::path path = document_.file(file);
        auto& known = std::get<Known<Content>>(known_);
        const std::pair key{target.path, part};
        if (const auto found = known.find(key); found != known.end()) {
            target.content = found->second;
            return;
        }
        try {
            target.content = std::make_shared<const Content>(content_of<Content>(path, part));
        } catch (const std::exception& e) {
            throw document_.error(file, e.what());
        }
        known.emplace(key, target.content);
    }

    template <class Content>
    Content content_of(const std::filesystem::path& path, const std::string& part) const {
        if constexpr (std::is_same_v<Content, SirenNetwork>) {
            return read_siren(path);
        } else if constexpr (std::is_same_v<Content, TriangleMesh>) {
            return read_mesh(path);
        } else if constexpr (std::is_same_v<Content, BallList>) {
            return read_balls(path);
        } else if constexpr (std::is_same_v<Content, VoxelGrid>) {
            if (!readers_.level_set) throw std::runtime_error("this program cannot read OpenVDB files");
            return readers_.level_set(path, part);
        } else if constexpr (std::is_same_v<Content, LabelGrid>) {
            if (!readers_.label_grid)
                throw std::runtime_error("this program can read neither OpenVDB files nor images");
            return readers_.label_grid(path, part);
        } else if constexpr (std::is_same_v<Content, TextOutlines>) {
            if (!readers_.text_outlines) throw std::runtime_error("this program cannot read fonts");
            return readers_.text_outlines(path, part);
        } else {
            if (!readers_.height_grid) throw std::runtime_error("this program cannot read images");
            return readers_.height_grid(path);
        }
    }

    const Document& document_;
    const FileReaders& readers_;
    const model::PreparationTogether& budget_;
    /// By the name in the document and the requested part.
    template <class Content>
    using Known = std::map<std::pair<std::string, std::string>, std::shared_ptr<const Content>>;
    std::tuple<Known<SirenNetwork>, Known<HeightGrid>, Known<TriangleMesh>, Known<VoxelGrid>, Known<LabelGrid>,
               Known<BallList>, Known<TextOutlines>>
        known_;
};

}  // namespace phasetree::io
