// The only unit that is compiled with the repository's place: the compiler cache serves all others to any checkout.
#include "source_directory.hpp"

std::string source_directory() {
    return PHASETREE_SOURCE_DIR;
}
