// SPDX-License-Identifier: Apache-2.0

// An effect that is off leaves no trace: not in the matrix, not in the times,
// not in the memory. Each is compared with a scene in which the effect does
// not exist at all.

#include <gmock/gmock.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <utility>

#include "invsim/base/threads.h"
#include "invsim/sim/scene.h"
#include "sim/test_scene.h"

namespace {

std::atomic<long> allocations{0};
std::atomic<long> allocated_bytes{0};

void* Allocate(std::size_t size) {
  ++allocations;
  allocated_bytes += static_cast<long>(size);
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}

}  // namespace

// Counts what this program takes from the heap by `new`: everything but what
// Eigen and the sparse solvers take for their matrices.
void* operator new(std::size_t size) { return Allocate(size); }
void* operator new[](std::size_t size) { return Allocate(size); }
// As std::stable_sort asks for its buffer.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return Allocate(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace invsim {
namespace {

// Of one scene: what it took to build it and to simulate two frames.
struct Trace {
  BlockPattern pattern;
  std::vector<std::string> timed;
  long allocations = 0;
  long bytes = 0;
  long to_make = 0;  // allocations of the list of effects
  bool damping_matrix = false;
  Points x;
};

class EffectOff : public ::testing::TestWithParam<std::string> {
 protected:
  // What Embree takes for a search tree depends on the threads that build it.
  EffectOff() { SetThreads(1); }
  ~EffectOff() override { SetThreads(0); }

  // Every effect but GetParam().
  std::vector<std::string> Others() const {
    std::vector<std::string> names;
    for (const std::string& name : Effects().names())
      if (name != GetParam()) names.push_back(name);
    return names;
  }

  Trace Run(const SceneOptions& scene) const {
    Trace trace;
    const long before = allocations, bytes_before = allocated_bytes;
    SimulatorSetup setup = MakeSetup(scene, body_, sheet_, cloth_);
    trace.to_make = allocations - before;
    setup.body_faces.resize(3, 0);
    Simulator simulator(std::move(setup));
    ClothState state{sheet_.placed, Points::Zero(3, sheet_.num_vertices())};
    StepStats stats;
    FrameRecord record;
    for (int frame = 0; frame < 2; ++frame)
      simulator.Advance({}, {}, 1.0 / 60, &state, &stats, &record);
    trace.allocations = allocations - before;
    trace.bytes = allocated_bytes - bytes_before;
    trace.pattern = *simulator.pattern();
    for (const Timers::Part& part : stats.effects.parts())
      trace.timed.push_back(part.name);
    trace.damping_matrix =
        record.substeps[0].linearizations[0].damping.size() > 0;
    trace.x = state.x;
    return trace;
  }

  const BodyModel body_ = BallBody();
  const Garment sheet_ = SheetAboveBall(8, 0.25);
  const Material cloth_ = PlainCloth();
};

TEST_P(EffectOff, LeavesNoTraceInMatrixTimesOrMemory) {
  SceneOptions off, without;
  off.effects = without.effects = Others();
  without.effect_options.erase(GetParam());
  Run(off);  // what is allocated once for all
  const Trace a = Run(off), b = Run(without);
  EXPECT_EQ(a.pattern.row_start, b.pattern.row_start);
  EXPECT_EQ(a.pattern.column, b.pattern.column);
  EXPECT_EQ(a.timed, b.timed);
  EXPECT_THAT(a.timed, testing::ElementsAreArray(Others()));
  EXPECT_EQ(a.allocations, b.allocations);
  EXPECT_EQ(a.bytes, b.bytes);
  EXPECT_EQ(a.x, b.x);
}

// The counterpart: the same figures do see an effect that is on.
TEST_P(EffectOff, IsSeenWhenOn) {
  SceneOptions on, off;
  on.effects = Effects().names();
  off.effects = Others();
  Run(on);
  const Trace a = Run(on), b = Run(off);
  EXPECT_THAT(a.timed, testing::Contains(GetParam()));
  EXPECT_GT(a.to_make, b.to_make);
  EXPECT_GE(a.pattern.num_blocks(), b.pattern.num_blocks());
}

// Blocks that only it couples, and the matrix of damping, are there only with
// an effect that asks for them.
TEST_P(EffectOff, MatricesThatOnlyItNeedsAreNotMade) {
  SceneOptions with, plain;
  plain.effects = {"inertia", "membrane"};
  with.effects = plain.effects;
  if (GetParam() != "inertia" && GetParam() != "membrane")
    with.effects.push_back(GetParam());
  const auto effect = with.effect_options.at(GetParam())->Make(sheet_, cloth_);
  BlockPatternBuilder builder(sheet_.num_vertices());
  effect->AddStencils(&builder);
  plain.effect_options.at("membrane")
      ->Make(sheet_, cloth_)
      ->AddStencils(&builder);
  const Trace a = Run(with), b = Run(plain);
  EXPECT_FALSE(b.damping_matrix);
  EXPECT_EQ(a.damping_matrix, effect->depends_on_velocity());
  EXPECT_EQ(a.pattern.column, builder.Build()->column);
  EXPECT_LE(b.pattern.num_blocks(), a.pattern.num_blocks());
}

INSTANTIATE_TEST_SUITE_P(All,
                         EffectOff,
                         testing::ValuesIn(Effects().names()),
                         [](const auto& p) { return p.param; });

}  // namespace
}  // namespace invsim
