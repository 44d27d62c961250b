// SPDX-License-Identifier: Apache-2.0

// Fits that are stopped, killed, or out of disk space, and go on; and that a
// fit is the same however it was run.

#include <cstdlib>
#include <map>

#include "fit_command.h"
#include "invsim/base/random.h"
#include "invsim/base/stopwatch.h"
#include "invsim/io/folder_lock.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

// What a fit found.
struct Outcome {
  Motion body;
  Points cloth;
  std::map<std::string, nlohmann::json> numbers;  // of the report
};

// To the last bit.
void ExpectSame(const Outcome& a, const Outcome& b, const std::string& what) {
  for (int t = 0; t < a.body.num_frames(); ++t) {
    const BodyParameters p = a.body.Frame(t), q = b.body.Frame(t);
    EXPECT_EQ(p.shape, q.shape) << what;
    EXPECT_EQ(p.pose, q.pose) << what;
    EXPECT_EQ(p.translation, q.translation) << what;
  }
  EXPECT_EQ(a.cloth, b.cloth) << what;
  EXPECT_EQ(a.numbers.size(), b.numbers.size()) << what;
  for (const auto& [key, value] : a.numbers) {
    const auto found = b.numbers.find(key);
    if (found == b.numbers.end())
      ADD_FAILURE() << key << " is missing, " << what;
    else
      EXPECT_EQ(value, found->second) << key << ", " << what;
  }
}

class FitResumeTest : public FitCommandTest {
 protected:
  // Of the report all but times and threads. What only a fit says that was not
  // stopped (its dressing, how much it simulated) is left out unless `whole`.
  Outcome Found(bool whole = false) const {
    Outcome found{ReadMotion((out() / "body.npz").string()),
                  ReadPly((out() / "cloth/000001.ply").string()).vertices,
                  {}};
    const nlohmann::json report = Report().flatten();
    for (const auto& [key, value] : report.items()) {
      if (key.find("seconds") != std::string::npos || key == "/inputs/threads")
        continue;
      if (!whole &&
          (key.starts_with("/simulation/") ||
           key.find("/tries/") != std::string::npos || key.ends_with("/tries")))
        continue;
      found.numbers[key] = value;
    }
    EXPECT_GT(found.numbers.size(), 50u);
    return found;
  }
  fs::path Evaluations() const {
    return out() / "checkpoint/evaluations_1.bin";
  }
  // A shell's test of whether there are more than so many bytes of them.
  std::string HasEvaluations(long bytes) const {
    return "[ \"$(stat -c %s '" + Evaluations().string() +
           "' 2>/dev/null || echo 0)\" -gt " + std::to_string(bytes) + " ]";
  }
  // Runs a fit in which no file may grow beyond that; the line it complains.
  std::string RunWithFullDisk(const std::string& arguments, long bytes) {
    const CommandResult result =
        RunShell("trap '' XFSZ; ulimit -f " + std::to_string(bytes / 512) +
                 "; '" INVSIM_COMMAND "' fit " + arguments);
    EXPECT_EQ(result.exit_code, kInput);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1)
        << result.err;
    return result.err;
  }
};

TEST_F(FitResumeTest, GoesOnAfterEverySignal) {
  const std::string arguments = Arguments(
      "--frames 2 --set lm.iterations=6 --set lm.refused_steps=0"
      " --set lm.function_tolerance=0");
  ASSERT_EQ(RunCommand("fit " + arguments).exit_code, kStoppedEarly);
  const Outcome expected = Found();
  fs::remove_all(out());
  std::string line = "fit " + arguments;
  long bytes = 1000;  // more than no evaluation
  for (const std::string signal : {"INT", "TERM"}) {
    const CommandResult result =
        RunAndSignal(line, HasEvaluations(bytes), signal);
    EXPECT_EQ(result.exit_code, kInterrupted) << result.err;
    EXPECT_THAT(result.err, HasSubstr("go on with: invsim fit --resume"));
    EXPECT_TRUE(fs::exists(out() / "checkpoint/start.npz"));
    ASSERT_TRUE(fs::exists(Evaluations()));
    EXPECT_GT(static_cast<long>(fs::file_size(Evaluations())), bytes);
    EXPECT_FALSE(fs::exists(out() / "report.json"));
    bytes = static_cast<long>(fs::file_size(Evaluations()));
    line = Resume();
  }
  const CommandResult resumed = RunCommand(Resume());
  EXPECT_EQ(resumed.exit_code, kStoppedEarly) << resumed.err;
  ExpectSame(Found(), expected, "interrupted");
}

// A search that would go on for minutes.
TEST_F(FitResumeTest, SaysThatNothingIsKeptOfTheInitialisation) {
  const CommandResult result =
      RunAndSignal("fit " + Arguments("--set init.headings=5000"),
                   "[ -e '" + (out() / "checkpoint").string() + "' ]",
                   "TERM");
  EXPECT_EQ(result.exit_code, kInterrupted) << result.err;
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("before the first body was found"),
                    HasSubstr("begin again with"),
                    Not(HasSubstr("go on"))));
  EXPECT_FALSE(fs::exists(out() / "checkpoint/start.npz"));
}

TEST_F(FitResumeTest, ATimeLimitEndsTheInitialisation) {
  const CommandResult result = RunCommand(
      "init " +
      Arguments("--frames 1 --time-limit 0.3 --set init.headings=5000"));
  EXPECT_EQ(result.exit_code, kStoppedEarly) << result.err;
  EXPECT_EQ(Report()["status"], "time limit");
  EXPECT_FALSE(fs::exists(out() / "checkpoint/start.npz"));
}

// Wherever the limits fall. In the whole fit the optimisation takes longest.
TEST_F(FitResumeTest, GoesOnAfterTimeLimits) {
  const std::string arguments = Arguments("--frames 2 --set fit.dressings=2");
  const Stopwatch watch;
  ASSERT_EQ(RunCommand("fit " + arguments).exit_code, kStoppedEarly);
  const double whole = watch.seconds();
  const Outcome expected = Found();
  fs::remove_all(out());
  const auto limit = [&](double share) {
    return " --time-limit " + std::to_string(share * whole);
  };
  CommandResult result = RunCommand("fit " + arguments + limit(0.6));
  EXPECT_EQ(result.exit_code, kStoppedEarly) << result.err;
  EXPECT_TRUE(Report()["usable"]);
  result = RunCommand(Resume() + limit(0.3));
  EXPECT_EQ(result.exit_code, kStoppedEarly) << result.err;
  EXPECT_TRUE(Report()["usable"]);
  result = RunCommand(Resume() + " --time-limit 0");
  EXPECT_EQ(result.exit_code, kStoppedEarly) << result.err;
  EXPECT_EQ(Report()["status"], "iteration limit");
  ExpectSame(Found(), expected, "after time limits");
}

// Whenever a fit is killed, and killed again when it goes on, what it left is
// enough to end alike. INVSIM_KILLS=50 for more than the suite has time for.
TEST_F(FitResumeTest, GoesOnAfterBeingKilled) {
  const char* asked = std::getenv("INVSIM_KILLS");
  const int kills = asked ? std::atoi(asked) : 3;
  // Also while it is dressed, and optimised, for the second time.
  const std::string arguments = Arguments("--frames 2 --set fit.dressings=2");
  const Stopwatch watch;
  ASSERT_EQ(RunCommand("fit " + arguments).exit_code, kStoppedEarly);
  double whole = watch.seconds();
  const Outcome expected = Found();
  Random random(11);
  int resumed = 0;
  for (int k = 0; k < kills || (resumed == 0 && k < kills + 4); ++k) {
    fs::remove_all(out());
    const auto kill = [&](const std::string& line, double share) {
      const std::string at = std::to_string(share * whole);
      RunShell("timeout -s KILL " + at + " '" INVSIM_COMMAND "' " + line);
      return at + " s ";
    };
    std::string when = kill("fit " + arguments, random.Uniform(0.1, 0.95));
    when += kill(Resume(), random.Uniform(0.05, 0.4));
    CommandResult result = RunCommand(Resume());
    if (result.exit_code == kUsage) {  // killed before there was anything
      EXPECT_THAT(result.err, HasSubstr("no run to resume"));
      result = RunCommand("fit --force " + arguments);
      whole *= 1.5;  // the machine has become slower
    } else {
      ++resumed;
    }
    ASSERT_EQ(result.exit_code, kStoppedEarly)
        << "killed after " << when << ": " << result.err;
    ExpectSame(Found(), expected, "killed after " + when);
  }
  EXPECT_GT(resumed, 0);
}

// Files that may not grow stand for a full disk.
TEST_F(FitResumeTest, KeepsTheCheckpointWhenTheDiskIsFull) {
  const std::string arguments = Arguments("--frames 2 --set lm.iterations=1");
  ASSERT_EQ(RunCommand("fit " + arguments).exit_code, kStoppedEarly);
  const Outcome expected = Found();
  const long reference =
      static_cast<long>(fs::file_size(out() / "checkpoint/reference_1.npz"));
  const long evaluations = static_cast<long>(fs::file_size(Evaluations()));
  const long some = 3 * evaluations / 4;
  const long results =
      static_cast<long>(fs::file_size(out() / "body/000000.ply"));
  ASSERT_LT(reference, some - 1000);
  ASSERT_LT(evaluations, results - 10000);
  fs::remove_all(out());

  EXPECT_THAT(RunWithFullDisk(arguments, some),
              HasSubstr(Evaluations().string() + ": cannot be written"));
  EXPECT_GT(fs::file_size(Evaluations()), 1000u);
  EXPECT_LT(static_cast<long>(fs::file_size(Evaluations())), evaluations);
  CommandResult resumed = RunCommand(Resume());
  EXPECT_EQ(resumed.exit_code, kStoppedEarly) << resumed.err;
  EXPECT_THAT(ReadFileBytes((out() / "solver.txt").string()),
              HasSubstr("answers from checkpoint"));
  ExpectSame(Found(), expected, "no room for evaluations");

  fs::remove_all(out());
  EXPECT_THAT(RunWithFullDisk(arguments, evaluations + 5000),
              AllOf(HasSubstr(out().string()), Not(HasSubstr("checkpoint"))));
  resumed = RunCommand(Resume());
  EXPECT_EQ(resumed.exit_code, kStoppedEarly) << resumed.err;
  ExpectSame(Found(), expected, "no room for results");
}

TEST_F(FitResumeTest, RefusesToGoOnFromOtherPoints) {
  ASSERT_EQ(RunCommand("init " + Arguments("--frames 2")).exit_code, kOk);
  const std::string config =
      ReadFileBytes((out() / "config.resolved.toml").string());
  const Points cloud = person_.Scan(Body(1), kPoints, 1);
  WriteFrame(1, cloud.array() + 0.05);
  const std::string resume = "init --resume -q --out '" + out().string() + "'";
  ExpectRefused(resume + " --time-limit 1000",
                kInput,
                AllOf(HasSubstr("the points of frame 1 changed"),
                      HasSubstr("choose another folder, or --force")));
  EXPECT_EQ(ReadFileBytes((out() / "config.resolved.toml").string()), config);
  WriteFrame(1, cloud);
  EXPECT_EQ(RunCommand(resume).exit_code, kOk);
  // The options, too, if it is not the command line that changed them.
  std::string edited = config;
  const std::string was = "friction = ";
  edited.insert(edited.find(was) + was.size(), "1");
  WriteFileBytes((out() / "config.resolved.toml").string(), edited);
  ExpectRefused(resume, kInput, HasSubstr("an option changed"));
}

TEST_F(FitResumeTest, RefusesAFolderInWhichAnotherRunIsWriting) {
  fs::create_directories(out() / "checkpoint");
  WriteFileBytes((out() / "config.resolved.toml").string(), "mine");
  const FolderLock lock(out().string());
  const std::string message = out().string() + ": another run is writing";
  ExpectRefused(Resume(), kUsage, HasSubstr(message));
  ExpectRefused("fit --force " + Arguments(), kUsage, HasSubstr(message));
  EXPECT_EQ(ReadFileBytes((out() / "config.resolved.toml").string()), "mine");
}

// The same numbers in every run, on one thread and on two; of more frames than
// one thread takes at a time.
TEST_F(FitResumeTest, RepeatsItself) {
  for (int t = 4; t < 6; ++t) WriteFrame(t, person_.Scan(Body(t), kPoints, t));
  const auto run = [&](const std::string& threads) {
    EXPECT_EQ(
        RunCommand("fit --force " +
                   Arguments("--set fit.dressings=2 --threads " + threads))
            .exit_code,
        kStoppedEarly);
    EXPECT_EQ(Report()["inputs"]["frames"], 6);
    return Found(true);
  };
  const Outcome one = run("1");
  for (const std::string threads : {"2", "2"})
    ExpectSame(run(threads), one, threads + " threads");
}

}  // namespace
}  // namespace invsim
