// SPDX-License-Identifier: Apache-2.0
// A target without libFuzzer: reads every file of a corpus, then mutations of
// them, always the same ones.
//
//   NAME_fuzz CORPUS_DIRECTORY NUMBER_OF_MUTATIONS [MUTATION FILE]
//
// With MUTATION, the number that a failure printed, writes that input to FILE
// instead.

#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "fuzz_target.h"
#include "invsim/io/file.h"
#include "mutate.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;

// Corpus files are hundreds of bytes: a reader that needs more than this
// beside them believes a number it read.
constexpr std::size_t kMemory = std::size_t{256} << 20;
constexpr std::uint64_t kSeed = 1;

// What is being read, for the message of a crash.
char current[256];

void PrintCurrent(int signal) {
  const char text[] = "while reading ";
  (void)!write(STDERR_FILENO, text, sizeof(text) - 1);
  (void)!write(STDERR_FILENO, current, std::string_view(current).size());
  (void)!write(STDERR_FILENO, "\n", 1);
  ::signal(signal, SIG_DFL);
  raise(signal);
}

// Sanitizers reserve terabytes and have a limit of their own.
void LimitMemory() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t limit = pages * sysconf(_SC_PAGESIZE) + kMemory;
  const rlimit both = {limit, limit};
  setrlimit(RLIMIT_AS, &both);
#endif
}

std::vector<fs::path> FilesIn(const fs::path& directory) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(directory)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string Mutation(const std::vector<std::string>& corpus, int number) {
  Random random(kSeed, number);
  std::string bytes = Mutate(corpus, &random);
  if (kFuzzTarget.mend != nullptr) kFuzzTarget.mend(&bytes);
  return bytes;
}

// The corpus has an archive with a member of this name.
constexpr char kAbsolute[] = "/tmp/escaped.npy";

// Runs in a directory of its own, two levels down, where a file that escapes
// from an archive would show.
int Replay(const fs::path& directory, int num_mutations) {
  std::vector<std::string> corpus;
  const std::vector<fs::path> files = FilesIn(directory);
  for (const fs::path& file : files) corpus.push_back(ReadFileBytes(file));
  if (corpus.empty()) {
    std::fprintf(stderr, "%s: no corpus\n", directory.c_str());
    return 1;
  }
  std::string outside = fs::temp_directory_path() / "invsim-fuzz-XXXXXX";
  if (mkdtemp(outside.data()) == nullptr) return 1;
  const fs::path inside = fs::path(outside) / "a" / "b";
  fs::create_directories(inside);
  fs::current_path(inside);
  const bool was_there = fs::exists(kAbsolute);
  LimitMemory();
  for (std::size_t i = 0; i < corpus.size(); ++i) {
    std::snprintf(current, sizeof(current), "%s", files[i].c_str());
    kFuzzTarget.read(corpus[i]);
  }
  for (int i = 0; i < num_mutations; ++i) {
    std::snprintf(current, sizeof(current), "mutation %d", i);
    kFuzzTarget.read(Mutation(corpus, i));
  }
  const bool is_alone = FilesIn(outside).size() == 1 &&
                        FilesIn(inside.parent_path()).size() == 1 &&
                        FilesIn(inside).empty() &&
                        fs::exists(kAbsolute) == was_there;
  Require(is_alone, "reading writes no file");
  fs::current_path("/");
  fs::remove_all(outside);
  std::printf("%zu files, %d mutations\n", corpus.size(), num_mutations);
  return 0;
}

int Write(const fs::path& directory, int number, const char* path) {
  std::vector<std::string> corpus;
  for (const fs::path& file : FilesIn(directory)) {
    corpus.push_back(ReadFileBytes(file));
  }
  WriteFileBytes(path, Mutation(corpus, number));
  return 0;
}

}  // namespace
}  // namespace invsim

int main(int argc, char** argv) {
  if (argc == 5) return invsim::Write(argv[1], std::atoi(argv[3]), argv[4]);
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s CORPUS MUTATIONS [MUTATION FILE]\n", *argv);
    return 2;
  }
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL}) {
    ::signal(signal, invsim::PrintCurrent);
  }
  return invsim::Replay(argv[1], std::atoi(argv[2]));
}
