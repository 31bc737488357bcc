#pragma once

/// PhaseTree: multiphase signed distance fields. This header is the model, its program and tracing; scene files are in
/// phasetree/io, Embree geometry in phasetree/phasetree_embree.hpp.

#include "phasetree/cells/cells.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/program/program.hpp"
#include "phasetree/trace/tracer.hpp"
#include "phasetree/tree/node.hpp"
#include "phasetree/version.hpp"
