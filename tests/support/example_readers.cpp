#include "support/example_readers.hpp"

#include "phasetree/nodes/list.hpp"
#include "support/set_algebra/all.hpp"

namespace phasetree::tests {

namespace {

// Any content suits an example, unless there is an overload for its type.
template <class Content>
Content example_content(Random& rng, std::type_identity<Content> type) {
    return random_content(rng, type);
}

template <class Content>
void add_reader(FileReaders& readers, const FromFile<Content>&, const auto& check) {
    if constexpr (ReadByProgram<Content>)
        readers.add<Content>({.read = [check](const std::filesystem::path& path, const std::string&) {
            if (check) check(path);
            Random rng(2);
            return example_content(rng, std::type_identity<Content>{});
        }});
}

}  // namespace

FileReaders example_readers(std::function<void(const std::filesystem::path&)> check) {
    FileReaders readers;
    const auto add = [&]<class Node>() {
        if constexpr (requires(const Node& node) { node.file.content; }) add_reader(readers, Node().file, check);
    };
    for_each_type(PlainFields(), add);
    for_each_type(Objects(), add);
    return readers;
}

}  // namespace phasetree::tests
