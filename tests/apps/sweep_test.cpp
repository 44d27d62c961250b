// SPDX-License-Identifier: Apache-2.0

// invsim sweep as a user runs it.

#include <gmock/gmock.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "run_command.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr char kBase[] =
    "[sweep]\ncommand = \"simulate\"\n"
    "[base]\ninput.garment = \"tank_top\"\ninput.edge = 0.08\n"
    "input.motion = \"arms_down_and_swing\"\ninput.frames = 2\n"
    "relaxation.settle_seconds = 0\nrelaxation.move_seconds = 0.001\n"
    "relaxation.hold_seconds = 0\n"
    "[reference]\nstep.substeps = 8\n";

class SweepCommandTest : public ::testing::Test {
 protected:
  SweepCommandTest() : directory_(TestDirectory()) {}
  ~SweepCommandTest() override { fs::remove_all(directory_); }

  CommandResult Sweep(const std::string& toml) const {
    const std::string config = (directory_ / "s.toml").string();
    WriteFileBytes(config, toml);
    return RunCommand("sweep -q --config '" + config + "' --out '" +
                      (directory_ / "out").string() + "'");
  }
  nlohmann::json Json() const {
    return nlohmann::json::parse(File("sweep.json"));
  }
  std::string File(const std::string& name) const {
    return ReadFileBytes((directory_ / "out" / name).string());
  }

  fs::path directory_;
};

TEST_F(SweepCommandTest, MeasuresEverySettingAndKeepsFailures) {
  const CommandResult result =
      Sweep(std::string(kBase) +
            "[grid]\nstep.substeps = [1, 8]\n"
            "[list.broken]\ninput.garment = \"none.obj\"\n");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json json = Json();
  ASSERT_EQ(json["results"].size(), 3u);
  const auto& coarse = json["results"][0]["values"];
  const auto& fine = json["results"][1]["values"];
  EXPECT_GT(coarse["cloth_rms_mm"], 0.1);
  EXPECT_EQ(fine["cloth_rms_mm"], 0);  // the reference's own options
  EXPECT_GT(fine["sequence.factorizations"], coarse["sequence.factorizations"]);
  EXPECT_GT(fine["cpu_per_simulated_second"], 0);
  EXPECT_EQ(json["results"][2]["exit_codes"][0], 3);
  EXPECT_THAT(json["results"][2]["failure"].get<std::string>(),
              HasSubstr("none.obj"));
  EXPECT_THAT(File("sweep.html"), HasSubstr("<svg"));
  EXPECT_THAT(File("sweep.csv"), HasSubstr("substeps=8"));
  EXPECT_THAT(result.out, HasSubstr("best error 0: substeps=8"));

  // Nothing is run again; a longer grid runs what is new.
  const std::string before = File("runs/substeps=1/0.json");
  const auto written =
      fs::last_write_time(directory_ / "out/runs/substeps=1/0.json");
  ASSERT_EQ(Sweep(std::string(kBase) + "[grid]\nstep.substeps = [1, 2, 8]\n")
                .exit_code,
            0);
  EXPECT_EQ(Json()["results"].size(), 3u);
  EXPECT_EQ(File("runs/substeps=1/0.json"), before);
  EXPECT_EQ(fs::last_write_time(directory_ / "out/runs/substeps=1/0.json"),
            written);
  // Other options under the same name are no result of this sweep.
  std::string other = kBase;
  other.replace(other.find("0.08"), 4, "0.07");
  const CommandResult refused =
      Sweep(other + "[grid]\nstep.substeps = [1, 8]\n");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
}

TEST_F(SweepCommandTest, TriesSwitchesAndLists) {
  const CommandResult result =
      Sweep(std::string(kBase) +
            "[grid]\nscene.effects = [\"auto\", [\"inertia\", \"membrane\"]]\n"
            "output.ply = [true]\n");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json json = Json();
  EXPECT_EQ(json["results"][0]["name"], "ply=true,effects=auto");
  EXPECT_EQ(json["results"][1]["name"], "ply=true,effects=inertia+membrane");
  EXPECT_GT(json["results"][1]["values"]["cloth_rms_mm"],
            json["results"][0]["values"]["cloth_rms_mm"]);
  EXPECT_THAT(File("sweep.csv"), HasSubstr("effects=inertia+membrane"));
}

// Another garment mesh has other vertices: the surfaces are compared, for the
// runs of the reference's mesh as well, so that all can be held side by side.
TEST_F(SweepCommandTest, OtherMeshesAreComparedAsSurfaces) {
  const CommandResult result =
      Sweep(std::string(kBase) + "[grid]\ninput.edge = [0.08, 0.06]\n");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json json = Json();
  EXPECT_EQ(json["error"], "cloth_surface_mm");
  const auto& same = json["results"][0]["values"];
  const auto& finer = json["results"][1]["values"];
  EXPECT_LT(same["cloth_surface_mm"], 10.0);
  EXPECT_GT(same["cloth_rms_mm"], 0.0);
  EXPECT_GT(finer["cloth_surface_mm"], same["cloth_surface_mm"]);
  EXPECT_LT(finer["cloth_surface_mm"], 50.0);
  EXPECT_FALSE(finer.contains("cloth_rms_mm"));
}

std::string ChildOf(pid_t parent) {
  const std::string pid = std::to_string(parent);
  std::ifstream children("/proc/" + pid + "/task/" + pid + "/children");
  std::string child;
  children >> child;
  return child;
}

// Whether there is such a process; one that nobody waited for is none.
bool Runs(const std::string& pid) {
  std::ifstream stat("/proc/" + pid + "/stat");
  std::string number, name, state;
  return stat >> number >> name >> state && state != "Z";
}

// Whatever ends the sweep, its run ends with it: nobody writes on into a folder
// that the next sweep begins anew.
TEST_F(SweepCommandTest, GoesOnAfterItWasKilled) {
  std::string slow = kBase;
  slow.replace(slow.find("frames = 2"), 10, "frames = 40");
  const std::string toml = slow + "[grid]\nstep.substeps = [1, 2]\n";
  const fs::path run = directory_ / "out/runs/reference/0/cloth/000002.ply";
  const std::string config = (directory_ / "s.toml").string();
  const std::string out = (directory_ / "out").string();
  WriteFileBytes(config, toml);
  const pid_t sweep = fork();
  if (sweep == 0) {
    execl(INVSIM_COMMAND,
          "invsim",
          "sweep",
          "-q",
          "--config",
          config.c_str(),
          "--out",
          out.c_str(),
          nullptr);
    _exit(127);
  }
  while (!fs::exists(run) && waitpid(sweep, nullptr, WNOHANG) == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const std::string child = ChildOf(sweep);
  EXPECT_TRUE(Runs(child));
  kill(sweep, SIGKILL);
  waitpid(sweep, nullptr, 0);
  for (int k = 0; k < 200 && Runs(child); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_FALSE(Runs(child));
  ASSERT_FALSE(fs::exists(directory_ / "out/runs/reference/0.json"));
  const CommandResult again = Sweep(toml);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const nlohmann::json json = Json();
  for (const auto& result : json["results"])
    EXPECT_TRUE(result["usable"]) << result;
}

TEST_F(SweepCommandTest, AnInterruptSaysHowToGoOn) {
  std::string slow = kBase;
  slow.replace(slow.find("frames = 2"), 10, "frames = 40");
  const std::string config = (directory_ / "s.toml").string();
  const std::string out = (directory_ / "out").string();
  WriteFileBytes(config, slow + "[grid]\nstep.substeps = [1]\n");
  const CommandResult result =
      RunAndSignal("sweep --config '" + config + "' --out '" + out + "'",
                   "[ -e '" + out + "/runs/reference/0/cloth/000002.ply' ]",
                   "INT");
  EXPECT_EQ(result.exit_code, 130) << result.out;
  EXPECT_THAT(result.err,
              HasSubstr("interrupted; the same command goes on with " + out));
  EXPECT_FALSE(fs::exists(out + "/runs/reference/0.json"));
}

// Before anything is run, and where it was written.
TEST_F(SweepCommandTest, RefusesWhatNoRunWouldTake) {
  const auto refused = [&](const std::string& more, const char* message) {
    const CommandResult result = Sweep(kBase + more);
    EXPECT_EQ(result.exit_code, 2) << result.out;
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_FALSE(fs::exists(directory_ / "out/runs"));
  };
  refused("[grid]\nstep.substep = [1]\n",
          "s.toml:14:6: unknown option 'step.substep'; did you mean");
  refused("[grid]\nstep.substeps = [0.5]\n", "expected an integer");
  refused("[list.few]\nstep.substeps = \"four\"\n", "s.toml:14:6: step.subst");
  const CommandResult truth =
      Sweep("[sweep]\ntruth = \"nowhere\"\n[grid]\nstep.substeps = [1]\n");
  EXPECT_EQ(truth.exit_code, 3);
  EXPECT_THAT(truth.err, HasSubstr("nowhere: does not exist"));
}

// As soon as there is a result in which it is not.
TEST_F(SweepCommandTest, RefusesAnErrorThatNoResultHas) {
  std::string toml = kBase;
  toml.replace(toml.find("[base]"), 6, "error = \"foo\"\n[base]");
  const CommandResult result = Sweep(toml + "[grid]\nstep.substeps = [1, 2]\n");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("'foo'"));
  EXPECT_TRUE(fs::exists(directory_ / "out/runs/substeps=1/0.json"));
  EXPECT_FALSE(fs::exists(directory_ / "out/runs/substeps=2"));
}

// A simulation that fails says why; the line after that names its folder.
TEST_F(SweepCommandTest, TellsWhyARunFailed) {
  const CommandResult result =
      Sweep(std::string(kBase) + "[grid]\nstep.substeps = [1]\n" +
            "[list.diverges]\nscene.effects = [\"gravity\"]\n");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json failed = Json()["results"][1];
  EXPECT_FALSE(failed["usable"]);
  EXPECT_THAT(failed["failure"].get<std::string>(), HasSubstr("finite"));
}

TEST_F(SweepCommandTest, SaysWhatIsMissing) {
  const CommandResult none = Sweep("[grid]\nstep.substeps = [1]\n");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("[reference]"));
  std::string broken = kBase;
  broken.replace(broken.find("tank_top"), 8, "none.obj");
  const CommandResult reference =
      Sweep(broken + "[grid]\nstep.substeps = [1]\n");
  EXPECT_EQ(reference.exit_code, 3);
  EXPECT_THAT(reference.err, HasSubstr("the reference run failed: "));
  EXPECT_THAT(reference.err, HasSubstr("none.obj"));
  const CommandResult unknown = Sweep(
      "[sweep]\nrepeat = 2\n[reference]\nstep.substeps = 2\n"
      "[grid]\nstep.substeps = [1]\n");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("sweep.repeats"));
}

}  // namespace
}  // namespace invsim
