// SPDX-License-Identifier: Apache-2.0
// The tokens of a text and the gaps between them are the whole text, and the gaps hold only blanks
// and comments: a formatter needs nothing else.
#include "support/catch.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "lang/context.h"

namespace vestige::lang {
namespace {

/// Whether a piece is blanks and whole comments, read by a scanner of our own. The last comment of
/// a text may lack its end.
bool isTrivia(const std::string& s, bool isLast) {
  for (std::size_t i = 0; i < s.size();) {
    if (s.compare(i, 2, "//") == 0) {
      while (i < s.size() && s[i] != '\n') ++i;
    } else if (s.compare(i, 2, "/*") == 0) {
      int depth = 0;
      do {
        const std::string two = s.substr(i, 2);
        depth += two == "/*" ? 1 : two == "*/" ? -1 : 0;
        i += two == "/*" || two == "*/" ? 2 : 1;
      } while (depth > 0 && i < s.size());
      if (depth > 0 && !isLast) return false;
    } else if (std::string(" \t\r\n\f\v").find(s[i++]) == std::string::npos) {
      return false;
    }
  }
  return true;
}

/// "" if the text's tokens are in order and its gaps are trivia, else the offending gap.
std::string lost(const std::string& text) {
  Options options;
  Sources sources;
  Diagnostics diagnostics;
  Edits edits;
  Context context(options, sources, diagnostics, edits);
  const int file = sources.add("a", text);
  const TokenList list = tokenise(file, sources, context.names, nullptr, context.budget);
  std::uint32_t at = 0;
  for (std::uint32_t i = 0; i < list.tokens.size(); ++i) {
    const Token t = list.token(i);
    if (t.span.begin < at || t.span.end < t.span.begin) return "overlapping tokens";
    const bool isEnd = t.kind == Token::Kind::end;
    const std::string gap = text.substr(at, t.span.begin - at);
    if (!isTrivia(gap, isEnd)) return "'" + gap + "'";
    // The token that reports a comment without an end marks its beginning: all that follows is it.
    const bool isOpenComment = t.kind == Token::Kind::bad && sources.excerpt(t.span) == "/*";
    at = isOpenComment ? t.span.begin : t.span.end;
  }
  return at == text.size() ? "" : "the end of the text has no token";
}

}  // namespace

TEST_CASE("the scanner of the gaps sees what is neither blank nor comment", "[lang]") {
  CHECK(isTrivia(" \t// a\n/* b /* c */ */\r\n", false));
  CHECK_FALSE(isTrivia(" x ", false));
  CHECK_FALSE(isTrivia("/* a /* b */ x", false));
  CHECK_FALSE(isTrivia("/* a */ */", false));
}

TEST_CASE("between tokens are only blanks and comments", "[lang]") {
  for (const char* text :
       {"", " ", "a", "a b", "<1,2,3>=<3,2,1>", "#if (1) a /* b /* c */ d */ #end // e",
        "# declare A = 1;", "\"a\\\"b\" // c", "sphere{0,1}#debug \"x\\n\"", "1.5e3.x",
        "a<=b>=c!=d&&e||f==g", "-.5+5.*.5", "A[1][2]"}) {
    INFO(text);
    CHECK(lost(text) == "");
  }
}

TEST_CASE("the same of broken texts", "[lang]") {
  for (const char* text : {"\"no end", "\"no end\nnext line", "/* no end", "/* /* */", "@ $ ` ~ \\",
                           "1e", "1e+", "0x", "#", "# #", "#nonsense 1", "#end", "\xff\xfe a",
                           "\xc3\xa9t\xc3\xa9 = 1", "\"\\q\"", "\"\\u12\"", "a\x01\x02z"}) {
    INFO(text);
    CHECK(lost(text) == "");
  }
  CHECK(lost(std::string("a\0b", 3)) == "");
}

TEST_CASE("the same of the examples and the library", "[lang]") {
  const std::filesystem::path root = VESTIGE_SOURCE_DIR;
  int files = 0;
  for (const char* folder : {"examples", "library"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      const std::string kind = entry.path().extension().string();
      if (kind != ".scene" && kind != ".inc") continue;
      std::stringstream text;
      text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
      INFO(entry.path().string());
      CHECK(lost(text.str()) == "");
      ++files;
    }
  CHECK(files > 20);
}

}  // namespace vestige::lang
