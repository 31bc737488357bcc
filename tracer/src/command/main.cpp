#include "command/run_command.hpp"

int main(int argc, char** argv) {
    return phasetree::tracer::run_command(argc, argv);
}
