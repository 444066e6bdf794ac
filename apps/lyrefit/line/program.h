#pragma once

namespace lyrefit {

// The whole command: parses the arguments, runs the verb and returns the exit code. It changes the handling of signals
// and the logging of the process, so it is called once, by main() or by the script of the Python wheel.
int RunProgram(int argc, char** argv);

}  // namespace lyrefit
