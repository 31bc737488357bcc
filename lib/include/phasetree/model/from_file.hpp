#pragma once

#include <concepts>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace phasetree {

/// How files with this content are read. Each type of content is specialised next to its definition, with one of these
/// members:
///   - `static Content read(const std::filesystem::path&)`, if this library reads such files. It may throw any
///     std::exception whose what() describes the problem.
///   - `static constexpr std::string_view no_reader`, if the application must supply a reader (FileReaders in
///     io/file_readers.hpp). It is the error message of an application without one, such as "this program cannot read
///     fonts".
template <class Content>
struct FileFormat;

template <class Content>
concept ReadByLibrary = requires(const std::filesystem::path& path) {
    { FileFormat<Content>::read(path) } -> std::same_as<Content>;
};
template <class Content>
concept ReadByProgram = requires {
    { FileFormat<Content>::no_reader } -> std::convertible_to<std::string_view>;
};
template <class Content>
concept FileContent = ReadByLibrary<Content> || ReadByProgram<Content>;

/// A parameter whose content is in a file: the file's name as in the scene, and its content. An application that
/// creates the content itself leaves the name empty. The parameter's name must be `file`. If a file may hold several
/// contents, the node has a function part_of_file(), which returns the name of the requested one.
template <class Content>
struct FromFile {
    std::string path{};
    std::shared_ptr<const Content> content{};
};

}  // namespace phasetree
