// Replaces openvdb.cpp in builds without the library.
#include <stdexcept>

#include "volume/formats.hpp"
#include "volume/label_volume.hpp"

namespace phasetree::tracer {

namespace {

[[noreturn]] void refuse() {
    throw std::runtime_error(
        "this phasetree was built without OpenVDB; install libopenvdb-dev, or the library from openvdb.org, and "
        "rebuild");
}

}  // namespace

VoxelGrid level_set_of_openvdb(const std::filesystem::path&, const std::string&) {
    refuse();
}
LabelGrid labels_of_openvdb(const std::filesystem::path&, const std::string&) {
    refuse();
}
PlacedVoxels numbers_of_openvdb(const std::filesystem::path&, const std::string&) {
    refuse();
}
std::string labels_as_openvdb(const LabelVolume&, const std::function<bool()>&) {
    refuse();
}
bool can_read_openvdb() {
    return false;
}
std::string openvdb_version() {
    return "";
}

}  // namespace phasetree::tracer
