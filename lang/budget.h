// SPDX-License-Identifier: Apache-2.0
// The work and the memory that reading one text may take. Every loop over something of the user's
// size and every allocation of such a size is counted here.
#pragma once
#include "lang/lang.h"
#include "lang/report.h"
#include "lang/value.h"

namespace vestige::lang {

/// Steps that looking for a file counts as.
inline constexpr std::int64_t kFileSteps = 1000;

class Budget {
 public:
  Budget(const Limits& limits, Reporter& reporter) : limits_(limits), reporter_(reporter) {}

  /// Counts work: a token read, a step of a function, or what takes as long (some 150 ns).
  void step(const Span& span, std::int64_t count = 1) {
    steps_ += count;
    if (steps_ > limits_.expandedTokens) stopAtSteps(span);
    if (*bytes_ > limits_.memory) stopAtMemory(span);
  }
  /// Counts the work of copying or comparing that many bytes.
  void copy(const Span& span, std::size_t bytes) { step(span, std::int64_t(bytes / kBytesAStep)); }
  /// Stops before an allocation that exceeds what is left.
  void need(const Span& span, double bytes) {
    if (double(*bytes_) + bytes > double(limits_.memory)) stopAtMemory(span);
  }
  /// Memory that its owner returns when it is destroyed.
  Share take(const Span& span, std::size_t bytes) {
    need(span, double(bytes));
    return {bytes_, std::int64_t(bytes)};
  }
  /// Memory that is kept until the text has been read.
  void keep(std::int64_t bytes) { *bytes_ += bytes; }
  /// Space for one more element; the old elements and the new ones exist at the same time.
  template <class Vector>
  void reserveOne(const Span& span, Vector& v) {
    if (v.size() < v.capacity()) return;
    const std::size_t wanted = v.size() + v.size() / 2 + 4;
    need(span, double(wanted * sizeof v[0]));
    keep(std::int64_t((wanted - v.capacity()) * sizeof v[0]));
    v.reserve(wanted);
  }
  /// A string that counts as long as it lives.
  Datum text(const Span& span, std::string s);
  /// A transform, likewise.
  Datum transform(const Span& span, const Affine& a);

  /// Bytes now taken, for parts that count by themselves.
  const Total& bytes() const { return bytes_; }
  std::int64_t steps() const { return steps_; }

 private:
  static constexpr std::size_t kBytesAStep = 64;
  [[noreturn]] void stopAtSteps(const Span& span);
  [[noreturn]] void stopAtMemory(const Span& span);

  const Limits& limits_;
  Reporter& reporter_;
  std::int64_t steps_ = 0;
  Total bytes_ = std::make_shared<std::atomic<std::int64_t>>(0);
};

}  // namespace vestige::lang
