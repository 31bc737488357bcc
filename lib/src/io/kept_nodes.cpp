#include "phasetree/io/kept_nodes.hpp"

namespace phasetree {

void KeptNodes::start() {
    // A reading that failed has taken some of the nodes, which are still good.
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
        // The file has changed, and does not change back. Without this, saving a file again and again while something
        // else of the scene is wrong would keep each of its versions.
        entry = before_.erase(entry);
    }
    return std::nullopt;
}

void KeptNodes::keep(const Source& source, Node node) {
    now_.emplace(source.parameters, Entry{source.state, std::move(node)});
}

}  // namespace phasetree
