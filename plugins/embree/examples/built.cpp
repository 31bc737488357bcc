// Builds a tree with the C++ library, makes it into a geometry through the C++ wrapper, and prints the closest
// interface to a point.
#include <cstdio>
#include <phasetree/io/write.hpp>
#include <phasetree/phasetree.hpp>
#include <phasetree/phasetree_embree.hpp>

int main() {
    using namespace phasetree;
    const Phased object =
        ThinShell{.of = Sphere{.radius = 1}, .shell = Phase{1}, .inside = Phase{2}, .half_thickness = 0.05f};
    const SceneTree scene{{{"vacuum", "glass", "water"}}, object};

    const RTCDevice device = rtcNewDevice(nullptr);
    try {
        const embree::Tree tree = embree::Tree::of(scene);
        const embree::Geometry geometry(device, tree);
        const PhasetreeClosest closest = geometry.closest({0.5f, 0, 0}, 10);
        std::printf("from %s, %s is %.3f away; nothing is nearer than %.3f\n", tree.phase_name(closest.from).c_str(),
                    tree.phase_name(closest.to).c_str(), static_cast<double>(closest.distance),
                    static_cast<double>(closest.emptyRadius));
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
    rtcReleaseDevice(device);
}
