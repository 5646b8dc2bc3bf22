// SPDX-License-Identifier: Apache-2.0
#include "lang/budget.h"

namespace vestige::lang {
namespace {

/// Strings that fit into the string object itself.
constexpr std::size_t kShortText = 16;

/// Bytes that two blocks of memory take beside their contents.
constexpr std::size_t kBlocks = 48;

/// A value with its share of the memory.
template <class T>
struct Counted {
  T value;
  Share share;
};

}  // namespace

Datum Budget::text(const Span& span, std::string s) {
  copy(span, s.size());
  if (s.size() < kShortText) return textDatum(std::move(s));
  const auto counted = std::make_shared<Counted<std::string>>();
  counted->share = take(span, sizeof *counted + kBlocks + s.size());
  counted->value.assign(s);  // without the space that it grew by
  return TextPtr(counted, &counted->value);
}

Datum Budget::transform(const Span& span, const Affine& a) {
  const auto counted = std::make_shared<Counted<Affine>>();
  counted->share = take(span, sizeof *counted + kBlocks);
  counted->value = a;
  return AffinePtr(counted, &counted->value);
}

void Budget::stopAtSteps(const Span& span) {
  reporter_.stop(span, "this scene takes more than " + std::to_string(limits_.expandedTokens) +
                           " steps to read: is a loop or a macro endless? --max-tokens raises "
                           "the limit");
}

void Budget::stopAtMemory(const Span& span) {
  reporter_.stop(span, "this scene takes more than " + std::to_string(limits_.memory >> 20) +
                           " MB to read: --max-memory raises the limit");
}

}  // namespace vestige::lang
