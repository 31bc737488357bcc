#pragma once

#include <filesystem>

namespace phasetree::tracer {

// Throws std::runtime_error if OpenVDB could not read a file safely and in bounded memory: if the file is shorter than
// it claims, or if one of its grids would take more than four gigabytes.
//
// OpenVDB trusts what it reads. Versions before 11 overwrite a leaf's values with as many bytes as the file says. All
// versions allocate what a file asks for, loop as often as it says, and read zeros past its end. A memory limit would
// prevent only the allocations. A child process would contain the rest, but a multithreaded host (Python, a renderer)
// cannot fork safely, and has no program of ours to start instead.
//
// The check covers the file's header, the metadata and transforms of all grids, and the nodes of trees of float,
// double, int32 and int64, without their values. It must not be stricter than OpenVDB; tests/volume/vdb_structure.cpp
// checks this. Files must be of OpenVDB 1.1 (2013) or later.
void check_vdb_structure(const std::filesystem::path&);

}  // namespace phasetree::tracer
