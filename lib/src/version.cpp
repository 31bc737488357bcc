#include "phasetree/version.hpp"

namespace phasetree {

const char* version() {
    return PHASETREE_VERSION;  // the project's, which CMake knows
}

}  // namespace phasetree
