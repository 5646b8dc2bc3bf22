// SPDX-License-Identifier: Apache-2.0
#include "lang/builder.h"

#include "lang/vocabulary.h"

namespace vestige::lang {
namespace {

/// Returns the number of blocks and settings that were copied or changed.
std::int64_t moveBlock(Block& block, const Affine& t);

bool holdsBlocks(const Value& value) {
  return value.block || (value.list && value.list->holdsBlocks);
}

/// Copies of a declared block share the blocks in its settings, so a transformed block must be a
/// new one.
std::int64_t moveValue(Value& value, const Affine& t) {
  std::int64_t count = 1;
  if (value.block) {
    auto moved = std::make_shared<Block>(*value.block);
    count += moveBlock(*moved, t);
    value.block = std::move(moved);
  }
  if (value.list && value.list->holdsBlocks) {
    auto moved = std::make_shared<List>(*value.list);
    for (Entry& e : moved->entries) count += moveValue(e.value, t);
    value.list = std::move(moved);
  }
  return count;
}

std::int64_t moveBlock(Block& block, const Affine& t) {
  std::int64_t count = 1;
  block.world = t * block.world;
  if (!block.children.empty())
    for (Block& child : block.children.edit()) count += moveBlock(child, t);
  if (std::any_of(block.settings.begin(), block.settings.end(),
                  [](const Setting& s) { return holdsBlocks(s.value); }))
    for (Setting& s : block.settings.edit()) count += moveValue(s.value, t);
  return count;
}

/// Bytes of a block and of the list that holds it; its settings are counted one by one.
constexpr std::int64_t kBlockBytes = sizeof(Block) + 64;

std::int64_t measure(const Block& block, int level, int& depth);

std::int64_t measureValue(const Value& value, int level, int& depth) {
  if (value.block) return measure(*value.block, level, depth);
  std::int64_t n = 0;
  if (value.list && value.list->holdsBlocks)
    for (const Entry& e : value.list->entries) n += measureValue(e.value, level, depth);
  return n;
}

/// Number of blocks in a block, itself included; `depth` receives its depth.
std::int64_t measure(const Block& block, int level, int& depth) {
  depth = std::max(depth, level);
  std::int64_t n = 1;
  for (const Block& child : block.children) n += measure(child, level + 1, depth);
  for (const Setting& s : block.settings) n += measureValue(s.value, level + 1, depth);
  return n;
}

}  // namespace

void countBlocks(Context& context, const Block& block, const Span& span) {
  int depth = 0;
  const std::int64_t count = measure(block, 1, depth);
  context.blocks += count;
  context.step(span, count);
  context.budget.keep(kBlockBytes);
  if (context.blocks > context.options.limits.blocks)
    context.reporter.stop(span, "this scene has more than " +
                                    std::to_string(context.options.limits.blocks) +
                                    " blocks: --max-blocks raises the limit");
  if (depth + context.nesting > context.deepest()) context.stopTooDeep(span, "these blocks are");
}

BlockBuilder::BlockBuilder(Context& context, const Schema& schema, const Span& head)
    : context_(context), schema_(schema) {
  block_.kind = schema.kind;
  block_.plugin = schema.name;
  block_.span = head;
  for (const auto* rows : {&schema.params, &schema.inputs})
    for (const Parameter& p : *rows)
      if (p.positional) places_.push_back(&p);
}

std::string BlockBuilder::title() const {
  if (schema_.kind == "shape") return schema_.name;
  return schema_.kind + (schema_.name.empty() ? "" : " " + schema_.name);
}

void BlockBuilder::inherit(const Block& base) {
  countBlocks(context_, base, block_.span);
  block_.settings = base.settings;
  block_.children = base.children;
  block_.own = base.own;
  block_.world = base.world;
}

const Parameter* BlockBuilder::nextPositional() const {
  return positionals_ < places_.size() ? places_[positionals_] : nullptr;
}

bool BlockBuilder::mayContain(const std::string& kind) const {
  const auto& kinds = schema_.children;
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

void BlockBuilder::set(const Parameter& row, const Span& nameSpan, const Datum& datum,
                       const Span& span) {
  auto value = convert(context_, row, datum, span);
  if (!value) value = Value{};  // given with an error: not missing
  value->span = span;
  store(row, nameSpan, std::move(*value));
}

void BlockBuilder::setWord(const Parameter& row, const Span& nameSpan, const std::string& word,
                           const Span& span) {
  set(row, nameSpan, textDatum(word), span);
}

void BlockBuilder::setBlock(const Parameter& row, const Span& nameSpan, Block block) {
  store(row, nameSpan, blockValue(std::move(block)));
}

void BlockBuilder::setList(const Parameter& row, const Span& nameSpan, List list,
                           const Span& span) {
  auto value = listOf(context_, row, std::move(list), span);
  if (!value) value = Value{};
  value->span = span;
  store(row, nameSpan, std::move(*value));
}

void BlockBuilder::store(const Parameter& row, const Span& nameSpan, Value value) {
  for (std::size_t i = positionals_; i < places_.size(); ++i)
    if (places_[i] == &row && row.positional && nameSpan.begin == value.span.begin) {
      positionals_ = i + 1;
      break;
    }
  auto& settings = block_.settings;
  const auto before = std::find_if(settings.begin(), settings.end(),
                                   [&](const Setting& s) { return s.name == row.name; });
  if (before != settings.end()) {
    if (std::find(given_.begin(), given_.end(), &row) != given_.end())
      context_.reporter.warning(nameSpan, "'" + row.name + "' is given twice; this one counts")
          .notes.push_back({before->span, "given here before"});
    const auto index = before - settings.begin();
    settings.edit().erase(settings.edit().begin() + index);
  }
  given_.push_back(&row);
  makeRoom(settings, nameSpan);
  settings.push_back({row.name, std::move(value), nameSpan});
}

void BlockBuilder::add(Block child) {
  int depth = 0;
  measure(child, 1, depth);
  if (depth >= context_.deepest()) countBlocks(context_, child, child.span);
  makeRoom(block_.children, block_.span);
  block_.children.push_back(std::move(child));
}

/// Counts the element that is about to be added to a list, and the copy of a list that is shared.
template <class T>
void BlockBuilder::makeRoom(SharedList<T>& list, const Span& span) {
  const std::size_t room = std::exchange(hasCopied_, true) ? 2 : list.size() + 2;
  context_.budget.need(span, double(room * sizeof(T)));
  context_.budget.keep(std::int64_t(room * sizeof(T)));
}

void BlockBuilder::move(const Affine& transform) {
  block_.own = transform * block_.own;
  const std::int64_t count = moveBlock(block_, transform);
  context_.step(block_.span, count);
  if (!std::exchange(hasMoved_, true)) context_.budget.keep(count * kBlockBytes);
}

Block BlockBuilder::finish() {
  for (const auto* rows : {&schema_.params, &schema_.inputs})
    for (const Parameter& p : *rows)
      if (p.required && !block_.find(p.name) && !isForgiving_)
        context_.reporter.error(block_.span, title() + " needs '" + p.name + "'" +
                                                 (p.help.empty() ? "" : ": " + p.help) +
                                                 (p.unit.empty() ? "" : " (" + p.unit + ")"));
  return std::move(block_);
}

}  // namespace vestige::lang
