#include "command/command.hpp"
#include "command/run_command.hpp"

const phasetree::tests::CommandMain phasetree::tests::command_main = phasetree::tracer::run_command;
