// SPDX-License-Identifier: Apache-2.0
#include "dispatcher.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <new>
#include <string>

#include "invsim/base/error.h"
#include "invsim/base/logging.h"
#include "invsim/base/names.h"
#include "invsim/base/threads.h"
#include "version.h"

namespace invsim {
namespace {

// One subcommand on the command line, with the flags that all of them have.
class Subcommand {
 public:
  Subcommand(CLI::App* program, Command* command)
      : command_(command),
        app_(program->add_subcommand(command->name(), command->doc())),
        flags_(app_) {
    command->AddArguments(app_, &flags_);
    app_->add_option("--config", context_.config, "TOML file of options")
        ->option_text("FILE.toml");
    app_->add_option(
            "--set", assignments_, "set one option, as often as needed")
        ->option_text("KEY=VALUE")
        ->allow_extra_args(false);
    app_->add_option("--out", context_.out, "directory for the results")
        ->option_text("DIR");
    flags_.Add("--seed", "run.seed", "of everything random");
    flags_.Add("--threads", "run.threads", "0: one per core");
    CLI::Option* quiet = app_->add_flag("-q,--quiet", quiet_, "errors only");
    app_->add_flag("-v,--verbose", verbose_, "say more; -vv even more")
        ->excludes(quiet);
    app_->add_flag("--json", context_.json, "the result as JSON");
  }

  bool chosen() const { return app_->parsed(); }

  ExitCode Run(const char* program) {
    context_.verbosity = quiet_ ? -1 : std::min(verbose_, 2);
    InitLogging(program, context_.verbosity);
    OptionTable table;
    ReadOptions(command_, &context_.run, ReadConfig(), &table);
    context_.options = &table;
    SetThreads(context_.run.threads);
    return command_->Run(context_);
  }

 private:
  Config ReadConfig() const {
    Config config;
    if (!context_.config.empty())
      config.Merge(Config::FromFile(context_.config));
    for (const std::string& assignment : assignments_) {
      config.Assign(assignment, "--set");
    }
    flags_.Apply(&config);
    return config;
  }

  Command* command_;
  CLI::App* app_;
  KeyFlags flags_;
  std::vector<std::string> assignments_;
  bool quiet_ = false;
  int verbose_ = 0;
  CommandContext context_;
};

std::vector<std::string> Names(
    const std::vector<std::unique_ptr<Command>>& commands) {
  std::vector<std::string> names;
  for (const auto& command : commands) names.push_back(command->name());
  return names;
}

// CLI11 would call an unknown command an unexpected argument.
void CheckCommandName(const std::vector<std::string>& names,
                      int argc,
                      char** argv) {
  if (argc < 2) {
    throw UsageError("no command: expected one of " + Join(names) +
                     "; see invsim --help");
  }
  const std::string first = argv[1];
  if (first.empty() || first[0] == '-') return;
  if (std::find(names.begin(), names.end(), first) == names.end()) {
    throw UsageError(UnknownName("command", first, names));
  }
}

ExitCode ParseAndRun(const std::vector<std::unique_ptr<Command>>& commands,
                     int argc,
                     char** argv) {
  CLI::App program("The body under the clothes, by inverse simulation",
                   "invsim");
  program.set_version_flag("--version", VersionText());
  program.require_subcommand(1);
  std::vector<std::unique_ptr<Subcommand>> subcommands;
  for (const auto& command : commands) {
    subcommands.push_back(
        std::make_unique<Subcommand>(&program, command.get()));
  }
  CheckCommandName(Names(commands), argc, argv);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw UsageError(error.what());
    program.exit(error);  // prints the help or the version asked for
    return ExitCode::kOk;
  }
  for (const auto& subcommand : subcommands) {
    if (subcommand->chosen()) return subcommand->Run(argv[0]);
  }
  return ExitCode::kUsage;
}

ExitCode CodeOf(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kUsage:
      return ExitCode::kUsage;
    case ErrorKind::kInput:
      return ExitCode::kInput;
    default:
      return ExitCode::kInternal;
  }
}

ExitCode Complain(std::string message, ExitCode code) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::cerr << "invsim: " << message << std::endl;
  return code;
}

ExitCode RunSafely(const std::vector<std::unique_ptr<Command>>& commands,
                   int argc,
                   char** argv) {
  try {
    const ExitCode code = ParseAndRun(commands, argc, argv);
    if (std::cout.flush()) return code;
    return Complain("standard output cannot be written", ExitCode::kInternal);
  } catch (const Error& error) {
    return Complain(error.what(), CodeOf(error.kind()));
  } catch (const std::bad_alloc&) {
    return Complain("out of memory", ExitCode::kInternal);
  } catch (const std::exception& error) {
    return Complain(std::string("internal error: ") + error.what(),
                    ExitCode::kInternal);
  }
}

}  // namespace

int Dispatch(const std::vector<std::unique_ptr<Command>>& commands,
             int argc,
             char** argv) {
  return static_cast<int>(RunSafely(commands, argc, argv));
}

}  // namespace invsim
