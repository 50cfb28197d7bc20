// The only file that compiles toml++; it is slow.
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include <sstream>

#include "core/base/error.hpp"
#include "core/base/toml_tree.hpp"

namespace vocalis::base {

namespace {

TomlNode convert(const toml::node& source, const std::string& key, const std::string& file_name) {
  TomlNode node;
  node.key = key;
  node.place = file_name + ":" + std::to_string(source.source().begin.line);
  using Kind = TomlNode::Kind;
  if (const auto* table = source.as_table()) {
    node.kind = Kind::table;
    for (const auto& [name, value] : *table)
      node.children.push_back(convert(value, std::string(name.str()), file_name));
    // toml++ sorts by name; a reader of resolved.toml expects the order of the file.
    const auto line_of = [&](const TomlNode& child) { return table->get(child.key)->source().begin; };
    node.children.sort([&](const TomlNode& a, const TomlNode& b) { return line_of(a) < line_of(b); });
  } else if (const auto* array = source.as_array()) {
    node.kind = Kind::array;
    for (const auto& value : *array) node.children.push_back(convert(value, "", file_name));
  } else if (const auto* text = source.as_string()) {
    node.kind = Kind::text;
    node.text = text->get();
  } else if (const auto* integer = source.as_integer()) {
    node.kind = Kind::integer;
    node.integer = integer->get();
    node.real = static_cast<double>(node.integer);
  } else if (const auto* real = source.as_floating_point()) {
    node.kind = Kind::real;
    node.real = real->get();
  } else if (const auto* boolean = source.as_boolean()) {
    node.kind = Kind::boolean;
    node.boolean = boolean->get();
  } else {
    node.kind = Kind::other;
    std::ostringstream words;
    if (const auto* date = source.as_date()) words << date->get();
    if (const auto* time = source.as_time()) words << time->get();
    if (const auto* both = source.as_date_time()) words << both->get();
    node.text = words.str();
  }
  return node;
}

}  // namespace

TomlNode parse_toml(std::string_view text, const std::string& file_name) {
  try {
    const toml::table table = toml::parse(text, file_name);
    return convert(table, "", file_name);
  } catch (const toml::parse_error& error) {
    throw UserError(file_name + ":" + std::to_string(error.source().begin.line) + ": the file must be valid TOML",
                    std::string(error.description()),
                    "correct this line; texts stand in quotes, every key once, see https://toml.io");
  }
}

}  // namespace vocalis::base
