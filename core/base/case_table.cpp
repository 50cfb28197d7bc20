#include "core/base/case_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"

namespace vocalis::base {

namespace {

using Kind = TomlNode::Kind;

std::string in_unit(const std::string& unit) { return unit.empty() ? "" : " [" + unit + "]"; }

[[noreturn]] void wrong_type(const TomlNode& node, const std::string& where, const std::string& expected,
                             const std::string& remedy) {
  throw UserError(where + " must be " + expected, fmt::format("{}: {}", node.kind_name(), toml_value(node)), remedy);
}

double finite_number(const TomlNode& node, const std::string& where, const Range& range, const std::string& unit) {
  if (node.kind != Kind::real && node.kind != Kind::integer) {
    wrong_type(node, where, "a number" + in_unit(unit),
               "write a bare number" + in_unit(unit) + ", without quotes and unit");
  }
  if (!std::isfinite(node.real)) {
    throw UserError(where + " must be a finite number" + in_unit(unit), toml_value(node), "write a finite number");
  }
  if (!range.contains(node.real)) {
    throw UserError(where + " must be " + range.words() + in_unit(unit), toml_value(node),
                    "choose a value that is " + range.words());
  }
  return node.real;
}

int whole_number(const TomlNode& node, const std::string& where, const Range& range, const std::string& unit) {
  if (node.kind != Kind::integer) {
    wrong_type(node, where, "a whole number" + in_unit(unit), "write digits only, without point, exponent and quotes");
  }
  finite_number(node, where, range, unit);
  if (node.integer > std::numeric_limits<int>::max() || node.integer < std::numeric_limits<int>::min()) {
    throw UserError(where + " must fit into 32 bits", toml_value(node), "choose a smaller number");
  }
  return static_cast<int>(node.integer);
}

void set_number(TomlNode& node, double value) {
  node.kind = Kind::real;
  node.real = value;
}

/// "[inlet]" for an element that has a name, "[2]" for another.
std::string element_name(const TomlNode& item, std::size_t index) {
  for (const char* key : {"name", "group"}) {
    const TomlNode* name = item.find(key);
    if (name && name->kind == Kind::text) return "[" + name->text + "]";
  }
  return "[" + std::to_string(index) + "]";
}

}  // namespace

bool Range::contains(double value) const {
  return (with_low ? value >= low : value > low) && (with_high ? value <= high : value < high);
}

std::string Range::words() const {
  const bool bounded_below = std::isfinite(low);
  const bool bounded_above = std::isfinite(high);
  if (!bounded_below && !bounded_above) return "any number";
  if (!bounded_above && low == 0) return with_low ? "zero or positive" : "positive";
  if (!bounded_above) return fmt::format("{} {}", with_low ? "at least" : "more than", low);
  if (!bounded_below) return fmt::format("{} {}", with_high ? "at most" : "less than", high);
  if (with_low && with_high) return fmt::format("from {} to {}", low, high);
  return fmt::format("{} {} and {} {}", with_low ? "at least" : "more than", low, with_high ? "at most" : "less than",
                     high);
}

std::string Table::path(const std::string& key) const {
  if (path_.empty() || key.empty()) return path_ + key;
  return path_ + "." + key;
}

std::string Table::place(const std::string& key) const {
  const TomlNode* child = key.empty() ? nullptr : node_->find(key);
  const std::string name = path(key);
  return (child ? child : node_)->place + (name.empty() ? "" : ": " + name);
}

TomlNode* Table::find(const std::string& key) const {
  node_->asked.insert(key);
  TomlNode* child = node_->find(key);
  if (child) child->read = true;
  return child;
}

TomlNode& Table::need(const std::string& key, const std::string& unit) const {
  TomlNode* child = find(key);
  if (!child) {
    std::vector<std::string> unread;
    for (const TomlNode& other : node_->children) {
      if (!other.read) unread.push_back(other.key);
    }
    const std::string meant = nearest_name(key, unread);
    throw UserError(node_->place + ": " + path(key) + " is needed" + in_unit(unit),
                    meant.empty() ? "nothing" : "no such key, but " + meant,
                    meant.empty() ? "add the key " + key + (path_.empty() ? "" : " to " + path_)
                                  : "did you mean \"" + key + "\" where \"" + meant + "\" stands?");
  }
  child->unit = unit;
  return *child;
}

TomlNode& Table::add_default(const std::string& key, const std::string& unit) const {
  TomlNode& child = node_->children.emplace_back();
  child.key = key;
  child.place = node_->place;
  child.read = true;
  child.by_default = true;
  child.unit = unit;
  return child;
}

bool Table::has(const std::string& key) const {
  node_->asked.insert(key);
  return node_->find(key) != nullptr;
}

bool Table::is_array(const std::string& key) const {
  const TomlNode* child = node_->find(key);
  return child && child->kind == Kind::array;
}

std::vector<std::string> Table::keys() const {
  std::vector<std::string> result;
  for (const TomlNode& child : node_->children) result.push_back(child.key);
  return result;
}

double Table::number(const std::string& key, const Range& range, const std::string& unit) {
  const TomlNode& node = need(key, unit);
  return finite_number(node, place(key), range, unit);
}

double Table::number_or(const std::string& key, double fallback, const Range& range, const std::string& unit) {
  if (has(key)) return number(key, range, unit);
  set_number(add_default(key, unit), fallback);
  return fallback;
}

int Table::integer(const std::string& key, const Range& range, const std::string& unit) {
  const TomlNode& node = need(key, unit);
  return whole_number(node, place(key), range, unit);
}

int Table::integer_or(const std::string& key, int fallback, const Range& range, const std::string& unit) {
  if (has(key)) return integer(key, range, unit);
  TomlNode& node = add_default(key, unit);
  node.kind = Kind::integer;
  node.integer = fallback;
  node.real = fallback;
  return fallback;
}

bool Table::boolean_or(const std::string& key, bool fallback) {
  if (!has(key)) {
    TomlNode& node = add_default(key, "");
    node.kind = Kind::boolean;
    node.boolean = fallback;
    return fallback;
  }
  const TomlNode& node = need(key, "");
  if (node.kind != Kind::boolean) wrong_type(node, place(key), "true or false", "write true or false, without quotes");
  return node.boolean;
}

std::string Table::text(const std::string& key, const std::vector<std::string>& allowed) {
  const TomlNode& node = need(key, "");
  if (node.kind != Kind::text) wrong_type(node, place(key), "a text", "write it in quotes");
  if (node.text.empty()) throw UserError(place(key) + " must not be empty", "\"\"", "write a text between the quotes");
  bool known = allowed.empty();
  for (const std::string& name : allowed) known = known || name == node.text;
  if (!known) {
    throw UserError(place(key) + " must be one of " + list_of(allowed), "\"" + node.text + "\"",
                    did_you_mean(node.text, allowed));
  }
  return node.text;
}

std::string Table::text_or(const std::string& key, const std::string& fallback,
                           const std::vector<std::string>& allowed) {
  const TomlNode* given = has(key) ? find(key) : nullptr;
  if (given && fallback.empty() && given->kind == Kind::text && given->text.empty()) return {};
  if (given) return text(key, allowed);
  TomlNode& node = add_default(key, "");
  node.kind = Kind::text;
  node.text = fallback;
  return fallback;
}

std::vector<std::string> Table::texts(const std::string& key) {
  const TomlNode& node = need(key, "");
  const std::string remedy = "write texts in square brackets: [\"a\", \"b\"]";
  if (node.kind != Kind::array) wrong_type(node, place(key), "an array of texts", remedy);
  std::vector<std::string> result;
  for (const TomlNode& item : node.children) {
    if (item.kind != Kind::text || item.text.empty()) wrong_type(item, place(key), "an array of texts", remedy);
    result.push_back(item.text);
  }
  if (result.empty()) throw UserError(place(key) + " must not be empty", "[]", remedy);
  return result;
}

void Table::resolve_text(const std::string& key, const std::string& text) { need(key, "").text = text; }

std::vector<double> Table::numbers(const std::string& key, std::size_t least, std::size_t most,
                                   const std::string& unit) {
  const TomlNode& node = need(key, unit);
  const std::string size = least == most ? std::to_string(least) : fmt::format("{} to {}", least, most);
  const std::string rule = fmt::format("an array of {} numbers{}", size, in_unit(unit));
  if (node.kind != Kind::array) wrong_type(node, place(key), rule, "write numbers in square brackets: [0.0, 0.0]");
  if (node.children.size() < least || node.children.size() > most) {
    throw UserError(place(key) + " must be " + rule, fmt::format("{}: {}", node.children.size(), toml_value(node)),
                    "write " + size + " numbers");
  }
  std::vector<double> result;
  for (const TomlNode& item : node.children) {
    const std::string where = place(key) + "[" + std::to_string(result.size()) + "]";
    result.push_back(finite_number(item, where, any_number, unit));
  }
  return result;
}

std::vector<double> Table::numbers_or(const std::string& key, const std::vector<double>& fallback, std::size_t least,
                                      std::size_t most, const std::string& unit) {
  if (has(key)) return numbers(key, least, most, unit);
  TomlNode& node = add_default(key, unit);
  node.kind = Kind::array;
  for (const double value : fallback) set_number(node.children.emplace_back(), value);
  return fallback;
}

Table Table::table(const std::string& key) {
  TomlNode& node = need(key, "");
  if (node.kind != Kind::table) {
    const bool repeated = node.kind == Kind::array;
    wrong_type(node, place(key), "a table", (repeated ? "write [" : "open it with [") + path(key) + "], once");
  }
  return {node, path(key)};
}

std::optional<Table> Table::table_if(const std::string& key) {
  if (!has(key)) return std::nullopt;
  return table(key);
}

Table Table::table_or_empty(const std::string& key) {
  if (!has(key)) add_default(key, "").kind = Kind::table;
  return table(key);
}

std::vector<Table> Table::tables(const std::string& key) {
  std::vector<Table> result;
  TomlNode* node = find(key);
  if (!node) return result;
  const std::string remedy = "write [[" + path(key) + "]], in double brackets, once for each";
  if (node->kind != Kind::array) wrong_type(*node, place(key), "an array of tables", remedy);
  for (TomlNode& item : node->children) {
    if (item.kind != Kind::table) wrong_type(item, place(key), "an array of tables", remedy);
    item.read = true;
    result.push_back({item, path(key) + element_name(item, result.size())});
  }
  return result;
}

void Table::reject_unknown_keys() const {
  const std::vector<std::string> known(node_->asked.begin(), node_->asked.end());
  for (TomlNode& child : node_->children) {
    if (!child.read) {
      throw UserError(place(child.key) + " is not a key that Vocalis knows here", "\"" + child.key + "\"",
                      known.empty() ? "leave it out" : did_you_mean(child.key, known));
    }
    if (child.kind == Kind::table) Table(child, path(child.key)).reject_unknown_keys();
    if (child.kind != Kind::array) continue;
    std::size_t index = 0;
    for (TomlNode& item : child.children) {
      if (item.kind == Kind::table) Table(item, path(child.key) + element_name(item, index)).reject_unknown_keys();
      ++index;
    }
  }
}

}  // namespace vocalis::base
