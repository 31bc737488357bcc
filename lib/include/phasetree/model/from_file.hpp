#pragma once

#include <memory>
#include <string>

namespace phasetree {

/// A parameter whose content is in a file: the file's name as in the scene, and its content. A program that creates the
/// content itself leaves the name empty.
template <class Content>
struct FromFile {
    std::string path{};
    std::shared_ptr<const Content> content{};
};

}  // namespace phasetree
