// SPDX-License-Identifier: Apache-2.0
// A block while it is read, held against its schema.
#pragma once
#include <optional>

#include "lang/context.h"
#include "lang/value.h"

namespace vestige::lang {

class BlockBuilder {
 public:
  BlockBuilder(Context& context, const Schema& schema, const Span& head);

  const Schema& schema() const { return schema_; }
  const Span& head() const { return block_.span; }
  void extendHead(const Span& head) { block_.span = head; }
  /// "brdf phong", "sphere", "film": what messages call it.
  std::string title() const;

  /// Takes everything over from a declared block.
  void inherit(const Block& base);
  const Parameter* row(const std::string& name) const { return schema_.find(name); }
  /// The row that the next value without a name belongs to, or null.
  const Parameter* nextPositional() const;
  bool mayContain(const std::string& kind) const;

  /// `name value`; complains unless the value fits the row.
  void set(const Parameter& row, const Span& nameSpan, const Datum& value, const Span& span);
  void setWord(const Parameter& row, const Span& nameSpan, const std::string& word,
               const Span& span);
  void setBlock(const Parameter& row, const Span& nameSpan, Block block);
  /// Entries that fit the row one by one; complains about their number.
  void setList(const Parameter& row, const Span& nameSpan, List list, const Span& span);
  void add(Block child);
  /// Moves what is there by now.
  void move(const Affine& transform);

  /// Complains about required rows that are missing.
  Block finish();
  /// After an error inside: what is missing may have been meant.
  void forgiveMissing() { isForgiving_ = true; }

 private:
  void store(const Parameter& row, const Span& nameSpan, Value value);

  Context& context_;
  const Schema& schema_;
  Block block_;
  std::size_t positionals_ = 0;  ///< how many of them have been given
  std::vector<const Parameter*> places_;
  std::vector<const Parameter*> given_;  ///< in these braces
  bool isForgiving_ = false;
};

/// Counts a copy of a block against the limit, and checks how deep it is.
void countBlocks(Context& context, const Block& block, const Span& span);
/// A value as the row wants it; nothing after a complaint, which calls it `who` ("": by the row's
/// name).
std::optional<Value> convert(Context& context, const Parameter& row, const Datum& value,
                             const Span& span, const std::string& who = "");
/// A list whose entries fit the row, counted against the limit; nothing after a complaint about
/// their number.
std::optional<Value> listOf(Context& context, const Parameter& row, List list, const Span& span);
/// "entry 3 of 'profile'", from an index.
std::string entryName(const Parameter& row, std::size_t index);
/// The key of a map's entry; complains if it does not fit or is less than the one before (null:
/// there is none). Nothing after a complaint.
std::optional<double> keyOf(Context& context, const Parameter& row, const Datum& key,
                            const Span& span, const double* before);
/// "a number", "a colour", "one of box, gaussian": what a row takes.
std::string expectation(const Parameter& row);

}  // namespace vestige::lang
