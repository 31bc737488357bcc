#include "objects/scene_file.hpp"

namespace phasetree::bench {

tracer::Scene scene_file(const std::string& name) {
    return tracer::read_scene(Document::from_file(std::string(PHASETREE_SCENES "/") + name + ".json"));
}

}  // namespace phasetree::bench
