// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/remembered_term.h"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <limits>

#include "invsim/base/digest.h"
#include "invsim/base/error.h"
#include "invsim/base/random.h"
#include "invsim/fit/optimizer.h"
#include "invsim/io/file.h"
#include "toy_term.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;

BodySequence Constant(double value) {
  BodySequence x;
  x.shape.setConstant(value);
  for (int t = 0; t < 3; ++t) {
    BodyParameters p;
    p.pose.setConstant(value);
    p.translation.setConstant(value);
    x.Append(p);
  }
  return x;
}

class RememberedTermTest : public ::testing::Test {
 protected:
  RememberedTermTest()
      : path_((fs::path(::testing::TempDir()) /
               ::testing::UnitTest::GetInstance()->current_test_info()->name())
                  .string()) {
    fs::remove(path_);
  }
  ~RememberedTermTest() override { fs::remove(path_); }

  // A whole optimisation; the observer stops it after `most` iterations.
  BodySequence Optimize(ToyTerm* toy, int most) {
    RememberedTerm term(toy, path_);
    BodySequence x = Constant(0);
    Objective objective({}, {}, &term, &x, ToyBody());
    MakeLevenbergMarquardt({})->Run(&objective, [&](const IterationRecord& i) {
      return i.iteration < most;
    });
    EXPECT_EQ(term.error(), "");
    return x;
  }

  std::string path_;
};

TEST_F(RememberedTermTest, AsksTheInnerTermOncePerPoint) {
  ToyTerm toy(Constant(0.2));
  RememberedTerm term(&toy, path_);
  std::vector<double> costs, again;
  EXPECT_EQ(term.Evaluate(Constant(0.1), kNoLimit, &costs), Evaluation::kDone);
  term.Evaluate(Constant(0.3), kNoLimit, &again);
  EXPECT_EQ(term.Evaluate(Constant(0.1), kNoLimit, &again), Evaluation::kDone);
  EXPECT_EQ(costs, again);
  EXPECT_EQ(toy.evaluations, 2);
}

TEST_F(RememberedTermTest, KeepsBlocksBitForBit) {
  ToyTerm toy(Constant(0.2));
  std::vector<double> costs;
  std::vector<FrameBlock> first, second;
  {
    RememberedTerm term(&toy, path_);
    term.Evaluate(Constant(0.1), kNoLimit, &costs);
    ASSERT_TRUE(term.Linearize(&first));
  }
  RememberedTerm term(&toy, path_);
  EXPECT_EQ(term.known(), 1);
  term.Evaluate(Constant(0.1), kNoLimit, &costs);
  ASSERT_TRUE(term.Linearize(&second));
  EXPECT_EQ(toy.evaluations, 1);
  ASSERT_EQ(second.size(), first.size());
  for (size_t t = 0; t < first.size(); ++t) {
    EXPECT_EQ(first[t].cost, second[t].cost);
    EXPECT_EQ(first[t].residual, second[t].residual);
    EXPECT_EQ(first[t].jacobian, second[t].jacobian);
  }
}

// The derivative at a point that was evaluated before the process ended.
TEST_F(RememberedTermTest, LinearizesWhereOnlyTheCostIsKnown) {
  ToyTerm toy(Constant(0.2));
  std::vector<double> costs;
  { RememberedTerm(&toy, path_).Evaluate(Constant(0.1), kNoLimit, &costs); }
  RememberedTerm term(&toy, path_);
  term.Evaluate(Constant(0.1), kNoLimit, &costs);
  std::vector<FrameBlock> blocks;
  ASSERT_TRUE(term.Linearize(&blocks));
  EXPECT_NEAR(blocks[0].cost, costs[0], 1e-12 * costs[0]);
}

TEST_F(RememberedTermTest, AnAbandonedPointIsWorseThanItsLimitOnly) {
  ToyTerm toy(Constant(0.2));
  RememberedTerm term(&toy, path_);
  std::vector<double> costs;
  EXPECT_EQ(term.Evaluate(Constant(5), 1e-3, &costs), Evaluation::kAbandoned);
  EXPECT_EQ(term.Evaluate(Constant(5), 1e-4, &costs), Evaluation::kAbandoned);
  EXPECT_EQ(toy.evaluations, 1);
  EXPECT_EQ(term.Evaluate(Constant(5), kNoLimit, &costs), Evaluation::kDone);
  EXPECT_EQ(toy.evaluations, 2);
}

TEST_F(RememberedTermTest, AResumedFitEndsInTheSameNumbers) {
  ToyTerm toy(Constant(0.2));
  const BodySequence whole = Optimize(&toy, 100);
  const int evaluations = toy.evaluations;
  fs::remove(path_);
  ToyTerm other(Constant(0.2));
  Optimize(&other, 2);
  const int before = other.evaluations;
  const BodySequence resumed = Optimize(&other, 100);
  EXPECT_EQ(resumed.shape, whole.shape);
  EXPECT_EQ(resumed.poses, whole.poses);
  EXPECT_EQ(resumed.translations, whole.translations);
  EXPECT_LT(before, evaluations);
  EXPECT_LE(other.evaluations, evaluations + 1);
}

// However the file was cut, what is whole in front of the cut is used.
TEST_F(RememberedTermTest, SurvivesACutAtAnyPlace) {
  ToyTerm toy(Constant(0.2));
  const BodySequence whole = Optimize(&toy, 100);
  const std::string bytes = ReadFileBytes(path_);
  Random random(3);
  for (int k = 0; k < 20; ++k) {
    WriteFileBytes(
        path_, bytes.substr(0, random.Index(static_cast<int>(bytes.size()))));
    const BodySequence resumed = Optimize(&toy, 100);
    EXPECT_EQ(resumed.shape, whole.shape);
    EXPECT_EQ(resumed.poses, whole.poses);
    EXPECT_EQ(ReadFileBytes(path_), bytes);
  }
}

TEST_F(RememberedTermTest, ADamagedRecordIsNotBelieved) {
  ToyTerm toy(Constant(0.2));
  const BodySequence whole = Optimize(&toy, 100);
  std::string bytes = ReadFileBytes(path_);
  bytes[bytes.size() / 2] ^= 1;
  WriteFileBytes(path_, bytes);
  EXPECT_EQ(Optimize(&toy, 100).shape, whole.shape);
}

// A record whose checksum is right, of what no evaluation can have been.
TEST_F(RememberedTermTest, AnImpossibleRecordIsNotBelieved) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ToyTerm toy(Constant(0.2));
  const auto known = [&](double outcome, double cost, double shape) {
    std::vector<double> record = {1, outcome, kNoLimit, cost, cost, cost};
    record.resize(record.size() + kNumShape + 3 * (kNumPose + 3), shape);
    Digest digest;
    for (const double value : record) digest.Add(value);
    const std::uint64_t header[2] = {record.size(), digest.value()};
    std::string bytes = "invsimf1";
    bytes.append(reinterpret_cast<const char*>(header), sizeof(header));
    bytes.append(reinterpret_cast<const char*>(record.data()),
                 record.size() * sizeof(double));
    WriteFileBytes(path_, bytes);
    return RememberedTerm(&toy, path_).known();
  };
  const double done = static_cast<double>(Evaluation::kDone);
  const double failed = static_cast<double>(Evaluation::kFailed);
  EXPECT_EQ(known(done, 1, 0.5), 1);
  EXPECT_EQ(known(failed, nan, 0.5), 1);
  EXPECT_EQ(known(done, nan, 0.5), 0);
  EXPECT_EQ(known(done, 1, nan), 0);
  for (const double outcome :
       {nan, 1e300, -1.0, 0.5, static_cast<double>(Evaluation::kStopped)})
    EXPECT_EQ(known(outcome, 1, 0.5), 0) << outcome;
}

TEST_F(RememberedTermTest, RefusesAnotherFile) {
  WriteFileBytes(path_, "something else entirely");
  ToyTerm toy(Constant(0.2));
  try {
    RememberedTerm term(&toy, path_);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr(path_));
  }
}

TEST_F(RememberedTermTest, ClosesTheFileItRefuses) {
  const auto open_files = [] {
    const fs::directory_iterator files("/proc/self/fd");
    return std::distance(begin(files), end(files));
  };
  WriteFileBytes(path_, "something else entirely");
  ToyTerm toy(Constant(0.2));
  const auto before = open_files();
  EXPECT_THROW(RememberedTerm(&toy, path_), InputError);
  EXPECT_EQ(open_files(), before);
}

TEST_F(RememberedTermTest, AStopSaysNothingAboutThePoint) {
  ToyTerm toy(Constant(0.2));
  std::vector<double> costs;
  {
    RememberedTerm term(&toy, path_);
    toy.stopped = true;
    EXPECT_EQ(term.Evaluate(Constant(0.1), kNoLimit, &costs),
              Evaluation::kStopped);
    toy.stopped = false;
    EXPECT_EQ(term.Evaluate(Constant(0.1), kNoLimit, &costs),
              Evaluation::kDone);
  }
  EXPECT_EQ(RememberedTerm(&toy, path_).known(), 1);
  EXPECT_EQ(toy.evaluations, 2);
}

// Files of this process that may not grow stand for a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &limit_);
    const rlimit full = {bytes, limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &full);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &limit_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit limit_;
  void (*handler_)(int);
};

TEST_F(RememberedTermTest, RefusesADiskThatIsFullFromTheStart) {
  ToyTerm toy(Constant(0.2));
  const FullDisk full(0);
  EXPECT_THAT([&] { RememberedTerm term(&toy, path_); },
              ::testing::ThrowsMessage<InputError>(
                  ::testing::StartsWith(path_ + ": cannot be written")));
}

// Wherever in a record the disk ends: it is taken back, what is before it is
// good, and the term goes on without the file.
TEST_F(RememberedTermTest, TakesBackARecordForWhichThereIsNoRoom) {
  for (const int room : {1, 20, 1000, 50000}) {
    fs::remove(path_);
    ToyTerm toy(Constant(0.2));
    std::vector<double> costs;
    std::vector<FrameBlock> blocks;
    std::uintmax_t size = 0;
    {
      RememberedTerm term(&toy, path_);
      term.Evaluate(Constant(0.1), kNoLimit, &costs);
      ASSERT_TRUE(term.Linearize(&blocks));
      size = fs::file_size(path_);
      const FullDisk full(size + room);
      EXPECT_EQ(term.Evaluate(Constant(0.3), kNoLimit, &costs),
                Evaluation::kDone);
      EXPECT_TRUE(term.Linearize(&blocks));
      EXPECT_THAT(term.error(), ::testing::StartsWith(path_ + ": cannot be"));
      term.Evaluate(Constant(0.1), kNoLimit, &costs);
      EXPECT_TRUE(term.Linearize(&blocks));
      EXPECT_EQ(term.recalled(), 2);
    }
    // With much room the evaluation found place, not the linearisation.
    const bool evaluated = room > 3000;
    EXPECT_EQ(fs::file_size(path_) > size, evaluated);
    RememberedTerm term(&toy, path_);
    EXPECT_EQ(term.known(), evaluated ? 2 : 1);
    const int before = toy.evaluations;
    term.Evaluate(Constant(0.1), kNoLimit, &costs);
    EXPECT_TRUE(term.Linearize(&blocks));
    EXPECT_EQ(toy.evaluations, before);
  }
}

}  // namespace
}  // namespace invsim
