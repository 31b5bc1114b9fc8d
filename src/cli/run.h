#pragma once

namespace skinforge {

/// The whole tool: reads the command line, carries it out and returns the exit status (README). Data go to
/// stdout, talk to stderr; nothing is thrown. Ends the process on SIGINT (130) and SIGTERM (143).
int run(int argc, char** argv);

}  // namespace skinforge
