// SPDX-License-Identifier: Apache-2.0
// Prints a diagnostic: place, message, line, caret, and the chain of macro calls and includes.
#include <algorithm>
#include <string_view>

#include "lang/lang.h"
#include "lang/printable.h"
#include "lang/source.h"
#include "lang/utf8.h"

namespace vestige::lang {
namespace {

constexpr int kTab = 4;         ///< columns
constexpr int kWidth = 100;     ///< of the window on a long line
constexpr int kContext = 30;    ///< of it, kept before the caret
constexpr int kLongChain = 10;  ///< calls shown in full

constexpr std::string_view kPlain = "\x1b[0m", kBold = "\x1b[1m", kRed = "\x1b[1;31m",
                           kYellow = "\x1b[1;33m", kCyan = "\x1b[1;36m", kGreen = "\x1b[1;32m";

/// The characters of a line, one string each; controls become '?', tabs the blanks they stand for.
std::vector<std::pair<std::string, std::uint32_t>> glyphs(const std::string& text,
                                                          std::uint32_t begin, std::uint32_t end) {
  std::vector<std::pair<std::string, std::uint32_t>> out;
  const std::string_view line(text.data() + begin, end - begin);
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t bytes = characterAt(line, at).bytes;
    const auto place = std::uint32_t(begin + at);
    if (line[at] == '\t') do
        out.emplace_back(" ", place);
      while (out.size() % kTab != 0);
    else
      out.emplace_back(line[at] == '\n' ? "?" : printable(line.substr(at, bytes)), place);
    at += bytes;
  }
  return out;
}

/// The line that a span begins in, and the carets under it, each cut to the window.
std::pair<std::string, std::string> marked(const Span& span, const Sources& sources) {
  const Text& text = sources.text(span.file);
  const auto size = std::uint32_t(text.text.size());
  const auto line = std::size_t(sources.lineOf(span.file, std::min(span.begin, size)));
  const std::uint32_t begin = text.lineStarts[line];
  std::uint32_t end = line + 1 < text.lineStarts.size() ? text.lineStarts[line + 1] - 1 : size;
  if (end > begin && text.text[end - 1] == '\r') --end;

  // Bytes far from the caret are skipped: a line may be a whole file.
  const std::uint32_t near = 16 * kWidth;
  const bool farFromStart = span.begin > begin + near;
  const std::uint32_t from = farFromStart ? span.begin - near : begin;
  const auto all = glyphs(text.text, from, std::min(end, std::max(span.begin, from) + near));

  const auto column = [&](std::uint32_t offset) {
    return std::size_t(
        std::find_if(all.begin(), all.end(), [&](const auto& g) { return g.second >= offset; }) -
        all.begin());
  };
  const std::size_t caret = column(span.begin);
  const std::size_t last = std::max(caret + 1, column(std::min(span.end, end)));
  const bool cut = caret > std::size_t(kWidth - kContext) || farFromStart;
  const std::size_t first = cut ? caret - std::min<std::size_t>(caret, kContext) : 0;

  std::string shown = cut ? "..." : "";
  std::string marks(shown.size(), ' ');
  for (std::size_t i = first; i < std::min(all.size(), first + kWidth); ++i) shown += all[i].first;
  if (first + kWidth < all.size() || all.size() >= near) shown += "...";
  while (!shown.empty() && shown.back() == ' ') shown.pop_back();
  marks += std::string(caret - first, ' ') + '^';
  marks += std::string(std::min(last, first + kWidth) - std::min(last, caret + 1), '~');
  return {shown, marks};
}

class Printer {
 public:
  Printer(std::ostream& out, const Sources& sources, bool colour)
      : out_(out), sources_(sources), colour_(colour) {}

  void message(const Span& span, std::string_view word, std::string_view style,
               const std::string& text) {
    paint(kBold);
    if (span.file >= 0) out_ << where(span) << ": ";
    paint(style);
    out_ << word << ": ";
    paint(kPlain);
    out_ << printable(text) << '\n';
    if (span.file < 0) return;
    const auto [line, marks] = marked(span, sources_);
    out_ << (line.empty() ? "" : "  ") << line << "\n  ";
    paint(kGreen);
    out_ << marks;
    paint(kPlain);
    out_ << '\n';
  }

  /// The calls and includes that led to a span, innermost first.
  void chain(int via) {
    const int length = sources_.depth(via);
    for (int step = 0; via >= 0; ++step) {
      const Expansion& e = sources_.expansion(via);
      const bool skipped = length > kLongChain && step >= kLongChain - 2 && step < length - 2;
      if (!skipped) {
        out_ << "  "
             << (e.kind == Expansion::Kind::macro ? "in the call of macro '" + *e.name + "' at "
                                                  : "included from ")
             << where(e.call) << '\n';
      } else if (step == kLongChain - 2) {
        out_ << "  ... and " << length - kLongChain << " more\n";
      }
      via = e.call.via;
    }
  }

 private:
  void paint(std::string_view code) {
    if (colour_) out_ << code;
  }
  std::string where(const Span& span) const {
    const Place place = locate(span, sources_);
    return printable(place.file) + ':' + std::to_string(place.line) + ':' +
           std::to_string(place.column);
  }

  std::ostream& out_;
  const Sources& sources_;
  bool colour_;
};

}  // namespace

void print(std::ostream& out, const Diagnostic& diagnostic, const Sources& sources, bool colour) {
  Printer printer(out, sources, colour);
  const bool isError = diagnostic.severity == Severity::error;
  const bool isWarning = diagnostic.severity == Severity::warning;
  printer.message(diagnostic.span,
                  isError     ? "error"
                  : isWarning ? "warning"
                              : "note",
                  isError     ? kRed
                  : isWarning ? kYellow
                              : kCyan,
                  diagnostic.message);
  printer.chain(diagnostic.span.via);
  for (const Note& note : diagnostic.notes) printer.message(note.span, "note", kCyan, note.message);
}

}  // namespace vestige::lang
