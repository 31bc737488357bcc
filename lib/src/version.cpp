#include "phasetree/version.hpp"

namespace phasetree {

const char* version() {
    return "0.1.0";
}

}  // namespace phasetree
