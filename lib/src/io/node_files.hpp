#pragma once

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <typeindex>
#include <vector>

#include "io/node_source.hpp"
#include "model/preparation.hpp"
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
        std::vector<std::filesystem::path> files;
        try {
            files = files_of(node.file, path);
        } catch (const std::exception&) {
            return std::nullopt;  // the reader of the files will report the problem
        }
        return source_of(node, path, files);
    }
    // The files that the name of a content stands for.
    template <class Content>
    std::vector<std::filesystem::path> files_of(const FromFile<Content>&, const std::filesystem::path& path) const {
        const FileReader<Content>* const reader = readers_.find<Content>();
        if (!reader || !reader->files) return {path};
        return reader->files(path);
    }

    template <class Content>
    void read(FromFile<Content>& target, const std::string& part, Value file) {
        const std::filesystem::path path = document_.file(file);
        const std::tuple key{std::type_index(typeid(Content)), target.path, part};
        if (const auto found = known_.find(key); found != known_.end()) {
            target.content = std::static_pointer_cast<const Content>(found->second);
            return;
        }
        try {
            target.content = std::make_shared<const Content>(content_of<Content>(path, part));
        } catch (const std::exception& e) {
            throw document_.error(file, e.what());
        }
        known_.emplace(key, target.content);
    }

    template <class Content>
    Content content_of(const std::filesystem::path& path, [[maybe_unused]] const std::string& part) const {
        static_assert(FileContent<Content>, "the content of a file lacks a FileFormat (phasetree/model/from_file.hpp)");
        if constexpr (ReadByLibrary<Content>) {
            return FileFormat<Content>::read(path);
        } else {
            const FileReader<Content>* const reader = readers_.find<Content>();
            if (!reader || !reader->read) throw std::runtime_error(std::string(FileFormat<Content>::no_reader));
            return reader->read(path, part);
        }
    }

    const Document& document_;
    const FileReaders& readers_;
    const model::PreparationTogether& budget_;
    /// What has been read, by the type of the content, the name in the document and the requested part.
    std::map<std::tuple<std::type_index, std::string, std::string>, std::shared_ptr<const void>> known_;
};

}  // namespace phasetree::io
