#pragma once

#include <filesystem>

namespace phasetree::tracer {

// Walks through an OpenVDB file and throws std::runtime_error if OpenVDB could not read it in bounded memory: if the
// file is too short for what it says, or if what it says would take more than four gigabytes. OpenVDB itself makes
// memory for whatever a file claims, and writes values that are more than there is room for.
//
// What is looked at: the file's header, every grid's metadata and transform, and all nodes of the trees of those kinds
// that are read here, without their values. Files are of OpenVDB 1.1 (2013) or later.
void check_vdb_structure(const std::filesystem::path&);

}  // namespace phasetree::tracer
