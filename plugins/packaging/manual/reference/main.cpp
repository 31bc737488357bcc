// Writes the reference of the C99 interface from what its headers say:
//
//   phasetree-reference FOLDER VERSION CONVENTIONS.h HEADER.h…
//
// FOLDER/man3/*.3 are manual pages, FOLDER/reference.html is the same as one page. CONVENTIONS.h is the header that
// says at its head what holds for every call. A function, structure or enumeration without a comment is an error, as is
// a comment that describes parameters which are not there, or does not say what a function returns.
#include <cstdio>
#include <exception>

#include "reference/write.hpp"

int main(int argc, char** argv) {
    using namespace phasetree::manual;
    if (argc < 5) {
        std::fprintf(stderr, "usage: %s FOLDER VERSION CONVENTIONS.h HEADER.h...\n", argv[0]);
        return 2;
    }
    try {
        std::vector<Header> headers;
        for (int i = 4; i < argc; ++i) headers.push_back(read_header(argv[i]));
        const Reference reference = reference_of(read_header(argv[3]), headers, argv[2]);
        const std::filesystem::path folder = argv[1];
        write_man(reference, folder / "man3");
        write_html(reference, folder / "reference.html");
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
    return 0;
}
