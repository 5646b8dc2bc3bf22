// SPDX-License-Identifier: Apache-2.0
#include "lang/outline.h"

#include <algorithm>
#include <string_view>

#include "lang/vocabulary.h"

namespace vestige::lang {
namespace {

using Kind = OutlineNode::Kind;

bool isIn(const std::string& word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}
bool opensChoice(const std::string& w) { return isIn(w, {"if", "ifdef", "ifndef", "switch"}); }
bool opensLoop(const std::string& w) { return isIn(w, {"while", "for"}); }
bool isPart(const std::string& w) { return isIn(w, {"else", "elseif", "case", "range"}); }

class Outliner {
 public:
  Outliner(const TokenisedText& text, const SchemaSource& schemas)
      : text_(text.text), tokens_(text.tokens), words_(schemas) {}

  Outline run() {
    open(Kind::text, 0, 0, 0);
    for (at_ = 0; tokens_[at_].kind != Token::Kind::end; ++at_) {
      endLine();
      const StoredToken& t = tokens_[at_];
      if (t.kind == Token::Kind::directive)
        directive(*t.text);
      else if (t.kind == Token::Kind::sign)
        sign(t.sign);
      else if (t.kind == Token::Kind::name)
        name(*t.text);
    }
    while (open_.size() > 1) closeBefore();
    nodes_[0].end = std::uint32_t(text_.size());
    nodes_[0].after = std::uint32_t(nodes_.size());
    nodes_[0].isFinished = true;
    return std::move(nodes_);
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;
  /// A construct whose end has not been reached.
  struct Open {
    Kind kind;
    std::uint32_t node;          ///< kNone: too deep to be one
    std::uint32_t begin;         ///< of its text
    std::uint32_t brackets = 0;  ///< ( and [ that are open in it
  };

  Open& top() { return open_.back(); }
  bool isLine(const Open& o) const {
    return o.kind == Kind::declaration || o.kind == Kind::directive;
  }
  static bool isBraced(const Open& o) { return o.kind == Kind::block || o.kind == Kind::braces; }

  void open(Kind kind, std::uint32_t begin, std::uint32_t name, std::uint32_t nameEnd) {
    const bool isDeep = open_.size() > std::size_t(kDeepestOutline);
    if (kind == Kind::choice || kind == Kind::loop || kind == Kind::macro)
      constructs_.push_back(open_.size());
    const auto node = isDeep ? kNone : std::uint32_t(nodes_.size());
    if (!isDeep)
      nodes_.push_back({kind, false, begin, begin, name, nameEnd, open_.empty() ? 0 : top().node});
    open_.push_back({kind, node, begin});
  }

  /// The innermost construct ends with the token read now.
  void close() { close(tokens_[at_].end, true); }
  /// It ends in front of this token: lines and parts need no sign at their end, all others lack it.
  void closeBefore() {
    close(tokens_[at_ - 1].end, top().kind == Kind::directive || top().kind == Kind::part);
  }
  void close(std::uint32_t end, bool isFinished) {
    const Open o = top();
    if (!constructs_.empty() && constructs_.back() == open_.size() - 1) constructs_.pop_back();
    open_.pop_back();
    closedAt_ = end;
    if (o.node == kNone) return;
    OutlineNode& n = nodes_[o.node];
    n.isFinished = isFinished;
    n.end = end;
    n.after = std::uint32_t(nodes_.size());
  }
  /// All constructs inside the one at this place of the stack.
  void closeAbove(std::size_t place) {
    while (open_.size() > place + 1) closeBefore();
  }

  /// A directive without brackets ends with its line.
  void endLine() {
    if (top().kind != Kind::directive || top().brackets > 0) return;
    if (tokens_[at_ - 1].kind == Token::Kind::directive) return;
    const auto from = tokens_[at_ - 1].end;
    const std::string_view gap = std::string_view(text_).substr(from, tokens_[at_].begin - from);
    if (gap.find('\n') != std::string_view::npos) closeBefore();
  }

  void directive(const std::string& word) {
    const StoredToken& t = tokens_[at_];
    if (word == "end") return end();
    if (isPart(word)) return part();
    const bool isChoice = opensChoice(word), isLoop = opensLoop(word);
    // These may stand in the value of a declaration; all others end it.
    while (top().kind == Kind::directive || (isLine(top()) && !isChoice && !isLoop)) closeBefore();
    if (isChoice || isLoop) {
      open(isChoice ? Kind::choice : Kind::loop, t.begin, t.begin, t.end);
      if (isChoice) open(Kind::part, t.begin, t.begin, t.end);
      return;
    }
    const bool isDeclaration = isIn(word, {"declare", "local"});
    const bool isMacro = word == "macro";
    const StoredToken& next = tokens_[at_ + 1];  // there is one: the last is `end`
    const bool isNamed = (isDeclaration || isMacro) && next.kind == Token::Kind::name;
    open(isMacro         ? Kind::macro
         : isDeclaration ? Kind::declaration
                         : Kind::directive,
         t.begin, isNamed ? next.begin : t.begin, isNamed ? next.end : t.end);
    if (word == "break") close();
  }

  /// Closes what is open in the innermost construct; braces cannot reach beyond it.
  void end() {
    if (constructs_.empty()) return;
    closeAbove(constructs_.back());
    close();
  }
  void part() {
    if (constructs_.empty() || open_[constructs_.back()].kind != Kind::choice) return;
    closeAbove(constructs_.back());
    const StoredToken& t = tokens_[at_];
    open(Kind::part, t.begin, t.begin, t.end);
  }

  void sign(std::uint16_t sign) {
    if (sign == signCode("{")) return openBraces();
    if (sign == signCode("}")) return closeBraces();
    if (sign == signCode(";") && isLine(top())) return close();
    if (sign == signCode("(") || sign == signCode("[")) ++top().brackets;
    if ((sign == signCode(")") || sign == signCode("]")) && top().brackets > 0) --top().brackets;
  }

  /// The words in front of the braces are their head: a plugin with its kind, or one word.
  void openBraces() {
    const auto isHead = [&](std::uint32_t back) {
      if (at_ < back) return false;
      const StoredToken& t = tokens_[at_ - back];
      return t.kind == Token::Kind::name && t.begin >= closedAt_ && t.begin >= top().begin;
    };
    std::uint32_t words = isHead(1) ? 1 : 0;
    if (words == 1 && isHead(2) && words_.isKind(*tokens_[at_ - 2].text)) words = 2;
    const std::uint32_t begin = tokens_[at_ - words].begin;
    const std::uint32_t end = words > 0 ? tokens_[at_ - 1].end : begin;
    const bool isBlock =
        words > 0 && !isIn(*tokens_[at_ - 1].text,
                           {"array", "mixed", "dictionary", "function", "spline", "transform"});
    open(isBlock ? Kind::block : Kind::braces, begin, begin, end);
  }

  void closeBraces() {
    std::size_t place = open_.size() - 1;
    while (isLine(open_[place])) --place;
    if (!isBraced(open_[place])) return;  // text
    closeAbove(place);
    close();
    const bool isSemicolonNext = tokens_[at_ + 1].sign == signCode(";");
    if (isLine(top()) && top().brackets == 0 && !isSemicolonNext) close();
  }

  /// A block behind a complete value is the next statement.
  void name(const Name& word) {
    if (!isLine(top()) || !words_.opensBlock(word)) return;
    const StoredToken& before = tokens_[at_ - 1];
    if (before.kind == Token::Kind::directive || before.sign == signCode("=")) return;
    if (top().kind == Kind::directive || top().brackets == 0) closeBefore();
  }

  const std::string& text_;
  const std::vector<StoredToken>& tokens_;
  Vocabulary words_;
  Outline nodes_;
  std::vector<Open> open_;
  std::vector<std::size_t> constructs_;  ///< places in open_ of choices, loops and macros
  std::size_t at_ = 0;
  std::uint32_t closedAt_ = 0;  ///< where the last construct ended
};

}  // namespace

Outline outlineOf(const TokenisedText& text, const SchemaSource& schemas) {
  return Outliner(text, schemas).run();
}

std::vector<Fold> foldsOf(const Outline& outline, const TokenisedText& text) {
  std::vector<std::uint32_t> starts = {0};  // of lines
  for (std::size_t i = 0; i < text.text.size(); ++i)
    if (text.text[i] == '\n') starts.push_back(std::uint32_t(i + 1));
  const auto lineOf = [&](std::uint32_t offset) {
    return int(std::upper_bound(starts.begin(), starts.end(), offset) - starts.begin()) - 1;
  };
  std::vector<Fold> folds;
  for (const OutlineNode& n : outline) {
    if (n.kind == Kind::text || n.kind == Kind::choice) continue;  // a choice's parts are folded
    const bool showsEnd = n.isFinished && n.kind != Kind::part && n.kind != Kind::directive;
    const Fold fold{lineOf(n.begin), lineOf(n.end - 1) - (showsEnd ? 1 : 0)};
    if (fold.last > fold.first && (folds.empty() || folds.back().first != fold.first))
      folds.push_back(fold);
  }
  return folds;
}

}  // namespace vestige::lang
