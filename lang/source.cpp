// SPDX-License-Identifier: Apache-2.0
#include "lang/source.h"

#include <algorithm>

#include "lang/lang.h"
#include "lang/utf8.h"

namespace vestige::lang {
namespace {

/// Beyond this many different calls only the first part of a chain is reported, so that branching
/// recursion does not fill the memory.
constexpr std::size_t kMostExpansions = 1'000'000;

/// UTF-16 takes two code units for what is beyond the basic plane.
int utf16Units(const Character& c) { return c.code > 0xFFFF ? 2 : 1; }

}  // namespace

int Sources::add(std::string name, std::string text) {
  Text t{std::move(name), std::move(text), {0}};
  for (std::size_t i = 0; i < t.text.size(); ++i)
    if (t.text[i] == '\n') t.lineStarts.push_back(std::uint32_t(i + 1));
  *memory_ += std::int64_t(t.text.size() + t.lineStarts.capacity() * sizeof t.lineStarts[0]);
  texts_.push_back(std::move(t));
  return size() - 1;
}

int Sources::expand(Expansion::Kind kind, const std::string* name, const Span& call) {
  Expansion made{kind, name, call, depth(call.via) + 1};
  if (const auto found = known_.find(made); found != known_.end()) return found->second;
  if (expansions_.size() >= kMostExpansions) return call.via;
  *memory_ += 4 * std::int64_t(sizeof made);  // in the list, which may be half empty, and the map
  known_[made] = int(expansions_.size());
  made.name = &*names_.insert(*name).first;  // the texts outlive the reading and its names
  expansions_.push_back(made);
  return int(expansions_.size()) - 1;
}

std::size_t Sources::CallHash::operator()(const Expansion& e) const noexcept {
  std::size_t hash = std::hash<const std::string*>()(e.name);
  for (const std::size_t part : {std::size_t(e.kind), std::size_t(e.call.file),
                                 std::size_t(e.call.begin), std::size_t(e.call.via)})
    hash = (hash ^ part) * 0x9E3779B97F4A7C15ull;
  return hash ^ hash >> 32;
}

bool Sources::SameCall::operator()(const Expansion& a, const Expansion& b) const noexcept {
  return a.kind == b.kind && a.name == b.name && a.call.file == b.call.file &&
         a.call.begin == b.call.begin && a.call.via == b.call.via;
}

std::string Sources::excerpt(const Span& span, std::size_t most) const {
  if (span.file < 0) return {};
  const std::size_t length = span.end - span.begin;
  const std::string part = text(span.file).text.substr(span.begin, std::min(length, most));
  return part + (length > most ? "..." : "");
}

int Sources::lineOf(int file, std::uint32_t offset) const {
  const auto& starts = text(file).lineStarts;
  return int(std::upper_bound(starts.begin(), starts.end(), offset) - starts.begin()) - 1;
}

Span Sources::joinAcross(Span a, Span b) const {
  if (a.file < 0) return b;
  if (b.file < 0) return a;
  while (a.via != b.via) {
    Span& deeper = depth(a.via) >= depth(b.via) ? a : b;
    deeper = expansion(deeper.via).call;
  }
  if (a.file != b.file) return a;
  a.begin = std::min(a.begin, b.begin);
  a.end = std::max(a.end, b.end);
  return a;
}

Position Sources::position(int file, std::uint32_t offset) const {
  const Text& t = text(file);
  offset = std::min(offset, std::uint32_t(t.text.size()));
  Position p;
  p.line = lineOf(file, offset);
  std::uint32_t i = t.lineStarts[std::size_t(p.line)];
  while (i < offset) {
    const Character c = characterAt(t.text, i);
    i += std::uint32_t(c.bytes);
    ++p.column;
    p.utf16Column += utf16Units(c);
  }
  return p;
}

std::uint32_t Sources::offset(int file, int line, int utf16Column) const {
  const Text& t = text(file);
  const int last = int(t.lineStarts.size()) - 1;
  const auto l = std::size_t(std::clamp(line, 0, last));
  std::uint32_t end = int(l) < last ? t.lineStarts[l + 1] - 1 : std::uint32_t(t.text.size());
  std::uint32_t i = t.lineStarts[l];
  if (end > i && t.text[end - 1] == '\r') --end;
  while (i < end) {
    const Character c = characterAt(t.text, i);
    utf16Column -= utf16Units(c);
    if (utf16Column < 0) break;
    i += std::uint32_t(c.bytes);
  }
  return i;
}

Place locate(const Span& span, const Sources& sources) {
  Place place;
  if (span.file < 0 || span.file >= sources.size()) return place;
  const Position begin = sources.position(span.file, span.begin);
  const Position end = sources.position(span.file, std::max(span.begin, span.end));
  place.file = sources.text(span.file).name;
  place.line = begin.line + 1, place.column = begin.column + 1;
  place.utf16Column = begin.utf16Column + 1;
  place.endLine = end.line + 1, place.endColumn = end.column + 1;
  place.endUtf16Column = end.utf16Column + 1;
  return place;
}

}  // namespace vestige::lang
