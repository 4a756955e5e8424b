// The first and the last steps of both programs, contort and contort-render.
#pragma once

namespace contort::cli {

// Calls `run` and returns the exit code of the process. SIGPIPE and similar signals are ignored first, so that failed
// writes become errors to report, and standard streams that the caller closed are opened, so that no file takes their
// numbers. Afterwards standard output is flushed. If that fails, the exit code is kInternal with a line on standard
// error, or kNobodyReads without one. Exceptions end in kInternal.
int run_to_the_end(int argc, char** argv, int (*run)(int argc, char** argv));

}  // namespace contort::cli
