// SPDX-License-Identifier: Apache-2.0
// The structure of a text for editors: blocks, declarations, macros and directives, without
// evaluating anything.
#pragma once
#include <cstdint>
#include <vector>

#include "lang/lang.h"
#include "lang/text_store.h"

namespace vestige::lang {

/// A stretch of text. Its children follow each other inside it; the text in front of, between and
/// behind them is its own.
struct OutlineNode {
  enum class Kind : std::uint8_t {
    text,         ///< all of it
    block,        ///< kind plugin { ... }, and any word that is followed by braces
    braces,       ///< other braces, as of an array or a function
    declaration,  ///< #declare or #local, with its value
    macro,        ///< from #macro to #end
    choice,       ///< from #if, #ifdef, #ifndef or #switch to #end; its children are parts
    part,         ///< of a choice: from #if, #else, #case, ... to the next of them or to #end
    loop,         ///< from #while or #for to #end
    directive,    ///< any other, with its values
  };
  Kind kind = Kind::text;
  bool isFinished = false;              ///< its closing sign or directive is there
  std::uint32_t begin = 0, end = 0;     ///< byte offsets, half open, never within a token
  std::uint32_t name = 0, nameEnd = 0;  ///< of a block's head, a declared name, else of the
                                        ///< directive; empty if there is none
  std::uint32_t parent = 0;             ///< index; the text is its own parent
  std::uint32_t after = 0;              ///< index one past its last descendant
};

/// All nodes in the order of their beginnings, the text first, a node in front of its children.
using Outline = std::vector<OutlineNode>;

/// Nodes are nested at most this deep; what is deeper is text of the innermost.
inline constexpr int kDeepestOutline = 250;

/// Works on every text, unfinished and broken ones too: a construct without an end reaches to the
/// end of what is around it, and an end without a beginning is text. Takes time in proportion to
/// the text. `schemas` tell which words open blocks.
Outline outlineOf(const TokenisedText& text, const SchemaSource& schemas);

/// Lines from 0. Folded, `first` stays visible, and the lines behind it up to `last` do not; the
/// line of a closing sign stays visible, too.
struct Fold {
  int first = 0, last = 0;
};
/// In the order of the text. Of nodes that begin in the same line only the outermost is folded; of
/// a choice, each part.
std::vector<Fold> foldsOf(const Outline& outline, const TokenisedText& text);

}  // namespace vestige::lang
