#include "core/base/toml_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace vocalis::base {

namespace {

using Kind = TomlNode::Kind;

bool is_bare(const std::string& key) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
  return !key.empty() && std::all_of(key.begin(), key.end(), plain);
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += {'\\', c};
    } else if (c == '\n') {
      result += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      result += fmt::format("\\u{:04X}", static_cast<int>(c));
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::string written_key(const std::string& key) { return is_bare(key) ? key : quoted(key); }

std::string written_real(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  std::string digits = fmt::format("{}", value);
  if (digits.find_first_of(".e") == std::string::npos) digits += ".0";
  return digits;
}

bool is_array_of_tables(const TomlNode& node) {
  const auto is_table = [](const TomlNode& item) { return item.kind == Kind::table; };
  return node.kind == Kind::array && !node.children.empty() &&
         std::all_of(node.children.begin(), node.children.end(), is_table);
}

bool is_section(const TomlNode& node) { return node.kind == Kind::table || is_array_of_tables(node); }

/// The values of a table first, for TOML counts what follows a header to it.
void write_table(const TomlNode& table, const std::string& path, std::string& out) {
  for (const TomlNode& child : table.children) {
    if (is_section(child)) continue;
    std::string line = written_key(child.key) + " = " + toml_value(child);
    std::string comment;
    if (!child.unit.empty()) comment += "[" + child.unit + "]";
    if (child.by_default) comment += comment.empty() ? "default" : " default";
    if (!comment.empty()) line += "  # " + comment;
    out += line + "\n";
  }
  for (const TomlNode& child : table.children) {
    if (!is_section(child)) continue;
    const std::string name = path.empty() ? written_key(child.key) : path + "." + written_key(child.key);
    if (child.kind == Kind::table) {
      out += "\n[" + name + "]\n";
      write_table(child, name, out);
    } else {
      for (const TomlNode& item : child.children) {
        out += "\n[[" + name + "]]\n";
        write_table(item, name, out);
      }
    }
  }
}

std::string joined(const TomlNode& node, const char* open, const char* close) {
  std::string result = open;
  for (const TomlNode& child : node.children) {
    if (&child != &node.children.front()) result += ", ";
    if (!child.key.empty()) result += written_key(child.key) + " = ";
    result += toml_value(child);
  }
  return result + close;
}

}  // namespace

std::string_view TomlNode::kind_name() const {
  switch (kind) {
    case Kind::table:
      return "a table";
    case Kind::array:
      return is_array_of_tables(*this) ? "an array of tables" : "an array";
    case Kind::text:
      return "a text";
    case Kind::integer:
      return "a whole number";
    case Kind::real:
      return "a number";
    case Kind::boolean:
      return "true or false";
    case Kind::other:
      break;
  }
  return "a date or time";
}

TomlNode* TomlNode::find(std::string_view name) {
  return const_cast<TomlNode*>(static_cast<const TomlNode*>(this)->find(name));
}

const TomlNode* TomlNode::find(std::string_view name) const {
  for (const TomlNode& child : children) {
    if (child.key == name) return &child;
  }
  return nullptr;
}

std::string toml_value(const TomlNode& node) {
  switch (node.kind) {
    case Kind::table:
      return joined(node, "{ ", " }");
    case Kind::array:
      return joined(node, "[", "]");
    case Kind::text:
      return quoted(node.text);
    case Kind::integer:
      return std::to_string(node.integer);
    case Kind::real:
      return written_real(node.real);
    case Kind::boolean:
      return node.boolean ? "true" : "false";
    case Kind::other:
      break;
  }
  return node.text;
}

std::string write_toml(const TomlNode& root) {
  std::string out;
  write_table(root, "", out);
  return out;
}

}  // namespace vocalis::base
