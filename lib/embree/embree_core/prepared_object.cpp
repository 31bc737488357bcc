#include "embree_core/prepared_object.hpp"

#include "embree_core/error.hpp"

namespace phasetree::embree {

PreparedObject::PreparedObject(const Phased& object, const CellOptions& options) : device_(rtcNewDevice(nullptr)) {
    if (!device_) throw EmbreeError(rtcGetDeviceError(nullptr), "cannot start Embree");
    scene_ = std::make_unique<const CellScene>(device_.get(), std::make_shared<const InterfaceCells>(object, options));
}

}  // namespace phasetree::embree
