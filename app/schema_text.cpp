// SPDX-License-Identifier: Apache-2.0
#include "app/schema_text.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

namespace vestige::app {
namespace {

using Json = nlohmann::ordered_json;

/// Columns that text takes on a terminal: UTF-8 continuation bytes take none.
int columns(const std::string& text) {
  int n = 0;
  for (const unsigned char c : text) n += (c & 0xc0) != 0x80;
  return n;
}

/// `text` broken at blanks into lines of at most `width` columns; the second and later ones begin
/// with `indent` blanks.
std::string wrapped(const std::string& text, int width, int indent) {
  std::string out;
  int used = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t blank = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, blank - at);
    if (used > 0 && used + 1 + columns(word) > width) {
      out += '\n' + std::string(std::size_t(indent), ' ');
      used = 0;
    } else if (used > 0) {
      out += ' ', ++used;
    }
    out += word, used += columns(word);
    at = blank + 1;
  }
  return out;
}

/// A type for people and, stable whatever those words become, for programs.
struct TypeName {
  ValueType type;
  const char *word, *id;
};
constexpr TypeName kTypeNames[] = {{ValueType::real, "number", "real"},
                                   {ValueType::integer, "integer", "integer"},
                                   {ValueType::boolean, "boolean", "boolean"},
                                   {ValueType::rgb, "colour", "rgb"},
                                   {ValueType::vec2, "<x, y>", "vec2"},
                                   {ValueType::vec3, "<x, y, z>", "vec3"},
                                   {ValueType::vec4, "<a, b, c, d>", "vec4"},
                                   {ValueType::text, "text", "text"},
                                   {ValueType::file, "file name", "file"},
                                   {ValueType::choice, "choice", "choice"},
                                   {ValueType::block, "block", "block"},
                                   {ValueType::list, "list", "list"},
                                   {ValueType::map, "map", "map"},
                                   {ValueType::function, "function", "function"}};

const TypeName& nameOf(ValueType type) {
  for (const TypeName& name : kTypeNames)
    if (name.type == type) return name;
  assert(false);
  return kTypeNames[0];
}

std::string helpOf(const Parameter& p) {
  std::string text = p.help;
  if (!p.unit.empty()) text += fmt::format("{}[{}]", text.empty() ? "" : " ", p.unit);
  return text;
}

void addRows(std::vector<Row>& rows, const std::vector<Parameter>& parameters) {
  for (const Parameter& p : parameters)
    rows.push_back({"  " + p.name + (p.positional ? " *" : ""), typeText(p),
                    p.required ? "must be given" : valueText(p.initial), rangeText(p), helpOf(p)});
}

Json toJson(const Value& v, ValueType type) {
  switch (v.kind) {
    case Value::Kind::number:
      return type == ValueType::boolean   ? Json(v.v[0] != 0)
             : type == ValueType::integer ? Json(std::int64_t(v.v[0]))
                                          : Json(v.v[0]);
    case Value::Kind::vector:
      return std::vector<double>(v.v, v.v + v.size);
    case Value::Kind::colour:
      return std::vector<double>(v.v, v.v + 3);
    case Value::Kind::text:
      return v.text.str();
    default:
      return nullptr;
  }
}

Json toJson(const Parameter& p) {
  Json json = {
      {"name", p.name}, {"type", nameOf(p.type).id}, {"default", toJson(p.initial, p.type)}};
  if (std::isfinite(p.low)) json[p.openLow ? "above" : "minimum"] = p.low;
  if (std::isfinite(p.high)) json["maximum"] = p.high;
  json["required"] = p.required, json["positional"] = p.positional;
  json["texturable"] = p.texturable, json["unit"] = p.unit, json["help"] = p.help;
  if (p.isList()) {
    json["entry_type"] = nameOf(p.entryType).id;
    json["minimum_entries"] = p.minEntries;
    if (p.maxEntries < std::numeric_limits<int>::max()) json["maximum_entries"] = p.maxEntries;
  }
  if (p.type == ValueType::map) {
    if (std::isfinite(p.lowKey)) json["minimum_key"] = p.lowKey;
    if (std::isfinite(p.highKey)) json["maximum_key"] = p.highKey;
  }
  if (p.type == ValueType::function) json["arity"] = p.arity;
  if (!p.choices.empty()) json["choices"] = p.choices;
  if (!p.blockKind.empty()) json["block_kind"] = p.blockKind;
  return json;
}

}  // namespace

std::string table(const std::vector<Row>& rows, int width) {
  std::vector<int> widths;
  for (const Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], columns(row[i]));
  }
  std::string out;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i + 1 < row.size(); ++i)
      if (widths[i] > 0)
        line += row[i] + std::string(std::size_t(widths[i] + 2 - columns(row[i])), ' ');
    // Too little room beside the other columns: a line of its own.
    int indent = columns(line);
    if (width - indent < 18 && !row.back().empty()) {
      indent = 6;
      line.erase(line.find_last_not_of(' ') + 1);
      line += '\n' + std::string(std::size_t(indent), ' ');
    }
    line += wrapped(row.back(), width - indent, indent);
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
  }
  return out;
}

std::string typeText(const Parameter& p) {
  if (p.type == ValueType::list) return "list of " + typeText(p.entry());
  if (p.type == ValueType::map) return "map to " + typeText(p.entry());
  if (p.type == ValueType::function)
    return fmt::format("function of {} number{}", p.arity, p.arity == 1 ? "" : "s");
  std::string text = nameOf(p.type).word;
  if (p.type == ValueType::choice) {
    text.clear();
    for (const std::string& c : p.choices) text += (text.empty() ? "" : " | ") + ('"' + c + '"');
  }
  if (p.type == ValueType::block) text = p.blockKind + " block";
  return p.texturable ? text + " or pigment" : text;
}

std::string valueText(const Value& v) {
  const auto list = [&](int n) {
    std::string text;
    for (int i = 0; i < n; ++i) text += fmt::format("{}{:g}", i ? ", " : "", v.v[i]);
    return "<" + text + ">";
  };
  switch (v.kind) {
    case Value::Kind::number:
      return fmt::format("{:g}", v.v[0]);
    case Value::Kind::vector:
      return list(v.size);
    case Value::Kind::colour:
      return v.v[0] == v.v[1] && v.v[1] == v.v[2] ? fmt::format("rgb {:g}", v.v[0])
                                                  : "rgb " + list(3);
    case Value::Kind::text:
      return '"' + v.text.str() + '"';
    default:
      return "";
  }
}

std::string rangeText(const Parameter& p) {
  const bool low = std::isfinite(p.low), high = std::isfinite(p.high);
  if (low && high)
    return p.openLow ? fmt::format("> {:g}, <= {:g}", p.low, p.high)
                     : fmt::format("{:g} .. {:g}", p.low, p.high);
  if (low) return fmt::format("{} {:g}", p.openLow ? ">" : ">=", p.low);
  return high ? fmt::format("<= {:g}", p.high) : "";
}

std::string schemaText(const Schema& s, int width) {
  // A shape's plugin is its own keyword in the language.
  const std::string head =
      s.kind == "shape" ? s.name : s.kind + (s.name.empty() ? "" : " " + s.name);
  std::string out = fmt::format("{} {{ ... }}\n", head);
  out += "  " + wrapped(s.summary, width - 2, 2) + "\n";
  std::vector<Row> rows;
  if (!s.params.empty() || !s.inputs.empty())
    rows.push_back({"  parameter", "type", "default", "range", "meaning [unit]"});
  addRows(rows, s.params);
  addRows(rows, s.inputs);
  bool positional = false;
  for (const auto* list : {&s.params, &s.inputs})
    for (const Parameter& p : *list) positional = positional || p.positional;
  if (!rows.empty()) out += '\n' + table(rows, width);
  if (positional) out += "\n  * may stand without its name, in this order\n";
  if (!s.children.empty())
    out += fmt::format("\n  may hold blocks of kind: {}\n", fmt::join(s.children, ", "));
  return out;
}

std::string schemasJson(const std::vector<const Schema*>& schemas) {
  Json all = Json::array();
  for (const Schema* s : schemas) {
    Json parameters = Json::array();
    for (const auto* list : {&s->params, &s->inputs})
      for (const Parameter& p : *list) parameters.push_back(toJson(p));
    all.push_back({{"kind", s->kind},
                   {"name", s->name},
                   {"summary", s->summary},
                   {"parameters", parameters},
                   {"children", s->children}});
  }
  return all.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace vestige::app
