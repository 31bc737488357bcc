#pragma once

/// All parts of the oracle: the meaning of each node (set_algebra.hpp), and random contents of the files that nodes
/// read, by an overload of random_content() for each type of content.

#include "support/set_algebra/balls.hpp"
#include "support/set_algebra/blobs.hpp"
#include "support/set_algebra/components.hpp"
#include "support/set_algebra/copies.hpp"
#include "support/set_algebra/field_operators.hpp"
#include "support/set_algebra/formulas.hpp"
#include "support/set_algebra/meshes.hpp"
#include "support/set_algebra/outlines.hpp"
#include "support/set_algebra/patterns.hpp"
#include "support/set_algebra/primitives.hpp"
#include "support/set_algebra/proxies.hpp"
#include "support/set_algebra/regions.hpp"
#include "support/set_algebra/textures.hpp"
#include "support/set_algebra/volumes.hpp"
#include "support/set_algebra/warps.hpp"
