#include "prepared_object.hpp"

#include <stdexcept>

namespace phasetree::python {

PreparedObject::PreparedObject(const Phased& object, const CellOptions& options) : device_(rtcNewDevice(nullptr)) {
    if (!device_) throw std::runtime_error("Embree cannot be started");
    scene_ = std::make_unique<const embree::CellScene>(device_.get(),
                                                       std::make_shared<const InterfaceCells>(object, options));
}

}  // namespace phasetree::python
