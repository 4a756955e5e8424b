// The only clock below the command line: for watchdogs and time budgets. The result of a case never depends on it.
#pragma once

namespace contort {

// Seconds since some moment before the process began; never goes back.
double steady_s();

}  // namespace contort
