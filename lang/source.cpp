// SPDX-License-Identifier: Apache-2.0
#include "lang/source.h"

#include <algorithm>

#include "lang/lang.h"

namespace vestige::lang {
namespace {

/// Beyond this many different calls only the first part of a chain is reported, so that branching
/// recursion does not fill the memory.
constexpr std::size_t kMostExpansions = 1'000'000;

/// Characters, not bytes, of UTF-8.
int characters(const std::string& text, std::size_t from, std::size_t to) {
  return int(std::count_if(text.begin() + std::ptrdiff_t(from), text.begin() + std::ptrdiff_t(to),
                           [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

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

Span Sources::join(Span a, Span b) const {
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

Place locate(const Span& span, const Sources& sources) {
  Place place;
  if (span.file < 0 || span.file >= sources.size()) return place;
  const Text& text = sources.text(span.file);
  const auto position = [&](std::uint32_t offset, int& line, int& column) {
    offset = std::min(offset, std::uint32_t(text.text.size()));
    const int l = sources.lineOf(span.file, offset);
    line = l + 1;
    column = characters(text.text, text.lineStarts[std::size_t(l)], offset) + 1;
  };
  place.file = text.name;
  position(span.begin, place.line, place.column);
  position(std::max(span.begin, span.end), place.endLine, place.endColumn);
  return place;
}

}  // namespace vestige::lang
