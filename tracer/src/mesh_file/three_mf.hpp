// 3MF, the format of multi-material printers (3MF Consortium, *3D Manufacturing Format, Core Specification* 1.3).
#pragma once

#include <string>

#include "mesh_file/meshed_object.hpp"

namespace phasetree::tracer {

/// The bytes of a file with one printable object. Its mesh consists of the closed surfaces of the chosen phases, one
/// after another; each triangle has the name and colour of its phase. For PrusaSlicer and its derivatives, the file
/// also lists these surfaces as parts of the object, each with its own extruder. The unit of length is the millimetre.
/// Throws std::length_error if the file would exceed 2 GB.
std::string three_mf_of(const MeshedObject&);

}  // namespace phasetree::tracer
