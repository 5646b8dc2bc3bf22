// SPDX-License-Identifier: Apache-2.0
// Builds a block while it is parsed, and checks it against its schema.
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
  /// "brdf phong", "sphere", "film": the block's name in messages.
  std::string title() const;

  /// Copies everything from a declared block.
  void inherit(const Block& base);
  const Parameter* row(const std::string& name) const { return schema_.find(name); }
  /// The row of the next positional value, or null.
  const Parameter* nextPositional() const;
  bool mayContain(const std::string& kind) const;

  /// Adds `name value`; reports an error unless the value fits the row.
  void set(const Parameter& row, const Span& nameSpan, const Datum& value, const Span& span);
  void setWord(const Parameter& row, const Span& nameSpan, const std::string& word,
               const Span& span);
  void setBlock(const Parameter& row, const Span& nameSpan, Block block);
  /// Entries, each of which fits the row; reports an error if their number does not.
  void setList(const Parameter& row, const Span& nameSpan, List list, const Span& span);
  void add(Block child);
  /// Transforms everything added so far.
  void move(const Affine& transform);

  /// Reports missing required rows.
  Block finish();
  /// Call it after an error inside the block: suppresses reports of missing rows.
  void forgiveMissing() { isForgiving_ = true; }

 private:
  void store(const Parameter& row, const Span& nameSpan, Value value);
  template <class T>
  void makeRoom(SharedList<T>& list, const Span& span);

  Context& context_;
  const Schema& schema_;
  Block block_;
  std::size_t positionals_ = 0;  ///< number of positional values given
  std::vector<const Parameter*> places_;
  std::vector<const Parameter*> given_;  ///< in these braces
  bool isForgiving_ = false;
  bool hasCopied_ = false, hasMoved_ = false;  ///< lists of the declared block have been copied
};

/// Counts a copy of a block against the limit, and checks how deep it is.
void countBlocks(Context& context, const Block& block, const Span& span);
/// The value converted to the row's type; nothing if an error was reported. Messages call the value
/// `who` ("": the row's name).
std::optional<Value> convert(Context& context, const Parameter& row, const Datum& value,
                             const Span& span, const std::string& who = "");
/// A list whose entries fit the row, counted against the limit; nothing if their number was
/// reported as an error.
std::optional<Value> listOf(Context& context, const Parameter& row, List list, const Span& span);
/// "entry 3 of 'profile'", from an index.
std::string entryName(const Parameter& row, std::size_t index);
/// The key of a map's entry; nothing if an error was reported, because it does not fit or is less
/// than the previous key (null: none).
std::optional<double> keyOf(Context& context, const Parameter& row, const Datum& key,
                            const Span& span, const double* before);
/// "a number", "a colour", "one of box, gaussian": the values that a row accepts.
std::string expectation(const Parameter& row);

}  // namespace vestige::lang
