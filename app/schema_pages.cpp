// SPDX-License-Identifier: Apache-2.0
#include "app/schema_pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "app/schema_text.h"

namespace vestige::app {
namespace {

constexpr const char* kMade =
    "<!-- Made by `vestige describe --markdown` from the plugins' schemas: change those. -->\n";

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// Line breaks and other white space as single blanks, none at either end.
std::string oneLine(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!blank)
      out += c;
    else if (!out.empty() && out.back() != ' ')
      out += ' ';
  }
  if (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

/// A code span. Its fence is longer than any in the text; a table's bar is escaped even there.
std::string code(const std::string& text) {
  std::size_t longest = 0, run = 0;
  std::string inside;
  for (const char c : oneLine(text)) {
    longest = std::max(longest, run = c == '`' ? run + 1 : 0);
    inside += c == '|' ? "\\|" : std::string(1, c);
  }
  if (inside.empty()) return "";
  const std::string fence(longest + 1, '`');
  const char* gap = longest > 0 ? " " : "";
  return fence + gap + inside + gap + fence;
}

std::string line(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += cell.empty() ? " |" : " " + cell + " |";
  return text + "\n";
}

std::string typeCell(const Parameter& p) {
  Parameter bare = p;
  bare.texturable = false;
  const ValueType type = p.isList() ? p.entryType : p.type;
  return type == ValueType::choice || type == ValueType::vec2 || type == ValueType::vec3 ||
                 type == ValueType::vec4
             ? code(typeText(bare))
             : plainMarkdown(typeText(bare));
}

/// Whether a pigment is averaged over the footprint, as SceneBuilder::materialFor() decides it.
std::string textureCell(const Parameter& p, const std::string& kind) {
  if (!p.texturable) return "";
  const bool linear = p.type == ValueType::rgb && !p.isNonlinear && p.name != "normal_map";
  return kind == "brdf" && linear ? "averaged" : "at points";
}

std::string defaultCell(const Parameter& p) {
  if (p.required) return "must be given";
  if (p.type == ValueType::boolean && p.initial.kind == Value::Kind::number)
    return code(p.initial.v[0] != 0 ? "true" : "false");
  return code(valueText(p.initial));
}

std::string rows(const std::vector<Parameter>& parameters, const std::string& kind) {
  std::string text;
  for (const Parameter& p : parameters)
    text += line({code(p.name) + (p.positional ? " \\*" : ""), typeCell(p), plainMarkdown(p.unit),
                  plainMarkdown(rangeText(p)), defaultCell(p), textureCell(p, kind),
                  plainMarkdown(p.help)});
  return text;
}

/// What a scene writes before the brace. A shape's plugin is its own keyword in the language.
std::string headOf(const Schema& s) {
  if (s.name.empty()) return s.kind;
  return s.kind == "shape" ? s.name : s.kind + " " + s.name;
}

/// The anchor that a heading gets.
std::string anchorOf(const Schema& s) {
  std::string anchor;
  for (const char c : headOf(s))
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == ' ')
      anchor += c == ' ' ? '-' : char(std::tolower(static_cast<unsigned char>(c)));
  return anchor;
}

bool hasPositional(const Schema& s) {
  const auto positional = [](const Parameter& p) { return p.positional; };
  return std::any_of(s.params.begin(), s.params.end(), positional) ||
         std::any_of(s.inputs.begin(), s.inputs.end(), positional);
}

std::string section(const Schema& s) {
  std::string text =
      fmt::format("## {}\n\n{}\n", plainMarkdown(headOf(s)), plainMarkdown(s.summary));
  if (!s.params.empty() || !s.inputs.empty())
    text += '\n' + line({"parameter", "type", "unit", "range", "default", "textured", "meaning"}) +
            "| --- | --- | --- | --- | --- | --- | --- |\n" + rows(s.params, s.kind) +
            rows(s.inputs, s.kind);
  if (hasPositional(s)) text += "\n\\* may stand without its name, in this order.\n";
  if (s.children.empty()) return text;
  std::vector<std::string> kinds;
  for (const std::string& kind : s.children) kinds.push_back(code(kind));
  return text + fmt::format("\nMay hold blocks of kind {}.\n", fmt::join(kinds, ", "));
}

/// A file's name: whatever a stranger's library calls its kind, the page stays in the folder.
std::string fileOf(const std::string& kind) {
  std::string name;
  for (const char c : kind)
    name += std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' ? c : '_';
  return (name.empty() ? "_" : name) + ".md";
}

}  // namespace

std::string plainMarkdown(const std::string& text) {
  const std::string whole = oneLine(text);
  // What begins a list, a rule or a heading does so at the start only.
  std::size_t digits = 0;
  while (digits < whole.size() && isDigit(whole[digits])) ++digits;
  const bool numbered = digits > 0 && digits < whole.size() &&
                        (whole[digits] == '.' || whole[digits] == ')') &&
                        (digits + 1 == whole.size() || whole[digits + 1] == ' ');
  std::string out;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const char c = whole[i];
    const bool starts = i == 0 && (c == '-' || c == '+' || c == '=');
    if (starts || (numbered && i == digits) ||
        std::string("\\`*_[]<>|~&$#").find(c) != std::string::npos)
      out += '\\';
    out += c;
  }
  return out;
}

std::vector<Page> schemaPages(const std::vector<const Schema*>& schemas) {
  std::vector<Page> pages = {{"README.md", std::string(kMade) +
                                               "# What a scene is written with\n\n" +
                                               "| kind | words |\n| --- | --- |\n"}};
  const auto sameKind = [&](std::size_t i) {
    return i > 0 && schemas[i]->kind == schemas[i - 1]->kind;
  };
  for (std::size_t i = 0; i < schemas.size(); ++i) {
    const Schema& s = *schemas[i];
    const std::string file = fileOf(s.kind);
    std::string& index = pages[0].text;
    if (!sameKind(i))
      index += fmt::format("{}| [{}]({}) |", i > 0 ? " |\n" : "", plainMarkdown(s.kind), file);
    index += s.name.empty() ? fmt::format(" {}", plainMarkdown(s.summary))
                            : fmt::format(" [{}]({}#{})", plainMarkdown(s.name), file, anchorOf(s));
    if (!sameKind(i))
      pages.push_back({file, fmt::format("{}# {}\n", kMade, plainMarkdown(s.kind))});
    pages.back().text += '\n' + section(s);
  }
  if (!schemas.empty()) pages[0].text += " |\n";
  pages[0].text +=
      "\n**textured**: takes a pigment in place of a constant. *Averaged*: over the path's "
      "footprint;\n*at points*: looked up where the path arrives, for light is not linear in it, "
      "or "
      "two ways of\nfinding the same light must agree. A parameter without a default need not be "
      "given "
      "unless it\nsays so. Kinds that a parameter names are pages of this list.\n";
  return pages;
}

}  // namespace vestige::app
