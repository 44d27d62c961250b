// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_APPS_COMMAND_H_
#define INVSIM_APPS_COMMAND_H_

// A subcommand of `invsim`. The dispatcher (dispatcher.h) parses the command
// line, reads the configuration into the command's options, and runs it:
//
//   defaults < --config FILE.toml < --set key=value < flags of their own
//
// A command writes its result, and nothing else, to standard output; log and
// progress go to standard error; errors are thrown.

#include <CLI/App.hpp>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "exit_code.h"
#include "invsim/base/config.h"
#include "invsim/base/options.h"

namespace invsim {

// Flags that stand for configuration keys, so that `--seed 7` is the same as
// `--set run.seed=7` and is checked by the same option.
class KeyFlags {
 public:
  explicit KeyFlags(CLI::App* app) : app_(app) {}

  void Add(const std::string& flag,
           const std::string& key,
           const std::string& doc);

  // Sets the keys of the flags that were given.
  void Apply(Config* config) const;

 private:
  struct Entry {
    std::string flag;
    std::string key;
    std::string text;
    CLI::Option* option;
  };

  CLI::App* app_;
  std::deque<Entry> entries_;  // CLI11 keeps pointers to the texts
};

// Options of every command: section `run`.
struct RunOptions {
  std::int64_t seed = 0;
  int threads = 0;
};

void Describe(OptionTable* table, RunOptions* options);

// What the dispatcher hands to a command.
struct CommandContext {
  RunOptions run;
  std::string out;                       // --out DIR, "" if not given
  std::string config;                    // --config FILE, "" if not given
  bool json = false;                     // --json: the result as JSON
  int verbosity = 0;                     // -1 (-q) to 2 (-vv)
  const OptionTable* options = nullptr;  // all of them, as resolved
};

class Command {
 public:
  virtual ~Command() = default;
  virtual std::string name() const = 0;
  virtual std::string doc() const = 0;  // one line
  // Positional arguments, flags that are no configuration (`app`) and flags
  // that are (`flags`).
  virtual void AddArguments(CLI::App* app, KeyFlags* flags) = 0;
  // Sections of the configuration beside `run`.
  virtual void AddOptions(OptionTable* table) = 0;
  // Takes away entries that are meant for other than these options, before
  // they are read.
  virtual void TakeConfig(Config*) {}
  virtual ExitCode Run(const CommandContext& context) = 0;
};

// Reads a configuration into the options of a command and those of every
// command, all of which `table`, empty before, then lists. Throws UsageError
// naming where what they do not take was written.
void ReadOptions(Command* command,
                 RunOptions* run,
                 Config config,
                 OptionTable* table);

// One function per command_NAME.cpp.
std::unique_ptr<Command> MakeCheckGradientCommand();
std::unique_ptr<Command> MakeCompareCommand();
std::unique_ptr<Command> MakeDemoCommand();
std::unique_ptr<Command> MakeEvalCommand();
std::unique_ptr<Command> MakeFitCommand();
std::unique_ptr<Command> MakeGalleryCommand();
std::unique_ptr<Command> MakeInitCommand();
std::unique_ptr<Command> MakeInspectCommand();
std::unique_ptr<Command> MakeListCommand();
std::unique_ptr<Command> MakeReportCommand();
std::unique_ptr<Command> MakeSimulateCommand();
std::unique_ptr<Command> MakeSoakCommand();
std::unique_ptr<Command> MakeSweepCommand();
std::unique_ptr<Command> MakeSynthCommand();

// All of them, in alphabetical order (all_commands.cpp).
std::vector<std::unique_ptr<Command>> AllCommands();

}  // namespace invsim

#endif  // INVSIM_APPS_COMMAND_H_
