// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/remembered_term.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

#include "invsim/base/digest.h"
#include "invsim/base/error.h"

namespace invsim {
namespace {

// A record is a header and doubles. The doubles of an evaluation are
//   kEvaluated, outcome, limit, costs (one per frame), x
// and of a linearisation
//   kLinearized, good, x, per frame: cost, residual, upper triangle.
constexpr double kEvaluated = 1, kLinearized = 2;

constexpr char kMagic[8] = {'i', 'n', 'v', 's', 'i', 'm', 'f', '1'};

struct Header {
  std::uint64_t doubles;
  std::uint64_t checksum;
};

std::uint64_t Checksum(const std::vector<double>& record) {
  Digest digest;
  for (const double value : record) digest.Add(value);
  return digest.value();
}

std::vector<double> Flat(const BodySequence& x) {
  std::vector<double> flat(x.shape.begin(), x.shape.end());
  for (int t = 0; t < x.num_frames(); ++t) {
    flat.insert(flat.end(), x.poses[t].begin(), x.poses[t].end());
    flat.insert(flat.end(), x.translations[t].begin(), x.translations[t].end());
  }
  return flat;
}

// Of a record of evaluation; nothing if no evaluation is kept with it.
std::optional<Evaluation> OutcomeFrom(double number) {
  for (const Evaluation kept :
       {Evaluation::kDone, Evaluation::kAbandoned, Evaluation::kFailed})
    if (number == static_cast<double>(kept)) return kept;
  return std::nullopt;
}

// What is not finite is no key: it is not even equal to itself.
template <typename Iterator>
bool AllFinite(Iterator from, Iterator to) {
  return std::all_of(
      from, to, [](double value) { return std::isfinite(value); });
}

constexpr int kTriangle = kNumBodyParameters * (kNumBodyParameters + 1) / 2;
constexpr int kBlockDoubles = 1 + kNumBodyParameters + kTriangle;

void AppendBlock(const FrameBlock& block, std::vector<double>* record) {
  record->push_back(block.cost);
  record->insert(record->end(), block.residual.begin(), block.residual.end());
  for (int c = 0; c < kNumBodyParameters; ++c)
    for (int r = 0; r <= c; ++r) record->push_back(block.jacobian(r, c));
}

FrameBlock BlockFrom(const double* from) {
  FrameBlock block;
  block.cost = *from++;
  block.residual = Eigen::Map<const VectorXd>(from, kNumBodyParameters);
  from += kNumBodyParameters;
  block.jacobian.setZero(kNumBodyParameters, kNumBodyParameters);
  for (int c = 0; c < kNumBodyParameters; ++c)
    for (int r = 0; r <= c; ++r) block.jacobian(r, c) = *from++;
  return block;
}

}  // namespace

RememberedTerm::RememberedTerm(DataTerm* inner, const std::string& path)
    : inner_(inner), path_(path) {
  file_.reset(std::fopen(path.c_str(), "r+b"));
  if (!file_) file_.reset(std::fopen(path.c_str(), "w+b"));
  if (!file_)
    throw InputError(path_ + ": cannot be written: " + std::strerror(errno));
  // Nothing that could not be written may wait to be written later.
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);
  Load();
}

int RememberedTerm::num_frames() const { return inner_->num_frames(); }

void RememberedTerm::Load() {
  char magic[sizeof(kMagic)] = {};
  const size_t got = std::fread(magic, 1, sizeof(magic), file_.get());
  if (got == sizeof(magic) && std::memcmp(magic, kMagic, sizeof(magic)) != 0)
    throw InputError(path_ + ": expected the checkpoint of a fit");
  long at = sizeof(kMagic);
  if (got < sizeof(magic)) {
    std::rewind(file_.get());
    if (std::fwrite(kMagic, 1, sizeof(kMagic), file_.get()) != sizeof(kMagic))
      throw InputError(path_ + ": cannot be written: " + std::strerror(errno));
  } else {
    std::vector<double> record;
    long next = at;
    for (; ReadRecord(at, &record, &next); at = next) Accept(record, at);
  }
  // What was cut short must not stand in front of what follows.
  if (ftruncate(fileno(file_.get()), at) != 0)
    throw InputError(path_ + ": cannot be written: " + std::strerror(errno));
}

bool RememberedTerm::ReadRecord(long at,
                                std::vector<double>* record,
                                long* next) const {
  Header header;
  std::fseek(file_.get(), 0, SEEK_END);
  const long size = std::ftell(file_.get());
  std::fseek(file_.get(), at, SEEK_SET);
  if (std::fread(&header, sizeof(header), 1, file_.get()) != 1) return false;
  const std::uint64_t room = (size - at - sizeof(header)) / sizeof(double);
  if (header.doubles > room || header.doubles < 2) return false;
  record->resize(header.doubles);
  if (std::fread(record->data(), sizeof(double), header.doubles, file_.get()) !=
      header.doubles)
    return false;
  *next =
      at + static_cast<long>(sizeof(header) + header.doubles * sizeof(double));
  return header.checksum == Checksum(*record);
}

void RememberedTerm::Accept(const std::vector<double>& record, long at) {
  const size_t frames = num_frames();
  const size_t unknowns = kNumShape + (kNumPose + 3) * frames;
  const auto first = record.begin();
  if (record[0] == kEvaluated && record.size() == 3 + frames + unknowns) {
    const std::optional<Evaluation> outcome = OutcomeFrom(record[1]);
    const auto known = first + (outcome == Evaluation::kDone ? 3 : 3 + frames);
    if (!outcome || !AllFinite(known, record.end())) return;
    Entry entry;
    entry.outcome = *outcome;
    entry.limit = record[2];
    entry.costs.assign(first + 3, first + 3 + frames);
    points_[Key(first + 3 + frames, record.end())] = std::move(entry);
  } else if (record[0] == kLinearized && record.size() >= 2 + unknowns) {
    if (!AllFinite(first + 2, first + 2 + unknowns)) return;
    const auto found = points_.find(Key(first + 2, first + 2 + unknowns));
    if (found == points_.end()) return;
    if (record[1] == 0)
      found->second.no_derivative = true;
    else if (record.size() == 2 + unknowns + frames * kBlockDoubles &&
             AllFinite(first, record.end()))
      found->second.blocks_at = at;
  }
}

void RememberedTerm::Append(const std::vector<double>& record) {
  if (!error_.empty()) return;
  std::fseek(file_.get(), 0, SEEK_END);
  const long at = std::ftell(file_.get());
  const Header header{record.size(), Checksum(record)};
  if (std::fwrite(&header, sizeof(header), 1, file_.get()) == 1 &&
      std::fwrite(record.data(), sizeof(double), record.size(), file_.get()) ==
          record.size()) {
    Accept(record, at);
    return;
  }
  error_ = path_ + ": cannot be written: " + std::strerror(errno);
  std::clearerr(file_.get());
  if (ftruncate(fileno(file_.get()), at) != 0)
    error_ += "; and not mended either";
}

Evaluation RememberedTerm::Evaluate(const BodySequence& x,
                                    double cost_limit,
                                    std::vector<double>* costs) {
  key_ = Flat(x);
  current_ = x;
  inner_is_here_ = false;
  const auto found = points_.find(key_);
  if (found != points_.end() &&
      (found->second.outcome != Evaluation::kAbandoned ||
       cost_limit <= found->second.limit)) {
    ++recalled_;
    *costs = found->second.costs;
    return found->second.outcome;
  }
  const Evaluation outcome = inner_->Evaluate(x, cost_limit, costs);
  inner_is_here_ = outcome == Evaluation::kDone;
  if (outcome == Evaluation::kStopped) return outcome;
  std::vector<double> record = {
      kEvaluated, static_cast<double>(outcome), cost_limit};
  record.insert(record.end(), costs->begin(), costs->end());
  record.insert(record.end(), key_.begin(), key_.end());
  Append(record);
  return outcome;
}

bool RememberedTerm::Linearize(std::vector<FrameBlock>* blocks) {
  const auto found = points_.find(key_);
  if (found != points_.end() && found->second.no_derivative) return false;
  std::vector<double> record;
  if (found != points_.end() && found->second.blocks_at >= 0) {
    long next;
    if (ReadRecord(found->second.blocks_at, &record, &next)) {
      ++recalled_;
      blocks->resize(num_frames());
      const double* from = record.data() + 2 + key_.size();
      for (FrameBlock& block : *blocks) {
        block = BlockFrom(from);
        from += kBlockDoubles;
      }
      return true;
    }
  }
  if (!inner_is_here_) {
    std::vector<double> costs;
    const double no_limit = std::numeric_limits<double>::infinity();
    if (inner_->Evaluate(current_, no_limit, &costs) != Evaluation::kDone)
      return false;
    inner_is_here_ = true;
  }
  const bool good = inner_->Linearize(blocks);
  record = {kLinearized, good ? 1.0 : 0.0};
  record.insert(record.end(), key_.begin(), key_.end());
  for (size_t t = 0; good && t < blocks->size(); ++t)
    AppendBlock((*blocks)[t], &record);
  Append(record);
  return good;
}

}  // namespace invsim
