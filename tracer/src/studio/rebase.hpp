// Whether operations that were made for an older text mean the same for the present one.
#pragma once

#include <span>

#include "studio/operation.hpp"

namespace phasetree::tracer::studio {

/// Throws ConflictError if the pointers of an operation may refer to other values than they did: if a list on the way
/// has another length, or if a value that is to be removed, moved, wrapped, unwrapped or renamed has changed. Replacing
/// the whole text always conflicts. A value that has changed may still be set: the last change wins.
void check_rebase(const Document& base, const Document& present, std::span<const Operation> operations);

}  // namespace phasetree::tracer::studio
