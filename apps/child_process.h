// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_APPS_CHILD_PROCESS_H_
#define INVSIM_APPS_CHILD_PROCESS_H_

// `invsim` run by itself as another process, so that a failure of any kind is
// a result, and its processor time is known.

#include <string>
#include <vector>

namespace invsim {

struct ChildResult {
  int exit_code = -1;  // 128 + the signal, if one ended it
  double wall_seconds = 0;
  double cpu_seconds = 0;  // user and system, all threads
};

// "invsim WORDS" as it would be typed in a shell.
std::string ShellLine(const std::vector<std::string>& words);

// `arguments` without the program's name. What it prints goes to `log`, after a
// line "$ " with the ShellLine. It does
// not outlive this process, and is told to end when InterruptRequested().
// Throws InputError if it cannot be started.
ChildResult RunChild(const std::vector<std::string>& arguments,
                     const std::string& log);

// The signal that ended a child of this exit code, 0 if none did.
int SignalOf(int exit_code);

}  // namespace invsim

#endif  // INVSIM_APPS_CHILD_PROCESS_H_
