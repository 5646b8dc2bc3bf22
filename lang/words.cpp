// SPDX-License-Identifier: Apache-2.0
#include "lang/words.h"

#include <string>
#include <unordered_map>

namespace vestige::lang {
namespace {

/// In the order of the enum, from Word::rgb on.
constexpr const char* kWords[] = {"rgb",
                                  "rgbf",
                                  "rgbt",
                                  "rgbft",
                                  "srgb",
                                  "srgbf",
                                  "srgbt",
                                  "srgbft",
                                  "color",
                                  "colour",
                                  "red",
                                  "green",
                                  "blue",
                                  "filter",
                                  "transmit",
                                  "gray",
                                  "grey",
                                  "x",
                                  "y",
                                  "z",
                                  "t",
                                  "u",
                                  "v",
                                  "pi",
                                  "tau",
                                  "true",
                                  "yes",
                                  "on",
                                  "false",
                                  "no",
                                  "off",
                                  "clock",
                                  "clock_on",
                                  "now",
                                  "version",
                                  "defined",
                                  "sum",
                                  "prod",
                                  "linear_spline",
                                  "quadratic_spline",
                                  "cubic_spline",
                                  "natural_spline",
                                  "spline",
                                  "array",
                                  "function",
                                  "translate",
                                  "rotate",
                                  "scale",
                                  "matrix",
                                  "transform",
                                  "global",
                                  "declare",
                                  "local",
                                  "undef",
                                  "macro",
                                  "include",
                                  "fopen",
                                  "fclose",
                                  "read",
                                  "write",
                                  "debug",
                                  "warning",
                                  "error"};
static_assert(std::size(kWords) == std::size_t(Word::error));

/// In the order of the enum.
constexpr const char* kOps[] = {
    "", "+", "-", "*", "/", "%", "<", "<=", "=", ">=", ">", "!=", "&", "|", "!"};
static_assert(std::size(kOps) == std::size_t(Op::invert) + 1);

}  // namespace

Word wordOf(std::string_view text) {
  static const std::unordered_map<std::string_view, Word> all = [] {
    std::unordered_map<std::string_view, Word> words;
    for (std::size_t i = 0; i < std::size(kWords); ++i) words[kWords[i]] = Word(i + 1);
    return words;
  }();
  const auto found = all.find(text);
  return found == all.end() ? Word::none : found->second;
}

const char* textOf(Word word) { return word == Word::none ? "" : kWords[std::size_t(word) - 1]; }
const char* textOf(Op op) { return kOps[std::size_t(op)]; }

}  // namespace vestige::lang
