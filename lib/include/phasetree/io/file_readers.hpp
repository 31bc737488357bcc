#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <typeindex>
#include <utility>
#include <vector>

#include "phasetree/model/from_file.hpp"

namespace phasetree {

/// Callbacks with which an application reads one kind of file. They may throw any std::exception whose what() describes
/// the problem.
template <class Content>
struct FileReader {
    /// `part` names the content to read if a file may hold several, for example a grid; otherwise it is empty. For
    /// fonts it is the text to lay out.
    std::function<Content(const std::filesystem::path&, const std::string& part)> read{};
    /// The files that a name stands for, such as the images of a stack. Without this callback, it stands for one file.
    std::function<std::vector<std::filesystem::path>(const std::filesystem::path&)> files{};
};

/// A program's readers for the files that nodes refer to, at most one per type of content. Content without a reader can
/// be read only if this library reads it itself (FileFormat).
class FileReaders {
  public:
    /// Adds a reader, or replaces the one for the same content.
    template <ReadByProgram Content>
    FileReaders& add(FileReader<Content> reader) {
        readers_[typeid(Content)] = std::make_shared<const FileReader<Content>>(std::move(reader));
        return *this;
    }
    /// The reader of this content, or null.
    template <class Content>
    const FileReader<Content>* find() const {
        const auto found = readers_.find(typeid(Content));
        return found == readers_.end() ? nullptr : static_cast<const FileReader<Content>*>(found->second.get());
    }

  private:
    std::map<std::type_index, std::shared_ptr<const void>> readers_;
};

}  // namespace phasetree
