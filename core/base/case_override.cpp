#include "core/base/case_override.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

#include "core/base/case_table.hpp"
#include "core/base/error.hpp"

namespace vocalis::base {

namespace {

using Kind = TomlNode::Kind;
using Parts = std::vector<std::string>;

Parts split(const std::string& key, const std::string& place) {
  Parts parts(1);
  for (const char c : key) {
    if (c == '.') {
      parts.emplace_back();
    } else if (c != ' ') {
      parts.back() += c;
    }
  }
  if (std::any_of(parts.begin(), parts.end(), [](const std::string& part) { return part.empty(); })) {
    throw UserError(place + ": names must stand between the points of a key", "\"" + key + "\"",
                    "write it like time.dt=1e-5");
  }
  return parts;
}

void set_place(TomlNode& node, const std::string& place) {
  node.place = place;
  for (TomlNode& child : node.children) set_place(child, place);
}

TomlNode parse_value(const std::string& text, const std::string& place) {
  TomlNode value;
  try {
    TomlNode tree = parse_toml("value = " + text, place);
    if (tree.children.size() == 1) value = tree.children.front();
  } catch (const UserError&) {
    if (text.starts_with('[')) {
      throw UserError(place + ": a list must be valid TOML", text,
                      "quote its texts, and all of it for the shell: --set 'KEY=[\"a\", \"b\"]'");
    }
    value.key.clear();
  }
  if (value.key.empty()) {  // not TOML: a bare word
    value.kind = Kind::text;
    value.text = text;
  }
  set_place(value, place);
  return value;
}

std::string name_of(const TomlNode& item) {
  for (const char* key : {"name", "group"}) {
    const TomlNode* name = item.find(key);
    if (name && name->kind == Kind::text) return name->text;
  }
  return {};
}

/// The elements of an array of tables that `part` means; `named` says whether it means one by name or index.
std::vector<TomlNode*> choose(TomlNode& array, const std::string& part, bool is_last, const std::string& place,
                              bool& named) {
  std::vector<TomlNode*> all, chosen;
  Parts names;
  bool is_key = is_last;
  for (TomlNode& item : array.children) {
    all.push_back(&item);
    names.push_back(name_of(item));
    if (!names.back().empty() && names.back() == part) chosen.push_back(&item);
    is_key = is_key || item.find(part) != nullptr;
  }
  named = true;
  if (!chosen.empty()) return chosen;
  if (std::all_of(part.begin(), part.end(), [](unsigned char c) { return std::isdigit(c); })) {
    if (part.size() > 6 || std::stoul(part) >= all.size()) {
      throw UserError(place + ": the index must be less than " + std::to_string(all.size()) + ", the number of [[" +
                          array.key + "]] in the case",
                      part, "count from 0, or use a name: " + list_of(names));
    }
    return {all[std::stoul(part)]};
  }
  named = false;
  if (is_key) return all;
  throw UserError(place + ": the case has no [[" + array.key + "]] of this name", "\"" + part + "\"",
                  did_you_mean(part, names));
}

void assign(TomlNode& node, const Parts& parts, std::size_t depth, const TomlNode& value) {
  const std::string& part = parts[depth];
  const bool is_last = depth + 1 == parts.size();
  if (node.kind == Kind::array) {
    bool named = false;
    const std::vector<TomlNode*> chosen = choose(node, part, is_last, value.place, named);
    if (named && is_last) {
      throw UserError(value.place + ": a key must follow the name of a [[" + node.key + "]]", "\"" + part + "\"",
                      "write it like acoustic.NAME.analogy=none");
    }
    for (TomlNode* item : chosen) assign(*item, parts, named ? depth + 1 : depth, value);
    return;
  }
  if (node.kind != Kind::table) {
    throw UserError(value.place + ": a key can only be set in a table",
                    node.key + " is " + std::string(node.kind_name()), "leave out what follows " + node.key);
  }
  TomlNode* child = node.find(part);
  if (!child) {
    child = &node.children.emplace_back();
    child->key = part;
    child->place = value.place;
  }
  if (!is_last) return assign(*child, parts, depth + 1, value);
  const std::string key = part;
  *child = value;
  child->key = key;
}

}  // namespace

void apply_override(TomlNode& root, const std::string& assignment) {
  const std::string place = "--set " + assignment;
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == assignment.size()) {
    throw UserError(place + ": must be an assignment", "\"" + assignment + "\"",
                    "write KEY=VALUE without blanks, for example --set time.dt=1e-5");
  }
  assign(root, split(assignment.substr(0, equals), place), 0, parse_value(assignment.substr(equals + 1), place));
}

}  // namespace vocalis::base
