// SPDX-License-Identifier: Apache-2.0
#include "child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <thread>

#include "invsim/base/error.h"
#include "invsim/base/interrupt.h"
#include "invsim/base/stopwatch.h"

namespace invsim {
namespace {

constexpr char kSelf[] = "/proc/self/exe";
constexpr int kSignalled = 128;
constexpr int kCannotStart = 127;
constexpr std::chrono::milliseconds kBetweenLooks(5);

double Seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

// Becomes the program; between fork and here only what is safe there. It ends
// with its parent, whatever ended that: nobody would wait for it, and the next
// run would find it still writing.
[[noreturn]] void Become(char* const* argv, int output, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() == parent && dup2(output, 1) == 1 && dup2(output, 2) == 2)
    execv(kSelf, argv);
  _exit(kCannotStart);
}

// As it would be typed in a shell.
std::string Quoted(const std::string& word) {
  const bool plain =
      word.find_first_of(" []$&;'\"()*?<>|") == std::string::npos;
  return plain ? word : "'" + word + "'";
}

}  // namespace

std::string ShellLine(const std::vector<std::string>& words) {
  std::string line = "invsim";
  for (const std::string& word : words) line += " " + Quoted(word);
  return line;
}

ChildResult RunChild(const std::vector<std::string>& arguments,
                     const std::string& log) {
  std::vector<std::string> words = {"invsim"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const int file =
      open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0)
    throw InputError(log + ": cannot be written: " + std::strerror(errno));
  // Not among the three that the child gets anew.
  const int output = fcntl(file, F_DUPFD_CLOEXEC, 3);
  close(file);
  dprintf(output, "$ %s\n", ShellLine(arguments).c_str());
  const Stopwatch watch;
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) Become(argv.data(), output, parent);
  const int failed = child < 0 ? errno : 0;
  close(output);
  if (failed != 0)
    throw InputError(log +
                     ": the run cannot be started: " + std::strerror(failed));
  int status = 0;
  rusage usage{};
  for (bool told = false; wait4(child, &status, WNOHANG, &usage) == 0;) {
    if (InterruptRequested() && !told) {
      kill(child, SIGTERM);
      told = true;
    }
    std::this_thread::sleep_for(kBetweenLooks);
  }
  ChildResult result;
  result.wall_seconds = watch.seconds();
  result.cpu_seconds = Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
  result.exit_code =
      WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
  if (result.exit_code == kCannotStart)
    throw InputError(log + ": the run cannot be started");
  return result;
}

int SignalOf(int exit_code) {
  return exit_code > kSignalled ? exit_code - kSignalled : 0;
}

}  // namespace invsim
