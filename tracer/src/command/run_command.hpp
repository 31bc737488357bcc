// The whole command: what main() of `phasetree` does.
#pragma once

namespace phasetree::tracer {

// Parses the command line, runs its subcommand and returns the exit code. Reports all errors on standard error. Call it
// once per process, before anything uses the standard streams.
int run_command(int argc, char** argv);

}  // namespace phasetree::tracer
