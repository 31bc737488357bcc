#pragma once

#include "api/errors.hpp"
#include "phasetree/measuring/measure.hpp"

namespace phasetree::embree::api {

inline PhasetreeMeasured returned(const Measured& m) {
    return {m.low, m.high, m.estimate};
}

/// Calls f. A ModelError becomes an error about an argument.
template <class F>
auto as_argument(F&& f) {
    try {
        return f();
    } catch (const ModelError& e) {
        throw ApiError(PHASETREE_ERROR_INVALID_ARGUMENT, e.what());
    }
}

}  // namespace phasetree::embree::api
