// 3MF, the format of multi-material printers (3MF Consortium, *3D Manufacturing Format, Core Specification* 1.3).
#pragma once

#include <string>

#include "mesh_file/meshed_object.hpp"

namespace phasetree::tracer {

/// The bytes of a file with one printable object, whose parts are the closed surfaces of the chosen phases, each with
/// its name and colour. The unit of length is a millimetre. Throws std::length_error if the file would exceed 2 GB.
std::string three_mf_of(const MeshedObject&);

}  // namespace phasetree::tracer
