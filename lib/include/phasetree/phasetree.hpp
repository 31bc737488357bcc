// phasetree: multiphase signed distance fields. This header includes the nodes of trees, programs, tracing, cells,
// carved bounds and meshes. Include separately: phasetree/cells/file.hpp for cell files,
// phasetree/trace/precise_tracer.hpp for tracing in double precision, phasetree/measuring for volumes and areas,
// phasetree/model/preparation_watch.hpp for progress and cancelling, phasetree/glsl/shader.hpp for shaders,
// phasetree/io for scene files, and phasetree/phasetree_embree.h for Embree geometries.
#pragma once

#include "phasetree/carving/carve.hpp"
#include "phasetree/cells/cells.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/meshing/phase_mesh.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/model/renumber.hpp"
#include "phasetree/nodes/list.hpp"
#include "phasetree/program/program.hpp"
#include "phasetree/trace/tracer.hpp"
#include "phasetree/tree/levels_of_detail.hpp"
#include "phasetree/tree/unbounded.hpp"
#include "phasetree/tree/value_source.hpp"
#include "phasetree/version.hpp"
