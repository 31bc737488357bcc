#pragma once

#include "phasetree/io/document.hpp"

namespace phasetree::tracer {

/// Whether a kind's file must not be opened because its document is read without assets. Whatever can be checked
/// without the file is still checked: check(), if the kind has it, throws ParameterError.
template <class Kind>
bool is_left_unread(const Document& document, const Kind& kind) {
    if constexpr (requires { kind.file; }) {
        if (document.reads_assets()) return false;
        if constexpr (requires { kind.check(); }) kind.check();
        return true;
    } else {
        return false;
    }
}

}  // namespace phasetree::tracer
