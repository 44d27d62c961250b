// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_REMEMBERED_TERM_H_
#define INVSIM_FIT_REMEMBERED_TERM_H_

// A data term that never evaluates a point twice, not even after the process
// ended: what the inner term said about each point is appended to a file.
//
// It is the checkpoint of a fit. Optimisers are deterministic, so a fit that
// was stopped, or killed, is resumed by running it again: up to where it came
// it finds every answer in the file, in an instant, and goes on from there
// with the very numbers it would have had. No optimiser has to know.
//
// The file is a sequence of records, each with its length and a checksum. A
// record cut short by a kill or a full disk is dropped, with all that follows.

#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "invsim/fit/data_term.h"

namespace invsim {

class RememberedTerm : public DataTerm {
 public:
  // Reads what `path` holds; it need not exist. `inner` must outlive this and
  // must be the term (data, options, reference) the file was written with.
  // Throws InputError if the file is something else or cannot be written.
  RememberedTerm(DataTerm* inner, const std::string& path);

  int num_frames() const override;
  Evaluation Evaluate(const BodySequence& x,
                      double cost_limit,
                      std::vector<double>* costs) override;
  bool Linearize(std::vector<FrameBlock>* blocks) override;

  // Points known from the file, and how often an answer was found there.
  int known() const { return static_cast<int>(points_.size()); }
  int recalled() const { return recalled_; }
  // Empty, or why the file could not be written any more (a full disk). The
  // records before it are good; the term goes on without the file.
  const std::string& error() const { return error_; }

 private:
  struct Entry {
    Evaluation outcome = Evaluation::kFailed;
    double limit = 0;  // an abandoned point costs more than this
    std::vector<double> costs;
    long blocks_at = -1;  // place of the blocks in the file, -1: not there
    bool no_derivative = false;
  };
  using Key = std::vector<double>;
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void Load();
  void Append(const std::vector<double>& record);
  bool ReadRecord(long at, std::vector<double>* record, long* next) const;
  void Accept(const std::vector<double>& record, long at);

  DataTerm* inner_;
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::map<Key, Entry> points_;
  Key key_;               // of the point evaluated last
  BodySequence current_;  // the same
  bool inner_is_here_ = false;
  int recalled_ = 0;
  std::string error_;
};

}  // namespace invsim

#endif  // INVSIM_FIT_REMEMBERED_TERM_H_
