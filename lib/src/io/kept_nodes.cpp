#include "phasetree/io/kept_nodes.hpp"

namespace phasetree {

void KeptNodes::start() {
    // A failed earlier read has taken some of the nodes, which are still valid.
    before_.merge(now_);
}

void KeptNodes::finish() {
    before_.clear();
}

std::optional<KeptNodes::Node> KeptNodes::take(const Source& source) {
    const auto [first, end] = before_.equal_range(source.parameters);
    for (auto entry = first; entry != end;) {
        if (entry->second.state == source.state) {
            return before_.extract(entry).mapped().node;
        }
        // The file has changed, and its old version will not return. Without this, repeatedly saving a file while
        // another part of the scene is wrong would keep every version.
        entry = before_.erase(entry);
    }
    return std::nullopt;
}

void KeptNodes::keep(const Source& source, Node node) {
    now_.emplace(source.parameters, Entry{source.state, std::move(node)});
}

}  // namespace phasetree
